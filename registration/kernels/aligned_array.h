// Memory for the kernels.
#pragma once

#include <cstddef>
#include <memory>
#include <new>

namespace pelvireg::registration::kernels
{
/// Doubles on a 64-byte boundary. Growing loses the contents; nothing is initialised.
class AlignedArray
{
public:
  AlignedArray() = default;
  explicit AlignedArray(std::size_t size) { require(size); }

  /// At least `size` doubles; allocates only when it has fewer.
  void require(std::size_t size)
  {
    if (size <= size_)
      return;
    values_.reset(static_cast<double *>(::operator new(size * sizeof(double), alignment)));
    size_ = size;
  }

  double *data() const { return values_.get(); } ///< as with a pointer, constness is not passed on
  std::size_t size() const { return size_; }

private:
  static constexpr std::align_val_t alignment{64};
  struct Delete
  {
    void operator()(double *values) const { ::operator delete(values, alignment); }
  };
  std::unique_ptr<double, Delete> values_;
  std::size_t size_ = 0;
};
} // namespace pelvireg::registration::kernels
