// The two-bar truss of von Mises, pushed through its snap along its own path.
#include "reference_fe/constraints/dead_load.h"
#include "reference_fe/constraints/displacement_control.h"
#include "reference_fe/constraints/path_control.h"
#include "reference_fe/elements/truss.h"
#include "reference_fe/newton_solver.h"
#include "tests/unit/reference_fe/terms/difference_quotients.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <utility>

namespace pelvireg::reference_fe
{
namespace
{
const dataset::YeohMaterial material = {0.1, 0.3, 0, 20};
constexpr double span = 10, rise = 2, area = 3;

/// Downward force on the apex at height z: 2 A P(l/L) z/l, with P the nominal stress of an incompressible Yeoh bar.
double closed_form_load(double z)
{
  const double rest_length = std::hypot(span, rise), length = std::hypot(span, z), stretch = length / rest_length;
  const double e = stretch * stretch + 2 / stretch - 3;
  const double stress = 2 * (stretch - 1 / (stretch * stretch)) * (material.c10 + 2 * material.c20 * e);
  return -2 * area * stress * z / length;
}

struct TwoBars
{
  EquilibriumSystem system;
  int load;
  std::shared_ptr<PathControl> path;
  Eigen::VectorXd previous, solution;

  TwoBars()
  {
    const int first = system.add_unknowns(3, {"apex"});
    load = system.add_unknowns(1, {"load"});
    SurfaceNode apex;
    apex.first_unknown = first;
    apex.rest = {0, 0, rise};
    system.add_term(std::make_shared<Trusses>(std::vector<Bar>{{"left", {apex}, {-span, 0, 0}, area, material},
                                                               {"right", {apex}, {span, 0, 0}, area, material}}));
    system.add_term(std::make_shared<DeadLoad>(std::vector<std::pair<int, double>>{{first + 2, -1.}}, load));
    path = std::make_shared<PathControl>(std::vector<SurfaceNode>{apex}, load);
    system.add_term(path);
    system.fix(first + 1); // out of the bars' plane nothing holds the apex
    previous = solution = Eigen::VectorXd::Zero(system.n_unknowns());
  }
  double height() const { return rise + solution[2]; }
  /// One solution from `trial`; false when Newton's method fails.
  bool step_to(Eigen::VectorXd trial)
  {
    const NewtonResult result = solve_newton(system, trial, {.residual_tolerance = 1e-12});
    previous = std::exchange(solution, trial);
    return result.converged();
  }
  /// A first small load, by hand.
  bool leave_rest()
  {
    system.fix(load);
    Eigen::VectorXd trial = solution;
    trial[load] = 1e-4;
    const bool ok = step_to(trial);
    system.release(load);
    return ok;
  }
  bool step_along_the_path(double length)
  {
    const Eigen::VectorXd direction = (solution - previous) / (solution - previous).head<3>().norm();
    const Eigen::VectorXd predicted = solution + length * direction;
    path->prescribe(solution, predicted);
    return step_to(predicted);
  }
};

TEST(TwoBarTruss, PathControlFollowsTheClosedFormThroughBothFoldsToTheOtherSide)
{
  TwoBars truss;
  ASSERT_TRUE(truss.leave_rest());
  int n_folds = 0;
  double slope = 1;
  for (int step = 0; truss.height() > -1.3 * rise; ++step)
  {
    ASSERT_LT(step, 100);
    ASSERT_TRUE(truss.step_along_the_path(0.1));
    EXPECT_NEAR(truss.solution[truss.load], closed_form_load(truss.height()), 1e-11);
    EXPECT_NEAR((truss.solution - truss.previous).head<3>().norm(), 0.1, 1e-12); // a straight path: as long as asked
    const double next = truss.solution[truss.load] - truss.previous[truss.load];
    n_folds += next * slope < 0;
    slope = next;
  }
  EXPECT_EQ(n_folds, 2);
}

TEST(TwoBarTruss, AGivenLoadBeyondTheFoldHasNoEquilibriumOnThisSide)
{
  // Why the path is needed: the largest load before the snap, by sampling the closed form.
  double fold = 0;
  for (double z = rise; z > 0; z -= 1e-4)
    fold = std::max(fold, closed_form_load(z));
  for (const double factor : {0.999, 1.001})
  {
    TwoBars truss;
    truss.system.fix(truss.load);
    bool converged = true;
    for (const double part : {0.5, 0.8, 0.9, 0.96, 0.99, 1.})
    {
      Eigen::VectorXd trial = truss.solution;
      trial[truss.load] = part * factor * fold;
      converged = converged && truss.step_to(trial);
    }
    EXPECT_EQ(converged && truss.height() > 0, factor < 1) << factor;
  }
}

TEST(LoadFactor, ItsRowsAndColumnsAreDerivatives)
{
  constexpr int factor = 6;
  const Eigen::VectorXd x = scattered(7, 51);
  SurfaceNode a, b;
  b.first_unknown = 3;
  PathControl path({a, b}, factor);
  path.prescribe(scattered(7, 52), scattered(7, 53));
  const DeadLoad load({{1, 3.}, {5, -2.}}, factor);
  const DisplacementControl control(4, factor);
  for (const Term *term :
       {static_cast<const Term *>(&path), static_cast<const Term *>(&load), static_cast<const Term *>(&control)})
    for (int item = 0; item < term->n_items(); ++item)
      EXPECT_LT(tangent_error(*term, item, x, 1e-4), 1e-11) << term->name();
}

TEST(TwoBarTruss, TheStressOfABarIsThatOfAnIncompressibleYeohBlock)
{
  // Stretch 2: I1 - 3 = 4 + 1 - 3 = 2, 2 (2 - 1/4) = 3.5; stretch 1/2: I1 - 3 = 1.25, 2 (1/2 - 4) = -7.
  EXPECT_NEAR(uniaxial_response({0.1, 0, 0, 20}, 2).stress, 0.35, 1e-15);
  EXPECT_NEAR(uniaxial_response(material, 2).stress, 3.5 * (0.1 + 2 * 0.3 * 2), 1e-14);
  EXPECT_NEAR(uniaxial_response({0.1, 0.3, 0.2, 20}, 2).stress, 3.5 * (0.1 + 2 * 0.3 * 2 + 3 * 0.2 * 4), 1e-14);
  EXPECT_NEAR(uniaxial_response(material, 0.5).stress, -7 * (0.1 + 2 * 0.3 * 1.25), 1e-14);
}
} // namespace
} // namespace pelvireg::reference_fe
