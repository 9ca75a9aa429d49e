// Work along a path, against integrals in closed form.
#include "reference_fe/elements/shell_kinematics.h"
#include "reference_fe/outer_surface.h"
#include "reference_fe/path_work.h"
#include "tests/unit/reference_fe/terms/sample_parts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

namespace pelvireg::reference_fe
{
namespace
{
constexpr double radius = 10, thickness = 1;

/// A sphere blown up evenly: its outer face under a load, its inner face around a fluid.
struct BlownSphere
{
  dataset::ReferenceShell shell = sphere_shell(2, radius, thickness);
  int load = n_shell_unknowns * static_cast<int>(shell.midsurface.rows()), fluid = load + 1;
  std::shared_ptr<FollowerPressure> pressure = std::make_shared<FollowerPressure>(faces(+1), load);
  std::shared_ptr<Cavity> cavity = std::make_shared<Cavity>("fluid", faces(-1), fluid);
  double outer_volume = 0; ///< at rest

  BlownSphere()
  {
    for (const SurfaceFace &face : faces(+1))
    {
      const Eigen::Matrix3Xd x = positions(face.nodes, solution(1, 0, 0));
      outer_volume += swept_rate(x, x, Eigen::VectorXd::Ones(x.cols())) / 3;
    }
  }
  std::vector<SurfaceFace> faces(int side) const
  {
    std::vector<SurfaceFace> all;
    for (Eigen::Index c = 0; c < shell.cells.rows(); ++c)
      all.push_back(shell_face(shell, 0, c, side));
    return all;
  }
  /// All points at `stretch` times their place at rest.
  Eigen::VectorXd solution(double stretch, double load_pressure, double fluid_pressure) const
  {
    Eigen::VectorXd x = Eigen::VectorXd::Zero(fluid + 1);
    for (Eigen::Index node = 0; node < shell.midsurface.rows(); ++node)
    {
      x.segment<3>(n_shell_unknowns * node) = (stretch - 1) * shell.midsurface.row(node).transpose();
      x.segment<3>(n_shell_unknowns * node + 3) = (stretch - 1) * shell.directors.row(node).transpose();
    }
    x[load] = load_pressure;
    x[fluid] = fluid_pressure;
    return x;
  }
};

/// Works of a load p = (s - 1)(3 - s) and a fluid at q = s^2 - 1 while the stretch s goes from 1 to 1.5 in n steps, of
/// which every other one is twice as long.
PathWork blow_up(const BlownSphere &sphere, int n)
{
  PathWork work(sphere.pressure, {sphere.cavity});
  work.advance(sphere.solution(1, 0, 0));
  double done = 0;
  for (int step = 1; step <= n; ++step)
  {
    done += (step % 2 ? 1 : 2) / (1.5 * n);
    const double s = 1 + 0.5 * done;
    work.advance(sphere.solution(s, (s - 1) * (3 - s), s * s - 1));
  }
  return work;
}

/// int (s - 1)(3 - s) 3 s^2 ds and int (s^2 - 1) 3 s^2 ds from 1 to 1.5: volumes go with the cube of the stretch.
const double load_integral = [](double s) {
  return -0.6 * std::pow(s, 5) + 3 * std::pow(s, 4) - 3 * std::pow(s, 3);
}(1.5) + 0.6;
const double fluid_integral = [](double s) { return 0.6 * std::pow(s, 5) - std::pow(s, 3); }(1.5) + 0.4;

TEST(PathWork, IsTheIntegralOfPressureOverVolumeForLoadAndFluid)
{
  const BlownSphere sphere;
  const PathWork work = blow_up(sphere, 8);
  EXPECT_NEAR(work.external_work() / (-sphere.outer_volume * load_integral), 1, 2e-3);
  EXPECT_NEAR(work.cavity_work()[0] / (-sphere.cavity->rest_volume() * fluid_integral), 1, 2e-3);
}

TEST(PathWork, ErrsByAtMostWhatItStatesAndByThirdOrderInTheStep)
{
  const BlownSphere sphere;
  const auto error = [&](const PathWork &work)
  { return std::abs(work.external_work() + sphere.outer_volume * load_integral); };
  const PathWork coarse = blow_up(sphere, 8), fine = blow_up(sphere, 16);
  EXPECT_LT(error(coarse), coarse.uncertainty());
  EXPECT_LT(error(fine), fine.uncertainty());
  EXPECT_GT(std::log2(error(coarse) / error(fine)), 2.5);
  EXPECT_NEAR(std::log2(coarse.uncertainty() / fine.uncertainty()), 2, 0.3);
}

TEST(PathWork, OfAWayBackIsTheOppositeWhenThePressureIsTheSame)
{
  const BlownSphere sphere;
  PathWork work(sphere.pressure, {sphere.cavity});
  for (const double s : {1., 1.1, 1.2, 1.3})
    work.advance(sphere.solution(s, 0.01, 0.02));
  const double there = work.external_work();
  EXPECT_NEAR(there / (-0.01 * sphere.outer_volume * (std::pow(1.3, 3) - 1)), 1,
              0.02); // the load was not there at rest
  for (const double s : {1.2, 1.1})
    work.advance(sphere.solution(s, 0.01, 0.02));
  EXPECT_NEAR(there - work.external_work(), -0.01 * sphere.outer_volume * (std::pow(1.3, 3) - std::pow(1.1, 3)),
              0.02 * std::abs(there));
}

TEST(PathWork, OfAPressureOnAClosedSurfaceHasNoResultant)
{
  const BlownSphere sphere;
  EXPECT_LT(sphere.pressure->resultant(sphere.solution(1.2, 0.01, 0)).norm(), 1e-10);
}
} // namespace
} // namespace pelvireg::reference_fe
