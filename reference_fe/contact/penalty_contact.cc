#include "reference_fe/contact/penalty_contact.h"

#include "reference_fe/contact/closest_point.h"
#include "reference_fe/contact/contact_law.h"
#include "reference_fe/contact/face_projection.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace pelvireg::reference_fe
{
namespace
{
constexpr double ignored_depth = 1.5; ///< mm: deeper is another wall of a thin organ, not a penetration

double smooth_step(double t)
{
  t = std::clamp(t, 0., 1.);
  return t * t * (3 - 2 * t);
}

/// How far a point counts as facing a facet, from 0 at 90 degrees between the outward normals to 1 at 107 degrees: where
/// an edge rubs along a wall (the hiatus along the rectum) or a wall bends over an edge (the rectum over the floor's
/// coccygeal end), pairs come and go gently.
double facing_weight(double cosine)
{
  return smooth_step(-cosine / 0.3);
}

/// Falls from 1 to 0 over the last third of a facet towards an open border.
double border_weight(const Eigen::Vector3d &barycentric, const std::array<bool, 3> &border)
{
  double weight = 1;
  for (int k = 0; k < 3; ++k)
    if (border[k])
      weight = std::min(weight, smooth_step(3 * barycentric[(k + 2) % 3]));
  return weight;
}

/// The facet that a point sees.
struct SeenFacet
{
  int facet = -1;
  double distance = 0, height = 0; ///< mm, from the triangle and from its plane
  double weight = 0;
  Eigen::Vector3d barycentric;
};

SeenFacet closest_facing_facet(const Eigen::Vector3d &point, const Eigen::Vector3d &own_normal,
                               const ContactSurface &surface, const std::vector<Eigen::Matrix3Xd> &x,
                               const std::vector<int> &candidates, double search_distance)
{
  SeenFacet best;
  best.distance = search_distance;
  for (const int f : candidates)
  {
    const ContactFacet &facet = surface.facets()[f];
    const Eigen::Matrix3Xd &nodes = x[facet.face];
    const Eigen::Vector3d a = nodes.col(facet.nodes[0]), b = nodes.col(facet.nodes[1]), c = nodes.col(facet.nodes[2]);
    const Eigen::Vector3d normal = (b - a).cross(c - a).normalized();
    const double facing = facing_weight(normal.dot(own_normal));
    if (facing == 0)
      continue;
    const ClosestPoint found = closest_point(point, a, b, c);
    const double height = normal.dot(point - a);
    // On a shared edge or corner the distances are equal: the facet seen most squarely decides inside or outside.
    const bool is_closer = found.distance < best.distance - 1e-9;
    const bool is_squarer = found.distance < best.distance + 1e-9 && std::abs(height) > std::abs(best.height);
    if (height >= -ignored_depth && (is_closer || is_squarer))
      best = {f, found.distance, height, facing * border_weight(found.barycentric, facet.is_border),
              found.barycentric};
  }
  return best;
}

Eigen::Vector2d reference_coordinates(const ContactFacet &facet, int n_nodes, const Eigen::Vector3d &barycentric)
{
  Eigen::Vector2d at = Eigen::Vector2d::Zero();
  for (int k = 0; k < 3; ++k)
    at += barycentric[k] * face_node_coordinates(n_nodes, facet.nodes[k]);
  return at;
}
} // namespace

PenaltyContact::PenaltyContact(std::vector<ContactFaces> surfaces, const std::vector<std::pair<int, int>> &pairs,
                               const ContactOptions &options)
    : options_(options)
{
  for (ContactFaces &faces : surfaces)
    surfaces_.emplace_back(std::move(faces));
  for (const auto &[a, b] : pairs)
    for (const auto &[point_side, face_side] : {std::pair{a, b}, std::pair{b, a}})
      passes_.push_back({point_side, face_side, std::vector<double>(surfaces_[point_side].points().size(), 0)});

  FacePositions rest;
  for (const ContactSurface &surface : surfaces_)
    rest.push_back(surface.rest_positions());
  adopt(find_pairings(rest));
  const std::vector<std::vector<double>> rest_gaps = gaps(rest);
  for (std::size_t p = 0; p < passes_.size(); ++p)
    for (std::size_t i = 0; i < rest_gaps[p].size(); ++i)
      passes_[p].clearance[i] = options_.onset - rest_gaps[p][i];
  face_pairs_.clear();
}

// --- search ---------------------------------------------------------------------------------------------------------

std::vector<PenaltyContact::Pairing> PenaltyContact::find_pairings(const FacePositions &x) const
{
  std::vector<Pairing> pairings;
  for (std::size_t p = 0; p < passes_.size(); ++p)
    find_pairings_of_pass(static_cast<int>(p), x, pairings);
  return pairings;
}

void PenaltyContact::find_pairings_of_pass(int pass, const FacePositions &x, std::vector<Pairing> &pairings) const
{
  const ContactSurface &own = surfaces_[passes_[pass].point_side], &other = surfaces_[passes_[pass].face_side];
  const std::vector<Eigen::Matrix3Xd> &own_x = x[passes_[pass].point_side], &other_x = x[passes_[pass].face_side];
  const FacetTree tree = other.tree(other_x);
  std::vector<int> candidates;
  for (std::size_t i = 0; i < own.points().size(); ++i)
  {
    const ContactPoint &at = own.points()[i];
    const Eigen::Matrix3Xd &nodes = own_x[at.face];
    const Eigen::Vector3d point = nodes * at.shape;
    tree.candidates(point, options_.search_distance, candidates);
    if (candidates.empty())
      continue;
    const Eigen::Vector3d normal = Eigen::Vector3d(nodes * at.d_xi).cross(nodes * at.d_eta).normalized();
    const SeenFacet seen =
        closest_facing_facet(point, normal, other, other_x, candidates, options_.search_distance);
    if (seen.facet < 0 || seen.weight == 0)
      continue;
    const ContactFacet &facet = other.facets()[seen.facet];
    const int n_nodes = static_cast<int>(other_x[facet.face].cols());
    pairings.push_back({pass, at.face, facet.face,
                        {static_cast<int>(i), reference_coordinates(facet, n_nodes, seen.barycentric), seen.weight}});
  }
}

bool PenaltyContact::adopt(std::vector<Pairing> pairings)
{
  const auto key = [](const auto &p) { return std::tuple(p.pass, p.own_face, p.other_face); };
  std::stable_sort(pairings.begin(), pairings.end(),
                   [&](const Pairing &a, const Pairing &b) { return key(a) < key(b); });
  std::vector<FacePair> found;
  for (const Pairing &pairing : pairings)
  {
    if (found.empty() || key(found.back()) != key(pairing))
      found.push_back({pairing.pass, pairing.own_face, pairing.other_face, {}});
    found.back().points.push_back(pairing.point);
  }
  // Face pairs that are known already keep their places, so that the sparsity pattern serves on.
  for (FacePair &pair : face_pairs_)
    pair.points.clear();
  auto known = face_pairs_.begin();
  for (FacePair &pair : found)
  {
    known = std::lower_bound(known, face_pairs_.end(), pair,
                             [&](const FacePair &a, const FacePair &b) { return key(a) < key(b); });
    if (known == face_pairs_.end() || key(*known) != key(pair))
    {
      face_pairs_ = std::move(found);
      return true;
    }
    known->points = pair.points;
  }
  return false;
}

bool PenaltyContact::search(const Eigen::VectorXd &solution)
{
  const FacePositions x = positions(solution);
  const std::vector<std::vector<double>> before = gaps(x);
  pattern_changed_ = adopt(find_pairings(x)) || pattern_changed_;
  const std::vector<std::vector<double>> after = gaps(x);
  for (std::size_t p = 0; p < passes_.size(); ++p)
    for (std::size_t i = 0; i < before[p].size(); ++i)
      if (!(std::abs(before[p][i] - after[p][i]) <= options_.settled_gap))
        return true;
  return false;
}

bool PenaltyContact::update(const Eigen::VectorXd &)
{
  return std::exchange(pattern_changed_, false);
}

// --- gaps -----------------------------------------------------------------------------------------------------------

PenaltyContact::FacePositions PenaltyContact::positions(const Eigen::VectorXd &solution) const
{
  FacePositions x;
  for (const ContactSurface &surface : surfaces_)
    x.push_back(surface.positions(solution));
  return x;
}

const ContactPoint &PenaltyContact::contact_point(const FacePair &pair, const PairedPoint &point) const
{
  return surfaces_[passes_[pair.pass].point_side].points()[point.point];
}

double PenaltyContact::gap(const FacePair &pair, const PairedPoint &point, const FacePositions &x) const
{
  const Pass &pass = passes_[pair.pass];
  const Eigen::Vector3d at = x[pass.point_side][pair.own_face] * contact_point(pair, point).shape;
  const FaceProjection projection = project(x[pass.face_side][pair.other_face], at, point.start);
  return projection.converged ? projection.gap + pass.clearance[point.point] : options_.onset;
}

std::vector<std::vector<double>> PenaltyContact::gaps(const FacePositions &x) const
{
  std::vector<std::vector<double>> found;
  for (const Pass &pass : passes_)
    found.emplace_back(pass.clearance.size(), options_.onset);
  for (const FacePair &pair : face_pairs_)
    for (const PairedPoint &point : pair.points)
      found[pair.pass][point.point] = std::min(options_.onset, gap(pair, point, x));
  return found;
}

ContactPenetration PenaltyContact::deepest_penetration(const Eigen::VectorXd &solution) const
{
  const FacePositions x = positions(solution);
  ContactPenetration deepest;
  for (const FacePair &pair : face_pairs_)
    for (const PairedPoint &point : pair.points)
    {
      const Pass &pass = passes_[pair.pass];
      const double clearance = pass.clearance[point.point];
      const double depth = clearance - gap(pair, point, x) - std::max(0., clearance - options_.onset);
      if (point.weight >= 0.5 && depth > deepest.depth)
        deepest = {depth, surfaces_[pass.point_side].part(), surfaces_[pass.face_side].part(),
                   x[pass.point_side][pair.own_face] * contact_point(pair, point).shape};
    }
  return deepest;
}

std::vector<ContactTraction> PenaltyContact::tractions(const Eigen::VectorXd &solution) const
{
  const FacePositions x = positions(solution);
  std::vector<ContactTraction> found;
  for (const FacePair &pair : face_pairs_)
    for (const PairedPoint &point : pair.points)
    {
      const ContactPoint &at = contact_point(pair, point);
      const Pass &pass = passes_[pair.pass];
      const double g = gap(pair, point, x);
      if (at.area == 0 || !(g < options_.onset))
        continue;
      const double clearance = pass.clearance[point.point];
      found.push_back({surfaces_[pass.point_side].part(), surfaces_[pass.face_side].part(),
                       x[pass.point_side][pair.own_face] * at.shape,
                       -options_.penalty * point.weight * contact_law(g, options_.onset, options_.stiffening).d_energy, at.area,
                       clearance - g - std::max(0., clearance - options_.onset)});
    }
  return found;
}

int PenaltyContact::n_in_contact(const Eigen::VectorXd &solution) const
{
  return static_cast<int>(tractions(solution).size());
}

// --- term -----------------------------------------------------------------------------------------------------------

std::vector<SurfaceNode> PenaltyContact::nodes(const FacePair &pair) const
{
  std::vector<SurfaceNode> both = surfaces_[passes_[pair.pass].point_side].faces()[pair.own_face].nodes;
  const std::vector<SurfaceNode> &other = surfaces_[passes_[pair.pass].face_side].faces()[pair.other_face].nodes;
  both.insert(both.end(), other.begin(), other.end());
  return both;
}

void PenaltyContact::unknowns(int item, std::vector<int> &indices) const
{
  indices.clear();
  append_unknowns(nodes(face_pairs_[item]), indices);
}

void PenaltyContact::evaluate(int item, const Eigen::VectorXd &solution, LocalSystem &local) const
{
  const FacePair &pair = face_pairs_[item];
  const std::vector<SurfaceNode> both = nodes(pair);
  const Eigen::Matrix3Xd x = reference_fe::positions(both, solution);
  const auto n_own =
      static_cast<Eigen::Index>(surfaces_[passes_[pair.pass].point_side].faces()[pair.own_face].nodes.size());
  const Eigen::Matrix3Xd own = x.leftCols(n_own), other = x.rightCols(x.cols() - n_own);

  Eigen::VectorXd force = Eigen::VectorXd::Zero(x.size());
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(x.size(), x.size());
  local.energy = 0;
  int n_acting = 0;
  for (const PairedPoint &paired : pair.points)
  {
    const ContactPoint &point = contact_point(pair, paired);
    if (point.area == 0)
      continue;
    const FaceProjection projection = project(other, own * point.shape, paired.start);
    const double gap = projection.gap + passes_[pair.pass].clearance[paired.point];
    if (!projection.converged || gap >= options_.onset)
      continue;
    ++n_acting;
    const ContactLaw law = contact_law(gap, options_.onset, options_.stiffening);
    const double scale = 0.5 * options_.penalty * paired.weight * point.area; // both passes together count once
    const GapDerivatives d = gap_derivatives(projection, point.shape);
    local.energy += scale * law.energy;
    force += scale * law.d_energy * d.gradient;
    if (!local.with_tangent)
      continue;
    stiffness.noalias() += (scale * law.d2_energy * d.gradient) * d.gradient.transpose();
    stiffness.noalias() += (scale * law.d_energy * d.basis) * (d.coupling * d.basis.transpose());
  }
  unknowns(item, local.unknowns);
  if (n_acting > 0)
    return to_unknowns(both, solution, force, stiffness, 0, local);
  local.residual.setZero(static_cast<Eigen::Index>(local.unknowns.size()));
  local.tangent.resize(0, 0);
}
} // namespace pelvireg::reference_fe
