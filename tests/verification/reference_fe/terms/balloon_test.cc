// Balloons and closed tubes filled past their largest pressure, of every hyperelastic law.
#include "reference_fe/constraints/cavity.h"
#include "reference_fe/elements/shell_term.h"
#include "reference_fe/materials/mooney_rivlin.h"
#include "reference_fe/materials/neo_hookean.h"
#include "reference_fe/materials/yeoh.h"
#include "reference_fe/newton_solver.h"
#include "reference_fe/outer_surface.h"
#include "tests/unit/reference_fe/terms/sample_parts.h"
#include "tests/verification/reference_fe/incompressible_wall.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

namespace pelvireg::reference_fe
{
namespace
{
struct Rubber
{
  const char *name;
  IncompressibleEnergy energy;

  std::shared_ptr<const HyperelasticLaw> law(double kappa) const
  {
    if (energy.c01 != 0)
      return std::make_shared<MooneyRivlin>(energy.c10, energy.c01, kappa);
    if (energy.c20 != 0)
      return std::make_shared<Yeoh>(energy.c10, energy.c20, energy.c30, kappa);
    return std::make_shared<NeoHookean>(energy.c10, kappa);
  }
};

/// Soft enough in their higher terms to have a largest pressure.
const Rubber rubbers[] = {{"neo-Hookean", {.c10 = 0.1}},
                          {"Mooney-Rivlin", {.c10 = 0.09, .c01 = 0.01}},
                          {"Yeoh", {.c10 = 0.1, .c20 = 5e-4, .c30 = 1e-6}}};

/// The part of a shell in x, y, z >= 0; its border lies in the mirror planes.
dataset::ReferenceShell octant(const dataset::ReferenceShell &whole)
{
  std::map<int, int> numbers;
  std::vector<int> nodes, cells;
  for (Eigen::Index c = 0; c < whole.cells.rows(); ++c)
  {
    bool inside = true;
    for (int k = 0; k < 9; ++k)
      inside = inside && whole.midsurface.row(whole.cells(c, k)).minCoeff() > -1e-9;
    if (!inside)
      continue;
    cells.push_back(static_cast<int>(c));
    for (int k = 0; k < 9; ++k)
      if (numbers.try_emplace(whole.cells(c, k), static_cast<int>(nodes.size())).second)
        nodes.push_back(whole.cells(c, k));
  }
  dataset::ReferenceShell part = whole;
  part.midsurface = whole.midsurface(nodes, Eigen::all);
  part.directors = whole.directors(nodes, Eigen::all);
  part.thickness = whole.thickness(nodes);
  part.cells = whole.cells(cells, Eigen::all);
  for (Eigen::Index c = 0; c < part.cells.rows(); ++c)
    for (int k = 0; k < 9; ++k)
      part.cells(c, k) = numbers.at(part.cells(c, k));
  part.region = dataset::Integers::Zero(part.cells.rows());
  return part;
}

/// A quarter of a tube about z between the mirror plane z = 0 and z = length, n x 1 cells.
dataset::ReferenceShell quarter_tube(int n, double radius, double length, double thickness)
{
  const int columns = 2 * n + 1;
  dataset::ReferenceShell tube;
  tube.name = "tube";
  tube.material = "wall";
  tube.midsurface.resize(3 * columns, 3);
  tube.directors.resize(3 * columns, 3);
  tube.thickness = Eigen::VectorXd::Constant(3 * columns, thickness);
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < 3; ++j)
    {
      const double angle = std::numbers::pi / 2 * i / (columns - 1);
      const Eigen::RowVector3d outward(std::cos(angle), std::sin(angle), 0);
      tube.midsurface.row(3 * i + j) = radius * outward + Eigen::RowVector3d(0, 0, length * j / 2);
      tube.directors.row(3 * i + j) = outward;
    }
  static constexpr int column[9] = {0, 2, 2, 0, 1, 2, 1, 0, 1}, row[9] = {0, 0, 2, 2, 0, 1, 2, 1, 1};
  tube.cells.resize(n, 9);
  for (int c = 0; c < n; ++c)
    for (int k = 0; k < 9; ++k)
      tube.cells(c, k) = 3 * (2 * c + column[k]) + row[k];
  tube.region = dataset::Integers::Zero(n);
  return tube;
}

/// Stiff springs between unknowns and one other, which all should equal: a flat lid.
class Lid : public Term
{
public:
  Lid(std::vector<int> followers, int leader) : followers_(std::move(followers)), leader_(leader) {}
  std::string name() const override { return "lid"; }
  int n_items() const override { return static_cast<int>(followers_.size()); }
  void unknowns(int item, std::vector<int> &indices) const override { indices = {followers_[item], leader_}; }
  void evaluate(int item, const Eigen::VectorXd &solution, LocalSystem &local) const override
  {
    const double k = 1e6, difference = solution[followers_[item]] - solution[leader_];
    local.residual = Eigen::Vector2d(k * difference, -k * difference);
    local.tangent = (Eigen::Matrix2d() << k, -k, -k, k).finished();
    local.energy = k / 2 * difference * difference;
  }

private:
  std::vector<int> followers_;
  int leader_;
};

/// A shell between mirror planes through the origin, filled with fluid.
struct Balloon
{
  dataset::ReferenceShell shell;
  EquilibriumSystem system;
  int first, pressure, lid;
  std::shared_ptr<Cavity> fluid;
  Eigen::VectorXd solution;

