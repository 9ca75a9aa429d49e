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

/// Volume of the ball's fluid (mm^3) after it leaked from a stretch of 1.2 over one unit of the load parameter, by the
/// closed form's pressure and backward Euler: each volume is the root of V = V0 - rate r(p(V)) dt.
double leaked_volume(double volume, double rest_volume, double rate, int n_steps, const YeohCoefficients &c)
{
  const auto outflow = [&](double v)
  { return rate * (sphere_pressure(std::cbrt(v / rest_volume), inner, outer, c, Sphere::kappa(c)) - 5e-6); };
  for (int step = 0; step < n_steps; ++step)
  {
    double low = 1.02 * rest_volume, high = volume;
    for (int halving = 0; halving < 60; ++halving)
    {
      const double middle = (low + high) / 2;
      (middle > volume - outflow(middle) / n_steps ? high : low) = middle;
    }
    volume = high;
  }
  return volume;
}

TEST(LeakingSphere, LosesTheVolumeThatTheClosedFormsPressureDrivesOutInEveryStep)
{
  const YeohCoefficients neo_hookean{0.1, 0};
  FilledSphere ball(neo_hookean);
  inflate(ball, neo_hookean, {1.1, 1.2});
  const double start = ball.fluid->held_volume(), rate = 4e6; // a tenth of the volume flows out
  ball.fluid->leak(rate);
  const int n_steps = 4;
  for (int step = 1; step <= n_steps; ++step)
  {
    ball.fluid->begin_step(static_cast<double>(step) / n_steps);
    const NewtonResult result = ball.solve();
    ball.fluid->accept_step(ball.solution);
    EXPECT_LE(result.iterations.size(), 6u);
    EXPECT_NEAR(ball.fluid->volume(ball.solution) / ball.fluid->held_volume(), 1, 1e-11);
  }
  const double expected = leaked_volume(start, ball.fluid->rest_volume(), rate, n_steps, neo_hookean);
  const double flowed = start - ball.fluid->held_volume(),
               in_the_limit = start - leaked_volume(start, ball.fluid->rest_volume(), rate, 1000, neo_hookean);
  std::cout << fmt::format("leaked {:.1f} mm^3 of {:.1f}, closed form in four steps {:.1f}, in a thousand {:.1f}\n",
                           flowed, start, start - expected, in_the_limit);
  EXPECT_GT(flowed, 0.02 * start);
  EXPECT_NEAR(flowed / (start - expected), 1, 1e-3);
  EXPECT_NEAR(flowed / in_the_limit, 1, 0.02); // first order in the step
}

TEST(LeakingSphere, TakesNothingInWhenItsFluidIsUnderSuction)
{
  FilledSphere ball({0.1, 0});
  ball.fluid->hold_volume(0.97 * ball.fluid->rest_volume());
  ball.solve();
  ASSERT_LT(ball.solution[ball.pressure], 0);
  ball.fluid->leak(1e7);
  ball.fluid->begin_step(1);
  ball.solve();
  ball.fluid->accept_step(ball.solution);
  EXPECT_NEAR(ball.fluid->volume(ball.solution) / ball.fluid->rest_volume(), 0.97, 1e-11);
}

TEST(PressedSphere, TakesTheVolumeOfTheClosedFormAtAPrescribedPressure)
{
  const YeohCoefficients yeoh{0.1, 0.05};
  FilledSphere ball(yeoh);
  const double stretch = 1.1, pressure = sphere_pressure(stretch, inner, outer, yeoh, Sphere::kappa(yeoh));
  ball.fluid->prescribe_pressure(pressure);
  for (const double t : {0.25, 0.5, 0.75, 1.})
  {
    ball.fluid->begin_step(t);
    ball.solve();
    ball.fluid->accept_step(ball.solution);
    EXPECT_NEAR(ball.solution[ball.pressure] / (t * pressure), 1, 1e-9);
  }
  const double reached = std::cbrt(ball.fluid->volume(ball.solution) / ball.fluid->rest_volume());
  std::cout << fmt::format("stretch {:.5f} at {:.6f} MPa, closed form {}\n", reached, pressure, stretch);
  EXPECT_NEAR((reached - 1) / (stretch - 1), 1, 2e-3);
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
