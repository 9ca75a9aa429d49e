#include "reference_fe/contact/contact_surface.h"

#include "reference_fe/contact/closest_point.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
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

/// Two by two Gauss points on each quarter of the square: a gap that begins within a face is still integrated well.
std::vector<RulePoint> square_rule()
{
  const double near = 0.5 - 0.5 / std::sqrt(3.), far = 0.5 + 0.5 / std::sqrt(3.);
  std::vector<RulePoint> rule;
  for (const double x : {-far, -near, near, far})
    for (const double y : {-far, -near, near, far})
      rule.push_back({{x, y}, 0.25});
  return rule;
}

std::vector<RulePoint> triangle_rule()
{
  std::vector<RulePoint> rule;
  for (const std::array<int, 3> &quarter : face_facets(6))
    for (int k = 0; k < 3; ++k)
    {
      Eigen::Vector2d at = Eigen::Vector2d::Zero();
      for (int j = 0; j < 3; ++j)
        at += (j == k ? 2. / 3 : 1. / 6) * face_node_coordinates(6, quarter[j]);
      rule.push_back({at, 1. / 24});
    }
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
  const auto add = [&](const Eigen::Vector2d &at, double weight)
  {
    const FacePoint q = face_shape(n, at.x(), at.y());
    const double area = weight * Eigen::Vector3d(rest * q.d_xi).cross(rest * q.d_eta).norm();
    points_.push_back({face, q.value, q.d_xi, q.d_eta, area});
  };
  for (const RulePoint &point : contact_rule(n))
    add(point.at, point.weight);
  for (int node = 0; node < n; ++node)
    add(face_node_coordinates(n, node), 0);
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
