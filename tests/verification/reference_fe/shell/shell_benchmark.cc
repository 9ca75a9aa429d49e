#include "tests/verification/reference_fe/shell/shell_benchmark.h"

#include "reference_fe/elements/shell_mesh.h"

#include <deal.II/grid/grid_generator.h>

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
