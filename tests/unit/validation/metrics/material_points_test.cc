// One material point on two meshes of a surface.
#include "synthetic/dataset/error.h"
#include "validation/metrics/material_points.h"

#include <gtest/gtest.h>

namespace pelvireg::metrics
{
namespace
{
/// Two triangles over the unit square, the upper one a cap when asked.
dataset::SurfaceMesh square(bool upper_is_cap)
{
  dataset::SurfaceMesh mesh;
  mesh.points.resize(4, 3);
  mesh.points << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0;
  mesh.triangles.resize(2, 3);
  mesh.triangles << 0, 1, 2, 0, 2, 3;
  mesh.region = dataset::Integers::Zero(2);
  if (upper_is_cap)
    mesh.region[1] = static_cast<std::int32_t>(dataset::SurfaceRegion::cap);
  return mesh;
}

TEST(MaterialPoints, CarryALinearFieldExactly)
{
  const dataset::SurfaceMesh mesh = square(false);
  dataset::Points above(3, 3);
  above << 0.7, 0.2, 0.1, 0.3, 0.9, -0.2, 0.5, 0.5, 0;
  const auto samples = closest_samples(mesh, above);
  const dataset::Points feet = sample_positions(samples, mesh.triangles, mesh.points);
  dataset::Points expected = above;
  expected.col(2).setZero();
  EXPECT_LT((feet - expected).cwiseAbs().maxCoeff(), 1e-15);
  EXPECT_EQ(samples[0].triangle, 0);
  EXPECT_EQ(samples[1].triangle, 1);
}

TEST(MaterialPoints, LieOnTheBorderWhenTheSurfaceEndsAndNeverOnACap)
{
  const dataset::SurfaceMesh mesh = square(true);
  dataset::Points points(2, 3);
  points << 2, 0.5, 0, 0.25, 0.75, 0;
  const dataset::Points feet = sample_positions(closest_samples(mesh, points), mesh.triangles, mesh.points);
  EXPECT_LT((feet.row(0) - Eigen::RowVector3d(1, 0.5, 0)).norm(), 1e-15);
  EXPECT_LT((feet.row(1) - Eigen::RowVector3d(0.5, 0.5, 0)).norm(), 1e-15); // onto the diagonal
}

TEST(MaterialPoints, RefuseWhatIsNoSurface)
{
  dataset::SurfaceMesh caps = square(true);
  caps.region[0] = caps.region[1];
  EXPECT_THROW(closest_samples(caps, dataset::Points::Zero(1, 3)), InputError);
}
} // namespace
} // namespace pelvireg::metrics
