#include "validation/metrics/symmetric_distance.h"

#include "synthetic/dataset/error.h"
#include "tests/unit/validation/fixtures/shapes.h"
#include "validation/metrics/statistics.h"
#include "validation/metrics/surface_distance.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pelvireg::metrics
{
namespace
{
TEST(SymmetricDistance, WeighsEverySampleOfBothSurfacesOnce)
{
  const SymmetricDistance found = symmetric_distance({1, 1, 1}, {5});
  EXPECT_DOUBLE_EQ(found.mean, 2);
  EXPECT_DOUBLE_EQ(found.hd95, 5);
  EXPECT_DOUBLE_EQ(symmetric_distance({5}, {1, 1, 1}).mean, 2);
  EXPECT_DOUBLE_EQ(symmetric_distance({5}, {1, 1, 1}).hd95, 5);
}

TEST(SymmetricDistance, PercentileIsOfEachDirectionAloneAndTheLargerOneCounts)
{
  std::vector<double> there, back;
  for (int i = 0; i <= 100; ++i)
  {
    there.push_back(i);      // 95th percentile 95
    back.push_back(2.0 * i); // 190; of both together it would be 180
  }
  EXPECT_DOUBLE_EQ(symmetric_distance(there, back).hd95, 190);
}

TEST(SymmetricDistance, SeesAPartThatOneDirectionMisses)
{
  // A plate of 20 mm on a plate of 40 mm: from the small one nothing is to be seen. One sample per mm^2.
  const auto distances = [](double from, double to)
  {
    dataset::Points samples(static_cast<Eigen::Index>(from * from), 3);
    for (Eigen::Index i = 0; i < samples.rows(); ++i)
      samples.row(i) << 0.5 + i % static_cast<int>(from), 0.5 + i / static_cast<int>(from), 0;
    const dataset::SurfaceMesh plate = test::square(to, 0, 2);
    return surface_distances(samples, plate.points, plate.triangles, plate.region);
  };
  const auto there = distances(20, 40), back = distances(40, 20);
  EXPECT_EQ(describe(there).max, 0);
  // Over the L around the small plate: sides of 400 mm^2 each with mean 10 mm, a corner of 400 mm^2 with mean
  // 20 (sqrt(2) + ln(1 + sqrt(2))) / 3 mm; the small plate itself has none.
  const double corner = 20 * (std::sqrt(2.0) + std::asinh(1.0)) / 3;
  EXPECT_NEAR(symmetric_distance(there, back).mean, (400 * 10 + 400 * 10 + 400 * corner) / 2000, 0.001);
}

TEST(SymmetricDistance, RefusesWhatHasNoAnswer)
{
  EXPECT_THROW(symmetric_distance({}, {1}), InputError);
  EXPECT_THROW(symmetric_distance({1}, {}), InputError);
  EXPECT_THROW(symmetric_distance({1}, {std::nan("")}), InputError);
}
} // namespace
} // namespace pelvireg::metrics
