// Inside the store only: names and checks that writer and reader share.
#pragma once

#include "synthetic/dataset/store.h"

#include <hdf5.h>

#include <type_traits>

namespace pelvireg::dataset
{
static_assert(std::is_same_v<hid_t, std::int64_t> && std::is_same_v<herr_t, int>, "Handle stores an hid_t");

/// HDF5 prints its error stack by default; ours are exceptions.
class QuietErrors
{
public:
  QuietErrors()
  {
    H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~QuietErrors() { H5Eset_auto2(H5E_DEFAULT, function_, data_); }
  QuietErrors(const QuietErrors &) = delete;
  QuietErrors &operator=(const QuietErrors &) = delete;

private:
  H5E_auto2_t function_ = nullptr;
  void *data_ = nullptr;
};

inline std::int64_t count_of(const Extents &extents)
{
  std::int64_t count = 1;
  for (const std::int64_t extent : extents)
    count *= extent;
  return count;
}
} // namespace pelvireg::dataset
