#include "reference_fe/contact/penalty_contact.h"

#include "reference_fe/contact/closest_point.h"
#include "reference_fe/contact/facet_gap.h"
#include "reference_fe/contact/facet_grid.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace pelvireg::reference_fe
{
namespace
{
constexpr double ignored_depth = 1.5; ///< mm: deeper is another wall of a thin organ, not a penetration

Eigen::Vector3d facet_normal(const Eigen::Matrix3Xd &x, const std::array<int, 3> &facet)
{
  return (x.col(facet[1]) - x.col(facet[0])).cross(x.col(facet[2]) - x.col(facet[0]));
}

Eigen::Matrix3Xd vertex_normals(const Eigen::Matrix3Xd &x, const std::vector<std::array<int, 3>> &facets)
{
  Eigen::Matrix3Xd normals = Eigen::Matrix3Xd::Zero(3, x.cols());
  for (const std::array<int, 3> &facet : facets)
    for (const int v : facet)
      normals.col(v) += facet_normal(x, facet);
  return normals;
}

Eigen::Matrix3Xd rest_positions(const std::vector<SurfaceNode> &nodes)
{
  Eigen::Matrix3Xd x(3, nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i)
    x.col(static_cast<Eigen::Index>(i)) = nodes[i].rest_position();
  return x;
}

std::vector<double> vertex_areas(const ContactSurface &surface)
{
  const Eigen::Matrix3Xd x = rest_positions(surface.vertices);
  std::vector<double> areas(surface.vertices.size(), 0);
  for (const std::array<int, 3> &facet : surface.facets)
    for (const int v : facet)
      areas[v] += facet_normal(x, facet).norm() / 6;
  return areas;
}

std::vector<std::array<bool, 3>> border_edges(const std::vector<std::array<int, 3>> &facets)
{
  std::map<std::pair<int, int>, int> count;
  const auto edge = [](const std::array<int, 3> &facet, int k) { return std::minmax({facet[k], facet[(k + 1) % 3]}); };
  for (const std::array<int, 3> &facet : facets)
    for (int k = 0; k < 3; ++k)
      ++count[edge(facet, k)];
  std::vector<std::array<bool, 3>> border;
  for (const std::array<int, 3> &facet : facets)
    border.push_back({count[edge(facet, 0)] == 1, count[edge(facet, 1)] == 1, count[edge(facet, 2)] == 1});
  return border;
}

double smooth_step(double t)
{
  t = std::clamp(t, 0., 1.);
  return t * t * (3 - 2 * t);
}

/// How far a vertex counts as facing a facet, from 0 at 107 degrees between the outward normals to 1 at 127 degrees:
/// where an edge rubs along a wall (the hiatus along the rectum), pairs come and go gently.
double facing_weight(double cosine)
{
  return smooth_step((-cosine - 0.3) / 0.3);
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

} // namespace

ContactLaw contact_law(double gap, double onset)
{
  if (gap >= onset)
    return {};
  if (gap <= -onset)
    return {0.5 * gap * gap + onset * onset / 6, gap, 1};
  const double depth = onset - gap;
  return {depth * depth * depth / (12 * onset), -depth * depth / (4 * onset), depth / (2 * onset)};
}

PenaltyContact::PenaltyContact(std::vector<ContactSurface> surfaces, const std::vector<std::pair<int, int>> &pairs,
                               const ContactOptions &options)
    : surfaces_(std::move(surfaces)), options_(options)
{
  for (const ContactSurface &surface : surfaces_)
  {
    vertex_areas_.push_back(vertex_areas(surface));
    border_.push_back(border_edges(surface.facets));
  }
  for (const auto &[a, b] : pairs)
    for (const auto &[vertex_side, facet_side] : {std::pair{a, b}, std::pair{b, a}})
      passes_.push_back({vertex_side, facet_side, std::vector<double>(surfaces_[vertex_side].vertices.size(), 0)});

  std::vector<Eigen::Matrix3Xd> rest;
  for (const ContactSurface &surface : surfaces_)
    rest.push_back(rest_positions(surface.vertices));
  for (std::size_t p = 0; p < passes_.size(); ++p)
  {
    std::vector<Pair> at_rest;
    find_pairs_of_pass(static_cast<int>(p), rest, at_rest);
    for (const Pair &pair : at_rest)
    {
      Eigen::Matrix<double, 3, 4> x;
      for (int k = 0; k < 4; ++k)
        x.col(k) = pair.nodes[k].rest_position();
      passes_[p].clearance[pair.vertex] = std::max(0., options_.onset - facet_gap(x).gap);
    }
  }
}

void PenaltyContact::find_pairs_of_pass(int p, const std::vector<Eigen::Matrix3Xd> &x, std::vector<Pair> &pairs) const
{
  const Pass &pass = passes_[p];
  const ContactSurface &from = surfaces_[pass.vertex_side], &to = surfaces_[pass.facet_side];
  const Eigen::Matrix3Xd &vertices = x[pass.vertex_side], &corners = x[pass.facet_side];
  const Eigen::Matrix3Xd normals = vertex_normals(vertices, from.facets);
  const FacetGrid grid(corners, to.facets, 2 * options_.search_distance);
  std::vector<int> candidates;
  for (int v = 0; v < static_cast<int>(from.vertices.size()); ++v)
  {
    if (vertex_areas_[pass.vertex_side][v] == 0)
      continue;
    const Eigen::Vector3d point = vertices.col(v), own_normal = normals.col(v).normalized();
    grid.candidates(point, options_.search_distance, candidates);
    double best_distance = options_.search_distance, best_height = 0;
    int best = -1;
    double best_weight = 0;
    for (const int f : candidates)
    {
      const std::array<int, 3> &facet = to.facets[f];
      const Eigen::Vector3d normal = facet_normal(corners, facet).normalized();
      const double facing = facing_weight(normal.dot(own_normal));
      if (facing == 0)
        continue;
      const ClosestPoint found =
          closest_point(point, corners.col(facet[0]), corners.col(facet[1]), corners.col(facet[2]));
      const double height = normal.dot(point - corners.col(facet[0]));
      // On a shared edge or corner the distances are equal: the facet seen most squarely decides inside or outside.
      const bool is_closer = found.distance < best_distance - 1e-9;
      const bool is_squarer = found.distance < best_distance + 1e-9 && std::abs(height) > std::abs(best_height);
      if (height < -ignored_depth || !(is_closer || is_squarer))
        continue;
      best_distance = found.distance;
      best_height = height;
      best = f;
      best_weight = facing * border_weight(found.barycentric, border_[pass.facet_side][f]);
    }
    if (best < 0 || best_weight == 0)
      continue;
    const std::array<int, 3> &facet = to.facets[best];
    pairs.push_back({p,
                     v,
                     best,
                     {from.vertices[v], to.vertices[facet[0]], to.vertices[facet[1]], to.vertices[facet[2]]},
                     pass.clearance[v],
                     best_weight * vertex_areas_[pass.vertex_side][v]});
  }
}

std::vector<PenaltyContact::Pair> PenaltyContact::find_pairs(const Eigen::VectorXd &solution) const
{
  std::vector<Eigen::Matrix3Xd> x;
  for (const ContactSurface &surface : surfaces_)
    x.push_back(positions(surface.vertices, solution));
  std::vector<Pair> pairs;
  for (std::size_t p = 0; p < passes_.size(); ++p)
    find_pairs_of_pass(static_cast<int>(p), x, pairs);
  return pairs;
}

double PenaltyContact::gap(const Pair &pair, const Eigen::VectorXd &solution) const
{
  return facet_gap(positions(pair.nodes, solution)).gap + pair.clearance;
}

bool PenaltyContact::search(const Eigen::VectorXd &solution)
{
  std::map<std::pair<int, int>, std::array<double, 2>> gaps; // by pass and vertex: with the old and the new pairs
  const auto note_gaps = [&](const std::vector<Pair> &pairs, int which)
  {
    for (const Pair &pair : pairs)
      if (const double g = gap(pair, solution); g < options_.onset)
        gaps.try_emplace({pair.pass, pair.vertex}, std::array{options_.onset, options_.onset}).first->second[which] = g;
  };
  std::vector<Pair> found = find_pairs(solution);
  note_gaps(pairs_, 0);
  note_gaps(found, 1);
  const bool changed = std::any_of(gaps.begin(), gaps.end(),
                                   [&](const auto &entry)
                                   { return std::abs(entry.second[0] - entry.second[1]) > options_.settled_gap; });
  const auto is_same = [](const Pair &a, const Pair &b)
  { return a.pass == b.pass && a.vertex == b.vertex && a.facet == b.facet; };
  if (!std::equal(found.begin(), found.end(), pairs_.begin(), pairs_.end(), is_same))
    pairs_changed_ = true;
  pairs_ = std::move(found);
  return changed;
}

bool PenaltyContact::update(const Eigen::VectorXd &)
{
  return std::exchange(pairs_changed_, false);
}

double PenaltyContact::deepest_penetration(const Eigen::VectorXd &solution) const
{
  double deepest = 0;
  for (const Pair &pair : pairs_)
  {
    const double rest_overlap = std::max(0., pair.clearance - options_.onset);
    deepest = std::max(deepest, pair.clearance - gap(pair, solution) - rest_overlap);
  }
  return deepest;
}

int PenaltyContact::n_in_contact(const Eigen::VectorXd &solution) const
{
  return static_cast<int>(std::count_if(pairs_.begin(), pairs_.end(),
                                        [&](const Pair &pair) { return gap(pair, solution) < options_.onset; }));
}

void PenaltyContact::unknowns(int item, std::vector<int> &indices) const
{
  indices.clear();
  append_unknowns(pairs_[item].nodes, indices);
}

void PenaltyContact::evaluate(int item, const Eigen::VectorXd &solution, LocalSystem &local) const
{
  const Pair &pair = pairs_[item];
  unknowns(item, local.unknowns);
  const FacetGap found = facet_gap(positions(pair.nodes, solution));
  const ContactLaw law = contact_law(found.gap + pair.clearance, options_.onset);
  const double scale = 0.5 * options_.penalty * pair.area; // both passes together count once
  local.energy = scale * law.energy;
  if (law.d_energy == 0)
  {
    const Eigen::Index n = static_cast<Eigen::Index>(local.unknowns.size());
    local.residual = Eigen::VectorXd::Zero(n);
    local.tangent = Eigen::MatrixXd::Zero(n, n);
    return;
  }
  const Eigen::VectorXd force = scale * law.d_energy * found.gradient;
  const Eigen::MatrixXd stiffness =
      scale * (law.d2_energy * found.gradient * found.gradient.transpose() + law.d_energy * found.hessian);
  to_unknowns(pair.nodes, solution, force, stiffness, 0, local);
}
} // namespace pelvireg::reference_fe
