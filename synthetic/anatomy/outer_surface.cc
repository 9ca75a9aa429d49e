#include "synthetic/anatomy/outer_surface.h"

#include "synthetic/dataset/error.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace pelvireg::anatomy
{
using dataset::Integers;
using Eigen::Vector3d;

namespace
{
// Charts compute shared points by different expressions: they agree to round-off, far below this.
constexpr double weld_tolerance = 1e-6; // mm

/// Nodes by position: a point within the tolerance of an earlier one is that node; normals are summed.
class Welder
{
public:
  std::int32_t add(const SurfacePoint &point, double pressure_share = 0)
  {
    const std::array<std::int64_t, 3> cell = cell_of(point.position);
    for (std::int64_t i = -1; i <= 1; ++i)
      for (std::int64_t j = -1; j <= 1; ++j)
        for (std::int64_t k = -1; k <= 1; ++k)
        {
          const auto found = nodes_.find({cell[0] + i, cell[1] + j, cell[2] + k});
          if (found != nodes_.end() &&
              (points_[static_cast<std::size_t>(found->second)].position - point.position).norm() < weld_tolerance)
          {
            points_[static_cast<std::size_t>(found->second)].normal += point.normal;
            return found->second;
          }
        }
    const auto node = static_cast<std::int32_t>(points_.size());
    nodes_[cell] = node;
    points_.push_back(point);
    pressure_shares_.push_back(pressure_share);
    return node;
  }

  Eigen::VectorXd pressure_shares() const
  {
    return Eigen::Map<const Eigen::VectorXd>(pressure_shares_.data(), static_cast<Eigen::Index>(points_.size()));
  }

  void copy_to(dataset::Points &points, dataset::Points &normals) const
  {
    const auto n = static_cast<Eigen::Index>(points_.size());
    points.resize(n, 3);
    normals.resize(n, 3);
    for (Eigen::Index i = 0; i < n; ++i)
    {
      points.row(i) = points_[static_cast<std::size_t>(i)].position.transpose();
      normals.row(i) = points_[static_cast<std::size_t>(i)].normal.normalized().transpose();
    }
  }

private:
  static std::array<std::int64_t, 3> cell_of(const Vector3d &p)
  {
    const auto index = [](double x) { return static_cast<std::int64_t>(std::floor(x / (2 * weld_tolerance))); };
    return {index(p[0]), index(p[1]), index(p[2])};
  }
  std::map<std::array<std::int64_t, 3>, std::int32_t> nodes_;
  std::vector<SurfacePoint> points_;
  std::vector<double> pressure_shares_;
};

/// Node indices of a regular grid of points on one chart, row by row.
std::vector<std::int32_t> weld_grid(const Chart &chart, int n_a, int n_b, Welder &welder)
{
  std::vector<std::int32_t> nodes;
  for (int j = 0; j <= n_b; ++j)
    for (int i = 0; i <= n_a; ++i)
    {
      const SurfacePoint point = chart.evaluate(static_cast<double>(i) / n_a, static_cast<double>(j) / n_b);
      nodes.push_back(welder.add(point, chart.pressure_share ? chart.pressure_share(point) : 0));
    }
  return nodes;
}

/// Is the chart's own (a, b) orientation the outward one?
bool is_outward(const Chart &chart)
{
  const SurfacePoint centre = chart.evaluate(0.5, 0.5);
  const double h = 1e-4;
  const Vector3d da = chart.evaluate(0.5 + h, 0.5).position - centre.position;
  const Vector3d db = chart.evaluate(0.5, 0.5 + h).position - centre.position;
  return da.cross(db).dot(centre.normal) > 0;
}

std::int32_t region_at(const Chart &chart, double a, double b)
{
  return static_cast<std::int32_t>(chart.region(chart.evaluate(a, b)));
}

Integers to_eigen(const std::vector<std::int32_t> &values)
{
  return Eigen::Map<const Integers>(values.data(), static_cast<Eigen::Index>(values.size()));
}

struct BoundaryEdge
{
  std::int32_t middle = -1, end = -1;
};

std::vector<Integers> chain(std::map<std::int32_t, BoundaryEdge> next)
{
  std::vector<Integers> loops;
  while (!next.empty())
  {
    std::vector<std::int32_t> loop;
    const std::int32_t first = next.begin()->first;
    std::int32_t node = first;
    do
    {
      const auto edge = next.find(node);
      if (edge == next.end())
        throw ComputationError("A generated surface has an open boundary chain: charts do not meet.");
      loop.push_back(node);
      if (edge->second.middle >= 0)
        loop.push_back(edge->second.middle);
      node = edge->second.end;
      next.erase(edge);
    } while (node != first);
    loops.push_back(to_eigen(loop));
  }
  return loops;
}
} // namespace

double fade_in(double at, double border, double width)
{
  const double t = std::clamp((at - border) / width + 0.5, 0., 1.);
  return t * t * (3 - 2 * t);
}

void carry_pressure(Chart &chart, const std::function<double(const SurfacePoint &)> &share)
{
  chart.pressure_share = share;
  chart.region = [share](const SurfacePoint &point)
  { return share(point) > 0.5 ? dataset::SurfaceRegion::peritoneal : dataset::SurfaceRegion::wall; };
}

QuadraticMesh quadratic_mesh(const std::vector<Chart> &charts)
{
  Welder welder;
  std::vector<std::array<std::int32_t, 9>> cells;
  std::vector<std::int32_t> regions;
  for (const Chart &chart : charts)
  {
    const std::vector<std::int32_t> grid = weld_grid(chart, 2 * chart.n_a, 2 * chart.n_b, welder);
    const bool outward = is_outward(chart);
    for (int j = 0; j < chart.n_b; ++j)
      for (int i = 0; i < chart.n_a; ++i)
      {
        const auto at = [&](int k, int l)
        {
          return grid[static_cast<std::size_t>((2 * j + (outward ? l : k)) * (2 * chart.n_a + 1) + 2 * i +
                                               (outward ? k : l))];
        };
        cells.push_back({at(0, 0), at(2, 0), at(2, 2), at(0, 2), at(1, 0), at(2, 1), at(1, 2), at(0, 1), at(1, 1)});
        regions.push_back(region_at(chart, (i + 0.5) / chart.n_a, (j + 0.5) / chart.n_b));
      }
  }
  QuadraticMesh mesh;
  welder.copy_to(mesh.points, mesh.normals);
  mesh.pressure_share = welder.pressure_shares();
  mesh.cells.resize(static_cast<Eigen::Index>(cells.size()), 9);
  for (std::size_t c = 0; c < cells.size(); ++c)
    for (int k = 0; k < 9; ++k)
      mesh.cells(static_cast<Eigen::Index>(c), k) = cells[c][static_cast<std::size_t>(k)];
  mesh.region = to_eigen(regions);
  return mesh;
}

TriangleMesh triangle_mesh(const std::vector<Chart> &charts)
{
  Welder welder;
  std::vector<std::array<std::int32_t, 4>> quads;
  std::vector<std::int32_t> regions;
  for (const Chart &chart : charts)
  {
    const std::vector<std::int32_t> grid = weld_grid(chart, chart.n_a, chart.n_b, welder);
    const bool outward = is_outward(chart);
    for (int j = 0; j < chart.n_b; ++j)
      for (int i = 0; i < chart.n_a; ++i)
      {
        const auto at = [&](int k, int l)
        { return grid[static_cast<std::size_t>((j + (outward ? l : k)) * (chart.n_a + 1) + i + (outward ? k : l))]; };
        quads.push_back({at(0, 0), at(1, 0), at(1, 1), at(0, 1)});
        regions.push_back(region_at(chart, (i + 0.5) / chart.n_a, (j + 0.5) / chart.n_b));
      }
  }
  TriangleMesh mesh;
  welder.copy_to(mesh.points, mesh.normals);
  mesh.triangles.resize(2 * static_cast<Eigen::Index>(quads.size()), 3);
  mesh.region.resize(mesh.triangles.rows());
  for (std::size_t q = 0; q < quads.size(); ++q)
  {
    const auto [p, r, s, t] = quads[q];
    const auto row = 2 * static_cast<Eigen::Index>(q);
    // A strict margin keeps the choice the same when both diagonals are equal up to round-off.
    const bool cut_pr =
        (mesh.points.row(p) - mesh.points.row(s)).norm() <= (mesh.points.row(r) - mesh.points.row(t)).norm() + 1e-6;
    mesh.triangles.row(row) = cut_pr ? Eigen::RowVector3i(p, r, s) : Eigen::RowVector3i(p, r, t);
    mesh.triangles.row(row + 1) = cut_pr ? Eigen::RowVector3i(p, s, t) : Eigen::RowVector3i(r, s, t);
    mesh.region[row] = mesh.region[row + 1] = regions[q];
  }
  return mesh;
}

std::vector<Integers> boundary_loops(const dataset::Quads9 &cells)
{
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> edges;
  for (Eigen::Index c = 0; c < cells.rows(); ++c)
    for (int k = 0; k < 4; ++k)
      edges[{cells(c, k), cells(c, (k + 1) % 4)}] = cells(c, 4 + k);
  std::map<std::int32_t, BoundaryEdge> next;
  for (const auto &[edge, middle] : edges)
    if (edges.find({edge.second, edge.first}) == edges.end())
      next[edge.first] = {middle, edge.second};
  return chain(std::move(next));
}

std::vector<Integers> boundary_loops(const dataset::Triangles &triangles)
{
  std::map<std::pair<std::int32_t, std::int32_t>, int> edges;
  for (Eigen::Index c = 0; c < triangles.rows(); ++c)
    for (int k = 0; k < 3; ++k)
      edges[{triangles(c, k), triangles(c, (k + 1) % 3)}] = 1;
  std::map<std::int32_t, BoundaryEdge> next;
  for (const auto &[edge, count] : edges)
    if (edges.find({edge.second, edge.first}) == edges.end())
      next[edge.first] = {-1, edge.second};
  return chain(std::move(next));
}

Vector3d normal_by_differences(const std::function<Vector3d(double, double)> &map, double u, double v, double step_u,
                               double step_v)
{
  const Vector3d du = map(u + step_u, v) - map(u - step_u, v), dv = map(u, v + step_v) - map(u, v - step_v);
  return du.cross(dv).normalized();
}
} // namespace pelvireg::anatomy
