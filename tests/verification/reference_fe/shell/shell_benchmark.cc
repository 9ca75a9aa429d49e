#include "tests/verification/reference_fe/shell/shell_benchmark.h"

#include "reference_fe/constraints/dead_load.h"
#include "reference_fe/elements/shell_mesh.h"

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace pelvireg::reference_fe
{
ShellBody structured_shell(int n1, int n2, int order, double thickness, const SurfaceMap &map,
                           Eigen::Matrix2Xd &parameters)
{
  dealii::Triangulation<2, 3> triangulation;
  // Built in the plane and lifted: deal.II has this generator for dim = spacedim only.
  dealii::Triangulation<2> flat;
  dealii::GridGenerator::subdivided_hyper_rectangle(flat, {unsigned(n1), unsigned(n2)}, dealii::Point<2>(0, 0),
                                                    dealii::Point<2>(1, 1));
  dealii::GridGenerator::flatten_triangulation(flat, triangulation);
  ShellBody body = shell_body(triangulation, "patch", order, thickness);
  parameters = body.midsurface.topRows<2>();
  for (int node = 0; node < body.n_nodes(); ++node)
    body.midsurface.col(node) = map(parameters(0, node), parameters(1, node));
  body.director = averaged_normals(body);
  return body;
}

ShellBody flat_shell(const Eigen::Matrix2Xd &vertices, const Eigen::Matrix4Xi &cells, int order, double thickness)
{
  std::vector<dealii::Point<3>> points;
  for (Eigen::Index k = 0; k < vertices.cols(); ++k)
    points.emplace_back(vertices(0, k), vertices(1, k), 0);
  std::vector<dealii::CellData<2>> cell_data(cells.cols());
  for (Eigen::Index cell = 0; cell < cells.cols(); ++cell)
    for (int k = 0; k < 4; ++k)
      cell_data[cell].vertices[k] = cells(k, cell);
  dealii::GridTools::consistently_order_cells(cell_data); // order 3 has two nodes an edge
  dealii::Triangulation<2, 3> triangulation;
  triangulation.create_triangulation(points, cell_data, {});
  return shell_body(triangulation, "patch", order, thickness);
}

ShellBody sphere_shell(int refinements, double radius, double thickness)
{
  dealii::Triangulation<2, 3> sphere;
  dealii::GridGenerator::hyper_sphere(sphere, dealii::Point<3>(), radius);
  sphere.refine_global(refinements);
  return shell_body(sphere, "sphere", 2, thickness);
}

std::vector<std::pair<int, double>> edge_weights(const ShellBody &body, const Eigen::Matrix2Xd &parameters,
                                                 const std::function<double(double, double)> &distance,
                                                 const std::function<double(double, double)> &along)
{
  std::vector<std::pair<double, int>> nodes;
  for (int node = 0; node < body.n_nodes(); ++node)
    if (std::abs(distance(parameters(0, node), parameters(1, node))) < 1e-9)
      nodes.push_back({along(parameters(0, node), parameters(1, node)), node});
  std::sort(nodes.begin(), nodes.end());
  const std::vector<std::vector<double>> rule = {
      {}, {0.5, 0.5}, {1. / 6, 4. / 6, 1. / 6}, {1. / 12, 5. / 12, 5. / 12, 1. / 12}};
  const std::size_t p = body.order, n_cells = (nodes.size() - 1) / p;
  std::vector<std::pair<int, double>> weights;
  for (const auto &[position, node] : nodes)
    weights.push_back({node, 0.0});
  for (std::size_t cell = 0; cell < n_cells; ++cell)
    for (std::size_t k = 0; k <= p; ++k)
      weights[cell * p + k].second += rule[p][k] / static_cast<double>(n_cells);
  return weights;
}

SingleShell::SingleShell(int n1, int n2, int order, double thickness, const SurfaceMap &map,
                         std::shared_ptr<const HyperelasticLaw> law, bool mixed_integration_points)
    : body(structured_shell(n1, n2, order, thickness, map, parameters))
{
  first = add_shell_unknowns(system, body);
  system.add_term(std::make_shared<ShellTerm>(body, std::move(law), first, mixed_integration_points));
}

SingleShell::SingleShell(ShellBody shell, Eigen::Matrix2Xd parameters_of_nodes,
                         std::shared_ptr<const HyperelasticLaw> law, bool mixed_integration_points)
    : parameters(std::move(parameters_of_nodes)), body(std::move(shell))
{
  first = add_shell_unknowns(system, body);
  system.add_term(std::make_shared<ShellTerm>(body, std::move(law), first, mixed_integration_points));
}

std::vector<int> SingleShell::nodes_where(const std::function<bool(double, double)> &selects) const
{
  std::vector<int> nodes;
  for (int node = 0; node < body.n_nodes(); ++node)
    if (selects(parameters(0, node), parameters(1, node)))
      nodes.push_back(node);
  return nodes;
}

void SingleShell::fix(const std::vector<int> &nodes, const std::vector<int> &components)
{
  for (const int node : nodes)
    for (const int component : components)
      system.fix(unknown(node, component));
}

int corner(const SingleShell &shell, double s, double t)
{
  return shell.nodes_where([&](double a, double b) { return std::abs(a - s) + std::abs(b - t) < 1e-9; }).at(0);
}

void mirror(SingleShell &shell, const std::vector<int> &nodes, int c)
{
  shell.fix(nodes, {c, 3 + c});
}

SurfaceMap cylinder(double radius, double angle, double length)
{
  return [=](double s, double t)
  { return Eigen::Vector3d(radius * std::sin(angle * s), length * t, radius * std::cos(angle * s)); };
}

SurfaceMap straight_cells(int n1, int n2, const std::function<Eigen::Vector3d(int, int)> &vertex)
{
  return [=](double s, double t)
  {
    const int i = std::min(static_cast<int>(s * n1 + 1e-9), n1 - 1),
              j = std::min(static_cast<int>(t * n2 + 1e-9), n2 - 1);
    const double u = s * n1 - i, v = t * n2 - j;
    return Eigen::Vector3d((1 - u) * (1 - v) * vertex(i, j) + u * (1 - v) * vertex(i + 1, j) +
                           u * v * vertex(i + 1, j + 1) + (1 - u) * v * vertex(i, j + 1));
  };
}

std::vector<std::pair<int, double>> end_force(const SingleShell &shell, int component, double force)
{
  std::vector<std::pair<int, double>> forces;
  for (const auto &[node, weight] : edge_weights(
           shell.body, shell.parameters, [](double s, double) { return s - 1; }, [](double, double t) { return t; }))
    forces.push_back({shell.unknown(node, component), force * weight});
  return forces;
}

Eigen::VectorXd solve_linear(SingleShell &shell, const std::vector<std::pair<int, double>> &forces)
{
  shell.system.add_term(std::make_shared<DeadLoad>(forces));
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(shell.system.n_unknowns());
  shell.system.assemble(rest, true);
  if (!shell.system.factorise())
    throw std::runtime_error("the linear shell problem is singular");
  return shell.system.solve(-shell.system.residual());
}

std::vector<std::vector<double>> read_table(const std::string &file)
{
  std::ifstream in(file);
  if (!in)
    throw std::runtime_error("cannot read " + file);
  std::vector<std::vector<double>> rows;
  bool header = true;
  for (std::string line; std::getline(in, line);)
  {
    if (line.empty() || line[0] == '#')
      continue;
    if (header)
    {
      header = false;
      continue;
    }
    std::istringstream cells(line);
    rows.emplace_back();
    for (std::string cell; std::getline(cells, cell, ',');)
      rows.back().push_back(std::stod(cell));
  }
  return rows;
}
} // namespace pelvireg::reference_fe
