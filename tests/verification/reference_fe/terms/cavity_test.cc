#include "reference_fe/constraints/cavity.h"
#include "reference_fe/constraints/follower_pressure.h"
#include "reference_fe/newton_solver.h"
#include "tests/verification/reference_fe/terms/sphere_shell.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <iostream>
#include <utility>
#include <vector>

namespace pelvireg::reference_fe
{
namespace
{
constexpr double radius = 40, thickness = 2, inner = radius - thickness / 2, outer = radius + thickness / 2;

struct FilledSphere
{
  EquilibriumSystem system;
  Sphere sphere;
  int pressure;
  std::shared_ptr<Cavity> fluid;
  Eigen::VectorXd solution;

  explicit FilledSphere(const YeohCoefficients &c, int n = 4) : sphere(system, n, radius, thickness, c)
  {
    pressure = system.add_unknowns(1, {"fluid pressure", 1e3});
    fluid = std::make_shared<Cavity>("fluid", sphere.faces(-1), pressure);
    system.add_term(fluid);
    solution = Eigen::VectorXd::Zero(system.n_unknowns());
  }
  NewtonResult solve()
  {
    NewtonResult result = solve_newton(system, solution, {.residual_tolerance = 1e-9});
    EXPECT_TRUE(result.converged()) << result.message;
    return result;
  }
};

/// Inflates the ball to the stretches of its inner face, each from the line through the last two solutions, and returns
/// the fluid pressures, MPa.
std::vector<double> inflate(FilledSphere &ball, const YeohCoefficients &c, const std::vector<double> &stretches)
{
  std::vector<double> pressures;
  double last = 1, before_last = 1;
  Eigen::VectorXd step = Eigen::VectorXd::Zero(ball.solution.size());
  for (const double stretch : stretches)
  {
    const Eigen::VectorXd start = ball.solution;
    if (last > 1)
      ball.solution += (stretch - last) / (last - before_last) * step;
    ball.fluid->hold_volume(ball.fluid->rest_volume() * std::pow(stretch, 3));
    ball.solve();
    step = ball.solution - start;
    before_last = std::exchange(last, stretch);
    EXPECT_NEAR(ball.fluid->volume(ball.solution) / ball.fluid->held_volume(), 1, 1e-11);
    pressures.push_back(ball.solution[ball.pressure]);
    const double closed_form = sphere_pressure(stretch, inner, outer, c, Sphere::kappa(c));
    EXPECT_NEAR(pressures.back() / closed_form, 1, 1e-3) << "stretch " << stretch;
    std::cout << fmt::format("C20 {}: stretch {}, fluid pressure {:.6f} MPa, closed form {:.6f} MPa\n", c.c20, stretch,
                             pressures.back(), closed_form);
  }
  return pressures;
}

TEST(InflatedSphere, ItsFluidPressureFollowsTheClosedFormAndStiffensWithAYeohWall)
{
  const YeohCoefficients yeoh{0.1, 0.05};
  FilledSphere ball(yeoh);
  const std::vector<double> pressure = inflate(ball, yeoh, {1.1, 1.2, 1.3});
  EXPECT_LT(pressure[1], pressure[2]);
}

TEST(InflatedSphere, APrescribedVolumePassesTheLargestPressureOfANeoHookeanWall)
{
  // A balloon: its pressure is largest near a stretch of 7^(1/6) = 1.38. By pressure one gets no farther.
  const YeohCoefficients neo_hookean{0.1, 0};
  FilledSphere ball(neo_hookean);
  const std::vector<double> pressure = inflate(ball, neo_hookean, {1.1, 1.2, 1.3, 1.36, 1.4, 1.44, 1.48});
  EXPECT_GT(pressure[4], pressure[3]);
  EXPECT_LT(pressure[6], pressure[5]);
}

/// How far the nodes of a filled sphere move under 5 kPa from outside, mm, where none should.
double motion_under_pressure(int n)
{
  FilledSphere ball({0.1, 0}, n);
  const int load = ball.system.add_unknowns(1, {"load"});
  ball.system.add_term(std::make_shared<FollowerPressure>(ball.sphere.faces(+1), load));
  ball.system.fix(load);
  ball.solution = Eigen::VectorXd::Zero(ball.system.n_unknowns());
  ball.solution[load] = 0.005;
  ball.solve();
  EXPECT_NEAR(ball.fluid->volume(ball.solution) / ball.fluid->rest_volume(), 1, 1e-11);
  EXPECT_NEAR(ball.solution[ball.pressure] / ball.solution[load], 1, 1e-3);
  return (ball.sphere.radii(ball.solution, 0).array() - radius).abs().maxCoeff();
}

TEST(FilledSphere, UnderAPressureFromOutsideKeepsItsVolumeAndItsFluidCarriesAll)
{
  // Nothing can be squeezed but the wall's own kappa, so nothing should move. The wall's volume between its two faces
  // is not quite the integral of the assumed strains' J, so that equal pressures on both push the nodes a little.
  const double coarse = motion_under_pressure(4), fine = motion_under_pressure(6);
  std::cout << fmt::format("nodes move by {:.5f} mm, on a finer mesh {:.5f} mm\n", coarse, fine);
  EXPECT_LT(coarse, 0.007);
  EXPECT_LT(fine, coarse / 2);
}
} // namespace
} // namespace pelvireg::reference_fe
