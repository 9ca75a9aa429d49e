#include "reference_fe/contact/contact_surface.h"

#include "reference_fe/contact/closest_point.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <map>
#include <utility>

namespace pelvireg::reference_fe
{
namespace
{
struct RulePoint
{
  Eigen::Vector2d at;
  double weight = 0; ///< of the reference element
};

/// Simpson's rule on each quarter of the square: a gap that begins within a face is still integrated well, and an edge
/// that bears on another surface has points of its own.
std::vector<RulePoint> square_rule()
{
  constexpr std::array<double, 5> at = {-1, -0.5, 0, 0.5, 1}, weight = {1. / 6, 2. / 3, 1. / 3, 2. / 3, 1. / 6};
  std::vector<RulePoint> rule;
  for (std::size_t i = 0; i < at.size(); ++i)
    for (std::size_t j = 0; j < at.size(); ++j)
      rule.push_back({{at[i], at[j]}, weight[i] * weight[j]});
  return rule;
}

/// Mid-points of the edges of each quarter of the triangle, and the nodes without weight.
std::vector<RulePoint> triangle_rule()
{
  std::vector<RulePoint> rule;
  for (const std::array<int, 3> &quarter : face_facets(6))
    for (int k = 0; k < 3; ++k)
      rule.push_back({0.5 * (face_node_coordinates(6, quarter[k]) + face_node_coordinates(6, quarter[(k + 1) % 3])),
                      1. / 24});
  for (int node = 0; node < 6; ++node)
    rule.push_back({face_node_coordinates(6, node), 0});
  return rule;
}

const std::vector<RulePoint> &contact_rule(int n_nodes)
{
  static const std::vector<RulePoint> square = square_rule(), triangle = triangle_rule();
  return n_nodes == 9 ? square : triangle;
}

Eigen::Matrix3Xd rest_of(const SurfaceFace &face)
{
  Eigen::Matrix3Xd x(3, face.nodes.size());
  for (std::size_t i = 0; i < face.nodes.size(); ++i)
    x.col(static_cast<Eigen::Index>(i)) = face.nodes[i].rest_position();
  return x;
}
} // namespace

ContactSurface::ContactSurface(ContactFaces faces) : part_(std::move(faces.part)), faces_(std::move(faces.faces))
{
  for (int face = 0; face < static_cast<int>(faces_.size()); ++face)
  {
    add_facets(face);
    add_points(face);
  }
  if (faces.ends_at_borders)
    mark_borders();
}

void ContactSurface::add_facets(int face)
{
  for (const std::array<int, 3> &nodes : face_facets(static_cast<int>(faces_[face].nodes.size())))
    facets_.push_back({face, nodes, {}});
}

void ContactSurface::add_points(int face)
{
  const Eigen::Matrix3Xd rest = rest_of(faces_[face]);
  const int n = static_cast<int>(rest.cols());
  for (const RulePoint &point : contact_rule(n))
  {
    const FacePoint q = face_shape(n, point.at.x(), point.at.y());
    const double area = point.weight * Eigen::Vector3d(rest * q.d_xi).cross(rest * q.d_eta).norm();
    points_.push_back({face, q.value, q.d_xi, q.d_eta, area});
  }
}

void ContactSurface::mark_borders()
{
  // A node of neighbouring faces is the same when it carries the same unknowns.
  std::map<std::pair<int, int>, int> count;
  const auto edge = [&](const ContactFacet &facet, int k)
  {
    const std::vector<SurfaceNode> &nodes = faces_[facet.face].nodes;
    return std::minmax({nodes[facet.nodes[k]].first_unknown, nodes[facet.nodes[(k + 1) % 3]].first_unknown});
  };
  for (const ContactFacet &facet : facets_)
    for (int k = 0; k < 3; ++k)
      ++count[edge(facet, k)];
  for (ContactFacet &facet : facets_)
    for (int k = 0; k < 3; ++k)
      facet.is_border[k] = count[edge(facet, k)] == 1;
}

std::vector<Eigen::Matrix3Xd> ContactSurface::rest_positions() const
{
  std::vector<Eigen::Matrix3Xd> x;
  for (const SurfaceFace &face : faces_)
    x.push_back(rest_of(face));
  return x;
}

std::vector<Eigen::Matrix3Xd> ContactSurface::positions(const Eigen::VectorXd &solution) const
{
  std::vector<Eigen::Matrix3Xd> x;
  for (const SurfaceFace &face : faces_)
    x.push_back(reference_fe::positions(face.nodes, solution));
  return x;
}

FacetTree ContactSurface::tree(const std::vector<Eigen::Matrix3Xd> &x) const
{
  Eigen::Matrix3Xd corners(3, 3 * facets_.size());
  std::vector<std::array<int, 3>> facets;
  for (std::size_t f = 0; f < facets_.size(); ++f)
  {
    for (int k = 0; k < 3; ++k)
      corners.col(static_cast<Eigen::Index>(3 * f) + k) = x[facets_[f].face].col(facets_[f].nodes[k]);
    const int first = static_cast<int>(3 * f);
    facets.push_back({first, first + 1, first + 2});
  }
  return {corners, facets};
}
} // namespace pelvireg::reference_fe
