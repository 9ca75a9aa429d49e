#include "validation/metrics/material_error.h"

#include "synthetic/dataset/error.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <cmath>

namespace pelvireg::metrics
{
dataset::Points sample_normals(const std::vector<SurfaceSample> &samples, const dataset::Triangles &triangles,
                               const dataset::Points &points)
{
  dataset::Points normals(static_cast<Eigen::Index>(samples.size()), 3);
  for (Eigen::Index i = 0; i < normals.rows(); ++i)
  {
    const auto nodes = triangles.row(samples[static_cast<std::size_t>(i)].triangle);
    const Eigen::Vector3d a = points.row(nodes[0]), b = points.row(nodes[1]), c = points.row(nodes[2]);
    const Eigen::Vector3d normal = (b - a).cross(c - a);
    if (!(normal.norm() > 0))
      throw InputError(fmt::format("material error: triangle {} has no area, so it has no normal; check the surface",
                                   samples[static_cast<std::size_t>(i)].triangle));
    normals.row(i) = normal.normalized();
  }
  return normals;
}

MaterialError material_error(const dataset::Points &errors, const dataset::Points &normals)
{
  if (errors.rows() == 0 || errors.rows() != normals.rows())
    throw InputError(
        fmt::format("material error: got {} error vectors and {} normals, must be as many and at least one",
                    errors.rows(), normals.rows()));
  std::vector<double> lengths;
  std::vector<double> along, across;
  for (Eigen::Index i = 0; i < errors.rows(); ++i)
  {
    const Eigen::Vector3d error = errors.row(i), normal = normals.row(i);
    lengths.push_back(error.norm());
    along.push_back(std::abs(error.dot(normal)));
    across.push_back((error - error.dot(normal) * normal).norm());
  }
  return {describe(lengths), describe(along).mean, describe(across).mean};
}
} // namespace pelvireg::metrics
