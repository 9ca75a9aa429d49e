// Hexahedral bands of ligaments and fasciae between the same patches as the reference's bars.
#include "synthetic/anatomy/nearest_point.h"
#include "synthetic/anatomy/registration_bodies.h"

#include "synthetic/dataset/error.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace pelvireg::anatomy
{
using dataset::RegistrationBody;
using Eigen::Vector3d;

namespace
{
Vector3d snapped(const Vector3d &point, const RegistrationBody &organ)
{
  Vector3d best = point;
  double least = std::numeric_limits<double>::infinity();
  for (Eigen::Index t = 0; t < organ.outer_triangles.rows(); ++t)
  {
    if (organ.outer_region[t] == static_cast<std::int32_t>(dataset::SurfaceRegion::cap))
      continue;
    const auto corner = [&](int k) -> Vector3d { return organ.points.row(organ.outer_triangles(t, k)).transpose(); };
    const Vector3d candidate = nearest_on_triangle(point, corner(0), corner(1), corner(2));
    if ((candidate - point).squaredNorm() < least)
    {
      least = (candidate - point).squaredNorm();
      best = candidate;
    }
  }
  return best;
}

/// One band as a regular grid, nodes ordered along (fastest), across, through. The middle of the organ's end is snapped
/// onto it, the thickness stands to either side: snapped as well, a band that leaves the organ along its surface would
/// taper to nothing there and lose up to 40 % of its stiffness.
struct Band
{
  std::vector<Vector3d> points;
  std::vector<Eigen::Matrix<int, 1, 8>> hexes;
  std::vector<std::int32_t> organ_end, far_end;
};

Band make_band(const Support &support, const SupportPatches &patches, const RegistrationBody &organ)
{
  const auto &[start, start_span, end, end_span, area] = patches;
  const int n_along = support.band_cells[0], n_across = support.band_cells[1], n_through = support.band_cells[2];
  const Vector3d along = (end - start).normalized();
  const double section = area;
  const auto through = [along, section](const Vector3d &span) -> Vector3d
  { return section / span.norm() * along.cross(span).normalized(); };

  Band band;
  for (int k = 0; k <= n_through; ++k)
    for (int j = 0; j <= n_across; ++j)
    {
      const double s = static_cast<double>(j) / n_across - 0.5, t = static_cast<double>(k) / n_through - 0.5;
      const Vector3d from = snapped(start + s * start_span, organ) + t * through(start_span);
      const Vector3d to = end + s * end_span + t * through(end_span);
      band.organ_end.push_back(static_cast<std::int32_t>(band.points.size()));
      for (int i = 0; i <= n_along; ++i)
        band.points.push_back(from + static_cast<double>(i) / n_along * (to - from));
      band.far_end.push_back(static_cast<std::int32_t>(band.points.size()) - 1);
    }
  const auto node = [&](int i, int j, int k) { return (k * (n_across + 1) + j) * (n_along + 1) + i; };
  for (int k = 0; k < n_through; ++k)
    for (int j = 0; j < n_across; ++j)
      for (int i = 0; i < n_along; ++i)
      {
        Eigen::Matrix<int, 1, 8> hex;
        hex << node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k), node(i, j + 1, k), node(i, j, k + 1),
            node(i + 1, j, k + 1), node(i + 1, j + 1, k + 1), node(i, j + 1, k + 1);
        band.hexes.push_back(hex);
      }
  return band;
}

/// Least corner Jacobian of the hexahedra, mm^3.
double least_jacobian(const Band &band)
{
  static const int neighbours[8][3] = {{1, 3, 4}, {2, 0, 5}, {3, 1, 6}, {0, 2, 7},
                                       {7, 5, 0}, {4, 6, 1}, {5, 7, 2}, {6, 4, 3}};
  double least = std::numeric_limits<double>::infinity();
  for (const auto &hex : band.hexes)
    for (int c = 0; c < 8; ++c)
    {
      const auto edge = [&](int k) -> Vector3d
      {
        return band.points[static_cast<std::size_t>(hex[neighbours[c][k]])] -
               band.points[static_cast<std::size_t>(hex[c])];
      };
      least = std::min(least, edge(0).cross(edge(1)).dot(edge(2)));
    }
  return least;
}

dataset::Integers to_eigen(const std::vector<std::int32_t> &values)
{
  return Eigen::Map<const dataset::Integers>(values.data(), static_cast<Eigen::Index>(values.size()));
}
} // namespace

void add_bands(const Parameters &parameters, dataset::RegistrationModel &model)
{
  for (const std::string name : {"fascia_pelvis", "fascia_sacrum", "ligaments"})
  {
    RegistrationBody body;
    body.name = name;
    std::vector<Vector3d> points;
    std::vector<Eigen::Matrix<int, 1, 8>> hexes;
    std::vector<std::int32_t> fixed;
    for (const Support &support : parameters.supports)
      for (const bool left : {true, false})
      {
        if (support.body != name)
          continue;
        const auto organ = std::find_if(model.bodies.begin(), model.bodies.end(),
                                        [&](const RegistrationBody &b) { return b.name == support.organ; });
        SupportPatches patches = support_patches(support, left, parameters);
        patches.organ_point += parameters.insertion_shift.cwiseProduct(Vector3d(left ? 1 : -1, 1, 1));
        Band band = make_band(support, patches, *organ);
        if (!(least_jacobian(band) > 0))
          throw InputError(
              fmt::format("Support {} ({}): its band folds where it meets the {} (least corner Jacobian {:.3g} "
                          "mm^3); move organ_point out of the organ or turn organ_span.",
                          support.name, left ? "left" : "right", support.organ, least_jacobian(band)));
        const auto first = static_cast<std::int32_t>(points.size());
        for (std::int32_t &node : band.organ_end)
          node += first;
        for (const std::int32_t node : band.far_end)
          fixed.push_back(node + first);
        for (const auto &hex : band.hexes)
          hexes.push_back((hex.array() + first).matrix());
        points.insert(points.end(), band.points.begin(), band.points.end());
        const std::string attachment = support.name + (left ? "_left" : "_right");
        model.attachments.push_back({attachment, support.kind, name, to_eigen(band.organ_end), support.organ});
      }
    body.points.resize(static_cast<Eigen::Index>(points.size()), 3);
    for (std::size_t i = 0; i < points.size(); ++i)
      body.points.row(static_cast<Eigen::Index>(i)) = points[i].transpose();
    body.hexes.resize(static_cast<Eigen::Index>(hexes.size()), 8);
    for (std::size_t i = 0; i < hexes.size(); ++i)
      body.hexes.row(static_cast<Eigen::Index>(i)) = hexes[i];
    body.fixed_nodes = to_eigen(fixed);
    model.bodies.push_back(std::move(body));
  }
}
} // namespace pelvireg::anatomy
