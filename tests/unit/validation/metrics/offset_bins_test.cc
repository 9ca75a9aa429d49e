#include "validation/metrics/offset_bins.h"

#include "synthetic/dataset/error.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pelvireg::metrics
{
namespace
{
TEST(OffsetBins, AreHalfOpenAroundMultiplesOfTheWidth)
{
  const auto bins = bin_by_offset({-9, -3, -2.999, 2.999, 3, 8.999, 21}, {1, 2, 3, 4, 5, 6, 7}, 6);
  ASSERT_EQ(bins.size(), 4u);
  EXPECT_EQ(bins[0].index, -1); // -9 <= offset < -3
  EXPECT_EQ(bins[0].values.n, 1);
  EXPECT_EQ(bins[1].index, 0);
  EXPECT_EQ(bins[1].values.n, 3);
  EXPECT_DOUBLE_EQ(bins[1].values.mean, 3);
  EXPECT_EQ(bins[2].index, 1);
  EXPECT_DOUBLE_EQ(bins[2].values.mean, 5.5);
  EXPECT_EQ(bins[3].index, 4) << "21 belongs to the slab from 21 to 27";
}

TEST(OffsetBins, OfAnErrorThatGrowsWithTheDistanceGiveThatLineBack)
{
  std::vector<double> offsets, values;
  for (int i = -2000; i < 2000; ++i)
  {
    offsets.push_back(0.015 * (i + 0.5));
    values.push_back(1 + 0.25 * std::abs(offsets.back()));
  }
  for (const OffsetBin &bin : bin_by_offset(offsets, values, 6))
    EXPECT_NEAR(bin.values.mean,
                bin.index == 0             ? 1 + 0.25 * 1.5
                : std::abs(bin.index) == 5 ? 1 + 0.25 * 28.5
                                           : 1 + 0.25 * 6 * std::abs(bin.index),
                1e-12)
        << bin.index;
}

TEST(OffsetBins, OffsetsAreSignedDistancesFromThePlane)
{
  dataset::Points points(3, 3);
  points << 1, 1, 1, 5, 7, 9, 0, 0, 0;
  const auto offsets = plane_offsets(points, {{1, 1, 1}, Eigen::Vector3d(2, 1, 2) / 3});
  EXPECT_NEAR(offsets[0], 0, 1e-15);
  EXPECT_NEAR(offsets[1], 10, 1e-14);
  EXPECT_NEAR(offsets[2], -5.0 / 3, 1e-15);
}

TEST(OffsetBins, RefuseWhatHasNoAnswer)
{
  EXPECT_THROW(bin_by_offset({}, {}, 6), InputError);
  EXPECT_THROW(bin_by_offset({1, 2}, {1}, 6), InputError);
  for (const double width : {0.0, -1.0, std::nan("")})
    EXPECT_THROW(bin_by_offset({1}, {1}, width), InputError);
  EXPECT_THROW(bin_by_offset({std::nan("")}, {1}, 6), InputError);
  EXPECT_THROW(bin_by_offset({1}, {std::nan("")}, 6), InputError);
}
} // namespace
} // namespace pelvireg::metrics