  Balloon(dataset::ReferenceShell part, std::shared_ptr<const HyperelasticLaw> law) : shell(std::move(part))
  {
    const ShellBody body = shell_body(shell);
    first = add_shell_unknowns(system, body);
    system.add_term(std::make_shared<ShellTerm>(body, std::move(law), first));
    lid = system.add_unknowns(3, {"lid"}); // displacement of a point on the axis
    pressure = system.add_unknowns(1, {"fluid pressure", 1e3});
    for (int node = 0; node < n_nodes(); ++node)
      for (int k = 0; k < 3; ++k)
        if (std::abs(shell.midsurface(node, k)) < 1e-9)
          hold_in_plane(node, k);
  }
  int n_nodes() const { return static_cast<int>(shell.midsurface.rows()); }
  void hold_in_plane(int node, int k)
  {
    system.fix(first + n_shell_unknowns * node + k);
    system.fix(first + n_shell_unknowns * node + 3 + k);
  }
  std::vector<SurfaceFace> inner_faces() const
  {
    std::vector<SurfaceFace> faces;
    for (Eigen::Index c = 0; c < shell.cells.rows(); ++c)
      faces.push_back(shell_face(shell, first, c, -1));
    return faces;
  }
  void fill(std::vector<SurfaceFace> faces)
  {
    fluid = std::make_shared<Cavity>("fluid", std::move(faces), pressure);
    system.add_term(fluid);
    solution = Eigen::VectorXd::Zero(system.n_unknowns());
  }
  /// Mean distance of the inner face from the axis or the centre.
  double inner_radius(int n_coordinates) const
  {
    double sum = 0;
    for (int node = 0; node < n_nodes(); ++node)
      sum += shell_node(shell, first, node, -1).position(solution).head(n_coordinates).norm();
    return sum / n_nodes();
  }
  /// Starts from the line through the last two solutions.
  void hold_volume(double ratio)
  {
    const double size = std::cbrt(ratio);
    const Eigen::VectorXd start = solution;
    if (size_before_ < size_)
      solution += (size - size_) / (size_ - size_before_) * (solution - solution_before_);
    solution_before_ = start;
    size_before_ = std::exchange(size_, size);
    fluid->hold_volume(ratio * fluid->rest_volume());
    const NewtonResult result = solve_newton(system, solution, {.residual_tolerance = 1e-9});
    ASSERT_TRUE(result.converged()) << ratio << " " << result.message;
  }

private:
  double size_ = 1, size_before_ = 1;
  Eigen::VectorXd solution_before_;
};

struct Filling
{
  double largest_difference = 0; ///< from the closed form's pressure, relative
  std::vector<double> pressures; ///< MPa
};

constexpr double radius = 20;

Filling fill_sphere(const Rubber &rubber, double kappa_over_mu)
{
  const double thickness = 1, a = radius - thickness / 2, b = radius + thickness / 2;
  Balloon balloon(octant(sphere_shell(4, radius, thickness)), rubber.law(kappa_over_mu * rubber.energy.mu()));
  for (int k = 0; k < 3; ++k)
    balloon.system.fix(balloon.lid + k);
  balloon.fill(balloon.inner_faces());
  Filling filling;
  for (double stretch = 1.025; stretch < 1.76; stretch += 0.025)
  {
    balloon.hold_volume(stretch * stretch * stretch);
    const double found = balloon.solution[balloon.pressure];
    const double expected = sphere_pressure(rubber.energy, balloon.inner_radius(3) / a, a, b);
    filling.largest_difference = std::max(filling.largest_difference, std::abs(found / expected - 1));
    filling.pressures.push_back(found);
  }
  return filling;
}

Filling fill_tube(const Rubber &rubber, double kappa_over_mu)
{
  const double thickness = 2, length = 5, a = radius - thickness / 2, b = radius + thickness / 2;
  const int n = 4;
  Balloon balloon(quarter_tube(n, radius, length, thickness), rubber.law(kappa_over_mu * rubber.energy.mu()));
  SurfaceNode centre;
  centre.first_unknown = balloon.lid;
  centre.rest = Eigen::Vector3d(0, 0, length);
  std::vector<int> followers;
  std::vector<SurfaceNode> rim;
  for (int node = 2; node < balloon.n_nodes(); node += 3)
  {
    followers.push_back(balloon.first + n_shell_unknowns * node + 2);
    balloon.system.fix(followers.back() + 3); // the director stays in the lid's plane
    rim.push_back(shell_node(balloon.shell, balloon.first, node, -1));
  }
  balloon.system.fix(balloon.lid);
  balloon.system.fix(balloon.lid + 1);
  balloon.system.add_term(std::make_shared<Lid>(followers, balloon.lid + 2));
  std::vector<SurfaceFace> faces = balloon.inner_faces();
  for (int i = 0; i + 2 < static_cast<int>(rim.size()); i += 2)
    faces.push_back({{centre, rim[i], rim[i + 1], rim[i + 2]}});
  balloon.fill(faces);
  EXPECT_NEAR(balloon.fluid->rest_volume() / (std::numbers::pi / 4 * a * a * length), 1, 1e-4);
  Filling filling;
  for (double ratio = 1.08; ratio < 6.3; ratio *= 1.08)
  {
    balloon.hold_volume(ratio);
    const double found = balloon.solution[balloon.pressure];
    const TubeState expected = closed_tube(rubber.energy, balloon.inner_radius(2) / a, a, b);
    filling.largest_difference = std::max(filling.largest_difference, std::abs(found / expected.pressure - 1));
    EXPECT_NEAR(1 + balloon.solution[balloon.lid + 2] / length, expected.axial_stretch, 3e-3) << ratio;
    filling.pressures.push_back(found);
  }
  return filling;
}

/// The pressure rises, has a largest value inside, and falls after it.
void expect_limit_point(const std::vector<double> &pressures)
{
  const auto largest = std::max_element(pressures.begin(), pressures.end());
  EXPECT_NE(largest, pressures.begin());
  EXPECT_LT(pressures.back(), 0.99 * *largest);
}

/// At most 0.2 % from incompressibility at kappa/mu 1000, and less in proportion to 1/kappa.
void expect_closed_form(const std::string &shape, const Rubber &rubber, Filling (*fill)(const Rubber &, double))
{
  const Filling soft = fill(rubber, 1000), stiff = fill(rubber, 4000);
  std::cout << fmt::format(
      "{}, {}: largest difference {:.3f} % at kappa/mu 1000, {:.3f} % at 4000; largest pressure {:.5f} "
      "MPa, last {:.5f} MPa\n",
      shape, rubber.name, 100 * soft.largest_difference, 100 * stiff.largest_difference,
      *std::max_element(stiff.pressures.begin(), stiff.pressures.end()), stiff.pressures.back());
  EXPECT_LE(soft.largest_difference, 2e-3) << rubber.name;
  EXPECT_LE(stiff.largest_difference, 0.4 * soft.largest_difference) << rubber.name;
  expect_limit_point(stiff.pressures);
}

TEST(Balloon, SpheresOfEveryLawPassTheirLargestPressure)
{
  for (const Rubber &rubber : rubbers)
    expect_closed_form("sphere", rubber, fill_sphere);
}

TEST(Balloon, ClosedTubesOfEveryLawPassTheirLargestPressure)
{
  for (const Rubber &rubber : rubbers)
    expect_closed_form("closed tube", rubber, fill_tube);
}
} // namespace
} // namespace pelvireg::reference_fe
