#include "synthetic/dataset/parallel.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

namespace pelvireg::dataset
{
namespace
{
TEST(ForEachIndex, CallsEveryJobOnceOnAnyNumberOfThreads)
{
  for (const int n_threads : {1, 2, 7})
  {
    std::vector<int> calls(100, 0);
    for_each_index(100, n_threads, [&](int i) { ++calls[static_cast<std::size_t>(i)]; });
    EXPECT_EQ(calls, std::vector<int>(100, 1));
  }
  for_each_index(0, 2, [](int) { FAIL(); });
}

TEST(ForEachIndex, ThrowsTheFirstFailureWhicheverCameFirst)
{
  const auto fail_on_odd = [](int i)
  {
    if (i % 2)
      throw std::runtime_error(std::to_string(i));
  };
  for (const int n_threads : {1, 3})
    try
    {
      for_each_index(20, n_threads, fail_on_odd);
      FAIL() << "no exception";
    }
    catch (const std::runtime_error &error)
    {
      EXPECT_STREQ(error.what(), "1");
    }
}

TEST(ForEachIndex, BeginsNoFurtherJobAfterAFailure)
{
  std::vector<int> begun;
  EXPECT_THROW(for_each_index(100, 1,
                              [&](int i)
                              {
                                begun.push_back(i);
                                if (i == 2)
                                  throw std::runtime_error("full disk");
                              }),
               std::runtime_error);
  EXPECT_EQ(begun, (std::vector<int>{0, 1, 2}));
}
} // namespace
} // namespace pelvireg::dataset
