#include "tests/benchmark/table1_scene.h"

#include "validation/runner/table_one.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace pelvireg::bench
{
namespace
{
using namespace registration;

/// An organ's outer surface, mm.
struct Ellipsoid
{
  Eigen::Vector3d centre, half_axes;
};

constexpr double wall = 3;                                                 // mm
const std::array<Ellipsoid, 4> organs = {{{{0, 34, 40}, {17, 10, 38}},     // vagina
                                          {{0, 40, 96}, {24, 22, 21}},     // uterus
                                          {{0, 0, 62}, {33, 26.5, 27}},    // bladder
                                          {{0, 62.3, 46}, {20, 19, 40}}}}; // rectum
constexpr std::array<const char *, 7> names = {"vagina",        "uterus",        "bladder",  "rectum",
                                               "fascia pelvis", "fascia sacrum", "ligaments"};
constexpr std::array<double, 7> moduli = {0.66, 0.6, 0.24, 0.54, 0.03, 0.03, 0.78}; // MPa, Table 1

/// The grid na x nb, na between `least` and `most` times nb, for which n(na, nb) is nearest to `wanted`.
template <class Number> std::pair<int, int> nearest_grid(double wanted, double least, double most, const Number &n)
{
  std::pair<int, int> best;
  double least_error = std::numeric_limits<double>::infinity();
  for (int b = 3; b < 400; ++b)
    for (int a = std::max(2, static_cast<int>(least * b)); a <= most * b + 1; ++a)
      if (const double error = std::abs(n(a, b) - wanted); error < least_error)
      {
        least_error = error;
        best = {a, b};
      }
  return best;
}

void orient(Body &body)
{
  for (Eigen::Index t = 0; t < body.tets.rows(); ++t)
  {
    const auto corner = [&](int a) -> Eigen::RowVector3d { return body.rest_positions.row(body.tets(t, a)); };
    if ((corner(1) - corner(0)).cross(corner(2) - corner(0)).dot(corner(3) - corner(0)) < 0)
      std::swap(body.tets(t, 2), body.tets(t, 3));
  }
}

/// Rings of quadrilaterals between two poles, split; triangles face outward.
std::vector<std::array<int, 3>> sphere_triangles(int n_rings, int n_segments)
{
  std::vector<std::array<int, 3>> triangles;
  const auto index = [&](int ring, int segment) { return ring * n_segments + segment % n_segments; };
  const int bottom = n_rings * n_segments, top = bottom + 1;
  for (int s = 0; s < n_segments; ++s)
  {
    triangles.push_back({bottom, index(0, s + 1), index(0, s)});
    triangles.push_back({top, index(n_rings - 1, s), index(n_rings - 1, s + 1)});
    for (int r = 0; r + 1 < n_rings; ++r)
    {
      triangles.push_back({index(r, s), index(r, s + 1), index(r + 1, s)});
      triangles.push_back({index(r, s + 1), index(r + 1, s + 1), index(r + 1, s)});
    }
  }
  return triangles;
}

Body hollow_organ(const Ellipsoid &shape, double n_nodes)
{
  const auto [n_rings, n_segments] =
      nearest_grid(n_nodes, 0.5, 1.5, [](int rings, int segments) { return 2.0 * (rings * segments + 2); });
  const std::vector<std::array<int, 3>> triangles = sphere_triangles(n_rings, n_segments);
  const int n = n_rings * n_segments + 2;
  Body body;
  body.rest_positions.resize(2 * n, 3);
  for (int i = 0; i < n; ++i)
  {
    const double height =
        i >= n - 2 ? (i == n - 2 ? -1.0 : 1.0) : -std::cos(std::numbers::pi * (i / n_segments + 1) / (n_rings + 1));
    const double angle = 2 * std::numbers::pi * (i % n_segments) / n_segments;
    const double radius = std::sqrt(1 - height * height);
    const Eigen::Vector3d direction(radius * std::cos(angle), radius * std::sin(angle), height);
    const Eigen::Vector3d inner = shape.half_axes.array() - wall;
    body.rest_positions.row(i) = (shape.centre + shape.half_axes.cwiseProduct(direction)).transpose();
    body.rest_positions.row(n + i) = (shape.centre + inner.cwiseProduct(direction)).transpose();
  }
  body.outer_triangles.resize(static_cast<Eigen::Index>(triangles.size()), 3);
  body.tets.resize(3 * body.outer_triangles.rows(), 4);
  for (Eigen::Index t = 0; t < body.outer_triangles.rows(); ++t)
  {
    std::array<int, 3> v = triangles[static_cast<std::size_t>(t)];
    body.outer_triangles.row(t) << v[0], v[1], v[2];
    std::sort(v.begin(), v.end()); // prism split by ascending corner: neighbours agree on the shared diagonals
    body.tets.row(3 * t) << v[0], v[1], v[2], n + v[2];
    body.tets.row(3 * t + 1) << v[0], v[1], n + v[1], n + v[2];
    body.tets.row(3 * t + 2) << v[0], n + v[0], n + v[1], n + v[2];
  }
  body.is_wall.assign(triangles.size(), 1);
  orient(body);
  return body;
}

/// Nodes and cells of boxes of na x nb x nc nodes, each placed by `position(grid, i / (na - 1), …)`.
template <class Position>
void add_grid(Body &body, std::vector<std::array<int, 8>> &cells, const Eigen::Vector3i &n, const Position &position)
{
  const int before = static_cast<int>(body.rest_positions.rows());
  body.rest_positions.conservativeResize(before + n.prod(), 3);
  const auto index = [&](int i, int j, int k) { return before + i + n[0] * (j + n[1] * k); };
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i)
      {
        const Eigen::Vector3d at = Eigen::Vector3d(i, j, k).cwiseQuotient((n.array() - 1).matrix().cast<double>());
        body.rest_positions.row(index(i, j, k)) = position(at).transpose();
        if (i > 0 && j > 0 && k > 0)
          cells.push_back({index(i - 1, j - 1, k - 1), index(i, j - 1, k - 1), index(i, j, k - 1),
                           index(i - 1, j, k - 1), index(i - 1, j - 1, k), index(i, j - 1, k), index(i, j, k),
                           index(i - 1, j, k)});
      }
}

void set_boundary(Body &body)
{
  std::map<std::array<int, 3>, std::array<int, 3>> open;
  constexpr int faces[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
  for (Eigen::Index t = 0; t < body.tets.rows(); ++t)
    for (const auto &face : faces)
    {
      const std::array<int, 3> oriented{body.tets(t, face[0]), body.tets(t, face[1]), body.tets(t, face[2])};
      std::array<int, 3> key = oriented;
      std::sort(key.begin(), key.end());
      if (!open.erase(key))
        open[key] = oriented;
    }
  body.outer_triangles.resize(static_cast<Eigen::Index>(open.size()), 3);
  Eigen::Index row = 0;
  for (const auto &[key, oriented] : open)
    body.outer_triangles.row(row++) << oriented[0], oriented[1], oriented[2];
  body.is_wall.assign(open.size(), 1);
}

/// A cube blown up to the ellipsoid: every layer of the cube becomes a layer of the ball.
Body solid_organ(const Ellipsoid &shape, double n_nodes)
{
  const auto [n_across, n_along] =
      nearest_grid(n_nodes, 0.75, 1.35, [](int across, int along) { return 1.0 * across * across * along; });
  Body body;
  std::vector<std::array<int, 8>> cells;
  add_grid(body, cells, {n_across, n_across, n_along},
           [&](const Eigen::Vector3d &at) -> Eigen::Vector3d
           {
             const Eigen::Vector3d cube = 2 * at - Eigen::Vector3d::Ones();
             const double layer = cube.cwiseAbs().maxCoeff();
             // Between a cube and a ball: a full ball would flatten the cells along the cube's edges.
             const Eigen::Vector3d ball = layer > 0 ? Eigen::Vector3d(cube * layer / cube.norm()) : cube;
             return shape.centre + shape.half_axes.cwiseProduct(0.85 * ball + 0.15 * cube / std::sqrt(3.0));
           });
  constexpr int kuhn[6][4] = {{0, 1, 2, 6}, {0, 2, 3, 6}, {0, 3, 7, 6}, {0, 7, 4, 6}, {0, 4, 5, 6}, {0, 5, 1, 6}};
  body.tets.resize(6 * static_cast<Eigen::Index>(cells.size()), 4);
  for (std::size_t cell = 0; cell < cells.size(); ++cell)
    for (int t = 0; t < 6; ++t)
      for (int a = 0; a < 4; ++a)
        body.tets(6 * static_cast<Eigen::Index>(cell) + t, a) = cells[cell][kuhn[t][a]];
  orient(body);
  set_boundary(body);
  return body;
}

void set_hexes(Body &body, const std::vector<std::array<int, 8>> &cells)
{
  body.hexes.resize(static_cast<Eigen::Index>(cells.size()), 8);
  for (Eigen::Index cell = 0; cell < body.hexes.rows(); ++cell)
    for (int a = 0; a < 8; ++a)
      body.hexes(cell, a) = cells[static_cast<std::size_t>(cell)][a];
}

/// A sheet 2 mm thick, width x height, along y from `origin`; its far end is fixed.
Body fascia(const Eigen::Vector3d &origin, double length, double n_nodes)
{
  const auto [n_along, n_up] = nearest_grid(n_nodes, 0.4, 1.1, [](int along, int up) { return 2.0 * along * up; });
  Body body;
  std::vector<std::array<int, 8>> cells;
  add_grid(body, cells, {2, n_along, n_up},
           [&](const Eigen::Vector3d &at) -> Eigen::Vector3d
           { return origin + Eigen::Vector3d(2 * at[0] - 1, length * at[1], 40 * at[2]); });
  if (length < 0) // the grid is mirrored: turn its cells
    for (std::array<int, 8> &c : cells)
      c = {c[4], c[5], c[6], c[7], c[0], c[1], c[2], c[3]};
  set_hexes(body, cells);
  for (int node = 0; node < body.rest_positions.rows(); ++node)
    if (std::abs(body.rest_positions(node, 1) - origin[1]) > std::abs(length) - 1e-9)
      body.fixed_nodes.push_back(node);
  return body;
}

/// Five bands of 4 x 4 mm from the side walls to vagina and uterus, of 2 x 2 nodes across (more when there are many).
Body ligaments(double n_nodes)
{
  const Eigen::Vector3d starts[5] = {{60, 34, 40}, {-60, 34, 40}, {60, 40, 80}, {-60, 40, 80}, {0, 100, 88}};
  const Eigen::Vector3d ends[5] = {{17, 34, 40}, {-17, 34, 40}, {16, 36, 80}, {-16, 36, 80}, {0, 60, 88}};
  const auto [n_across, n_along] =
      nearest_grid(n_nodes / 5, 0.05, 0.25, [](int across, int along) { return 1.0 * across * across * along; });
  Body body;
  std::vector<std::array<int, 8>> cells;
  for (int band = 0; band < 5; ++band)
  {
    const Eigen::Vector3d along = ends[band] - starts[band];
    const Eigen::Vector3d across = along.cross(Eigen::Vector3d::UnitZ()).normalized();
    const int before = static_cast<int>(body.rest_positions.rows());
    add_grid(body, cells, {n_along, n_across, n_across},
             [&](const Eigen::Vector3d &at) -> Eigen::Vector3d {
               return starts[band] + at[0] * along - 4 * (at[1] - 0.5) * across +
                      4 * (at[2] - 0.5) * Eigen::Vector3d::UnitZ();
             });
    for (int k = 0; k < n_across * n_across; ++k)
      body.fixed_nodes.push_back(before + k * n_along);
  }
  set_hexes(body, cells);
  return body;
}

/// The n nodes of a body that lie nearest to the outer surface of an organ, and not on fixed nodes.
std::vector<int> nearest_nodes(const Body &body, const Ellipsoid &organ, int n)
{
  std::vector<std::pair<double, int>> by_distance;
  for (int node = 0; node < body.rest_positions.rows(); ++node)
    if (std::find(body.fixed_nodes.begin(), body.fixed_nodes.end(), node) == body.fixed_nodes.end())
    {
      const Eigen::Vector3d offset = body.rest_positions.row(node).transpose() - organ.centre;
      by_distance.emplace_back(std::abs(offset.cwiseQuotient(organ.half_axes).norm() - 1), node);
    }
  std::sort(by_distance.begin(), by_distance.end());
  std::vector<int> nodes;
  for (int k = 0; k < n; ++k)
    nodes.push_back(by_distance[static_cast<std::size_t>(k)].second);
  return nodes;
}

/// Points of the ellipse that the plane x = 1 cuts from the organ, moved.
OutlineObservation outline_of(int body, int n_points, const Eigen::Vector3d &motion)
{
  const Ellipsoid &organ = organs[static_cast<std::size_t>(body)];
  const double across = (1 - organ.centre[0]) / organ.half_axes[0];
  const double shrunk = std::sqrt(1 - across * across);
  OutlineObservation outline;
  outline.body = body;
  outline.points.resize(n_points, 3);
  outline.normals.resize(n_points, 3);
  for (int k = 0; k < n_points; ++k)
  {
    const double angle = 2 * std::numbers::pi * (k + 0.5) / n_points;
    const Eigen::Vector3d on_ball(across, shrunk * std::cos(angle), shrunk * std::sin(angle));
    Eigen::Vector3d normal = on_ball.cwiseQuotient(organ.half_axes);
    normal[0] = 0;
    outline.points.row(k) = (organ.centre + organ.half_axes.cwiseProduct(on_ball) + motion).transpose();
    outline.normals.row(k) = normal.normalized().transpose();
  }
  return outline;
}

/// Down and back by up to 5 mm and forth again, as the built-in cases move: 15 positions of 3 steps.
std::vector<Observation> play()
{
  constexpr std::array<int, 4> n_points = {18, 16, 18, 18};
  constexpr int n_positions = 15, steps_per_position = 3;
  std::vector<Observation> observations;
  for (int position = 0; position < n_positions; ++position)
  {
    const double s = std::sin(std::numbers::pi * (position + 0.5) / n_positions);
    Observation observation;
    observation.plane_origin = {1, 0, 0};
    for (int organ = 0; organ < 4; ++organ)
      observation.outlines.push_back(outline_of(organ, n_points[static_cast<std::size_t>(organ)], {0, 3 * s, -4 * s}));
    observations.insert(observations.end(), steps_per_position, observation);
  }
  return observations;
}
/// The lower ends of vagina, bladder and rectum are held, as in the pelvis: they would turn out of the image otherwise.
void hold_lower_end(Body &body)
{
  const double bottom = body.rest_positions.col(2).minCoeff(), top = body.rest_positions.col(2).maxCoeff();
  for (int node = 0; node < body.rest_positions.rows(); ++node)
    if (body.rest_positions(node, 2) < bottom + 0.02 * (top - bottom))
      body.fixed_nodes.push_back(node);
}

/// Neighbouring organs may touch, in a registration that knows contact.
template <class AnyModel> void add_contact_pairs(AnyModel &model)
{
  if constexpr (requires { model.contact_pairs; })
    model.contact_pairs = {{0, 2}, {0, 3}, {1, 2}, {1, 3}};
}
} // namespace

Counts table1_counts(const std::string &data_set)
{
  for (const runner::TableOneColumn &column : runner::table_one)
    if (data_set == column.data_set)
    {
      Counts counts;
      std::copy(column.nodes.begin(), column.nodes.end(), counts.begin());
      return counts;
    }
  throw std::invalid_argument("data set '" + data_set + "' is not in Table 1; T005 and T007 are");
}

Scene table1_scene(const Counts &counts, double scale)
{
  Scene scene;
  std::vector<Body> &bodies = scene.model.bodies;
  bodies = {hollow_organ(organs[0], scale * counts[0]),
            solid_organ(organs[1], scale * counts[1]),
            hollow_organ(organs[2], scale * counts[2]),
            hollow_organ(organs[3], scale * counts[3]),
            fascia({0, -26, 45}, -25, scale * counts[4]),
            fascia({0, 80, 40}, 25, scale * counts[5]),
            ligaments(scale * counts[6])};
  for (std::size_t k = 0; k < bodies.size(); ++k)
  {
    bodies[k].name = names[k];
    bodies[k].youngs_modulus = moduli[k];
  }
  for (const int organ : {0, 2, 3})
    hold_lower_end(bodies[organ]);
  scene.model.attachments = {{"uterus on vagina", 1, nearest_nodes(bodies[1], organs[0], 8), 0, 0},
                             {"fascia pelvis on bladder", 4, nearest_nodes(bodies[4], organs[2], 8), 2, 0},
                             {"fascia sacrum on rectum", 5, nearest_nodes(bodies[5], organs[3], 8), 3, 0},
                             {"ligaments on vagina", 6, nearest_nodes(bodies[6], organs[0], 8), 0, 0},
                             {"ligaments on uterus", 6, nearest_nodes(bodies[6], organs[1], 8), 1, 0}};
  add_contact_pairs(scene.model);
  scene.observations = play();
  return scene;
}
} // namespace pelvireg::bench
