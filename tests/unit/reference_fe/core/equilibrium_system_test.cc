#include "reference_fe/newton_solver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace pelvireg::reference_fe
{
namespace
{
/// A chain of hardening springs between neighbouring unknowns: force = k (s + s^3), s the stretch.
class SpringChain : public Term
{
public:
  SpringChain(int n_springs, double stiffness) : n_springs_(n_springs), stiffness_(stiffness) {}
  std::string name() const override { return "springs"; }
  int n_items() const override { return n_springs_; }
  void unknowns(int item, std::vector<int> &indices) const override { indices = {item, item + 1}; }
  void evaluate(int item, const Eigen::VectorXd &x, LocalSystem &local) const override
  {
    const double stretch = x[item + 1] - x[item];
    const double k = stiffness_ * (1 + 0.1 * item);
    const double force = k * (stretch + std::pow(stretch, 3));
    const double slope = k * (1 + 3 * stretch * stretch);
    local.residual = Eigen::Vector2d(-force, force);
    local.tangent = (Eigen::Matrix2d() << slope, -slope, -slope, slope).finished();
    local.energy = k * (stretch * stretch / 2 + std::pow(stretch, 4) / 4);
  }

private:
  int n_springs_;
  double stiffness_;
};

/// x_unknown - value = 0, enforced by the force `multiplier`: a saddle point.
class Prescribe : public Term
{
public:
  Prescribe(int unknown, int multiplier, double value) : unknown_(unknown), multiplier_(multiplier), value_(value) {}
  std::string name() const override { return "prescribe"; }
  int n_items() const override { return 1; }
  void unknowns(int, std::vector<int> &indices) const override { indices = {unknown_, multiplier_}; }
  void evaluate(int, const Eigen::VectorXd &x, LocalSystem &local) const override
  {
    local.residual = Eigen::Vector2d(-x[multiplier_], value_ - x[unknown_]);
    local.tangent = (Eigen::Matrix2d() << 0, -1, -1, 0).finished();
    local.energy = 0;
  }

private:
  int unknown_, multiplier_;
  double value_;
};

EquilibriumSystem chain(int n_springs, double pull, int n_threads)
{
  EquilibriumSystem system(n_threads);
  system.add_unknowns(n_springs + 1, {.name = "displacement"});
  const int multiplier = system.add_unknowns(1, {.name = "load"});
  system.add_term(std::make_shared<SpringChain>(n_springs, 3.0));
  system.add_term(std::make_shared<Prescribe>(n_springs, multiplier, pull));
  system.fix(0);
  return system;
}

TEST(EquilibriumSystem, NamesTheFirstRowThatIsNotFiniteOrElseTheLargest)
{
  EquilibriumSystem system = chain(5, 2.0, 1);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(system.n_unknowns());
  x[4] = 1; // between the springs 3 and 4: the row has both their forces
  system.assemble(x, false);
  EXPECT_EQ(system.worst_row(), "displacement 4");
  x[3] = std::numeric_limits<double>::quiet_NaN();
  system.assemble(x, false);
  EXPECT_EQ(system.worst_row(), "displacement 2"); // the other end of spring 2
}

TEST(EquilibriumSystem, SaddlePointOfHardeningSpringsIsSolvedToTheTolerance)
{
  EquilibriumSystem system = chain(1, 2.0, 1);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(system.n_unknowns());
  const NewtonResult result = solve_newton(system, x, {.residual_tolerance = 1e-12});
  ASSERT_TRUE(result.converged()) << result.message;
  EXPECT_DOUBLE_EQ(x[1], 2.0);
  EXPECT_NEAR(x[2], 3.0 * (2.0 + 8.0), 1e-12);     // k (s + s^3)
  EXPECT_NEAR(system.residual()[0], -30.0, 1e-12); // the reaction of the fixed unknown
  EXPECT_NEAR(system.energy(), 3.0 * (2.0 + 4.0), 1e-12);
}

TEST(EquilibriumSystem, NewtonConvergesQuadratically)
{
  EquilibriumSystem system = chain(10, 8.0, 1);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(system.n_unknowns());
  const NewtonResult result = solve_newton(system, x, {.residual_tolerance = 1e-9});
  ASSERT_TRUE(result.converged()) << result.message;
  const auto &it = result.iterations;
  ASSERT_GE(it.size(), 3u);
  const double last = it[it.size() - 1].residual, before = it[it.size() - 2].residual;
  EXPECT_LT(last, 10 * before * before);
}

int n_chords(const NewtonResult &result)
{
  return static_cast<int>(std::count_if(result.iterations.begin(), result.iterations.end(),
                                        [](const NewtonIteration &iteration) { return iteration.is_chord; }));
}

TEST(EquilibriumSystem, ChordsReachTheSameSolutionWithFewerFactorisations)
{
  EquilibriumSystem newton = chain(10, 8.0, 1), modified = chain(10, 8.0, 1);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(newton.n_unknowns()), y = x;
  const NewtonResult with_tangents = solve_newton(newton, x, {.residual_tolerance = 1e-9});
  const NewtonResult with_chords = solve_newton(modified, y, {.residual_tolerance = 1e-9, .chord_increment = 0.5});
  ASSERT_TRUE(with_tangents.converged() && with_chords.converged());
  EXPECT_EQ(n_chords(with_tangents), 0);
  EXPECT_GE(n_chords(with_chords), 1);
  EXPECT_LT(with_chords.iterations.size() - n_chords(with_chords), with_tangents.iterations.size());
  EXPECT_LE(with_chords.residual, 1e-9);
  EXPECT_LT((x - y).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(EquilibriumSystem, ChordIsOnlyTakenWhereItContracts)
{
  // From a stretch of 1 to one of 10 the slope of the cubic spring grows from 4 to 301 stiffnesses: chords are as long
  // as the steps before, whatever length is allowed.
  EquilibriumSystem system = chain(1, 10.0, 1);
  system.fix(2);
  Eigen::VectorXd x = Eigen::Vector3d(0, 1, 3.0 * (10 + 1000)); // the load is given, the stretch is sought
  const NewtonResult result = solve_newton(
      system, x, {.residual_tolerance = 1e-7, .max_iterations = 60, .max_merit_growth = 1e9, .chord_increment = 1e9});
  ASSERT_TRUE(result.converged()) << result.message;
  EXPECT_NEAR(x[1], 10.0, 1e-8);
  for (std::size_t i = 1; i < result.iterations.size(); ++i)
    if (result.iterations[i].is_chord)
    {
      EXPECT_LE(result.iterations[i].increment, 0.1 * result.iterations[i - 1].increment);
    }
  EXPECT_LT(n_chords(result), static_cast<int>(result.iterations.size()) / 2);
}

TEST(EquilibriumSystem, TermsAreRevisedAtShortStepsAndAChordNeverFollows)
{
  EquilibriumSystem system = chain(10, 8.0, 1);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(system.n_unknowns());
  NewtonOptions options{.residual_tolerance = 1e-9, .chord_increment = 0.5, .revise_increment = 0.5};
  int n_calls = 0;
  Eigen::VectorXd seen;
  options.revise = [&](const Eigen::VectorXd &trial)
  {
    seen = trial;
    return ++n_calls == 1;
  };
  const NewtonResult result = solve_newton(system, x, options);
  ASSERT_TRUE(result.converged()) << result.message;
  EXPECT_EQ(seen, x); // the last trial is the solution
  int n_short = 0, n_revised = 0;
  for (std::size_t i = 0; i < result.iterations.size(); ++i)
  {
    n_short += result.iterations[i].increment <= 0.5;
    if (!result.iterations[i].is_revised)
      continue;
    ++n_revised;
    ASSERT_LT(i + 1, result.iterations.size());
    EXPECT_FALSE(result.iterations[i + 1].is_chord);
  }
  EXPECT_EQ(n_calls, n_short);
  EXPECT_EQ(n_revised, 1);
}

TEST(EquilibriumSystem, OneAndTwoThreadsGiveTheSameBytes)
{
  EquilibriumSystem one = chain(1000, 5.0, 1), two = chain(1000, 5.0, 2);
  Eigen::VectorXd x(one.n_unknowns());
  for (int i = 0; i < x.size(); ++i)
    x[i] = std::sin(0.37 * i);
  one.assemble(x, true);
  two.assemble(x, true);
  EXPECT_TRUE(one.residual() == two.residual());
  EXPECT_EQ(one.tangent().value, two.tangent().value);
  EXPECT_EQ(one.energy(), two.energy());
}

TEST(EquilibriumSystem, SparsityPatternIsKeptWhileNoTermChanges)
{
  EquilibriumSystem system = chain(10, 8.0, 1);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(system.n_unknowns());
  solve_newton(system, x, {});
  EXPECT_EQ(system.n_patterns_built(), 1);
  system.fix(5);
  system.assemble(x, true);
  EXPECT_EQ(system.n_patterns_built(), 2);
}

/// A spring between two unknowns that can be moved to two others, as contact moves from facet to facet.
class MovingSpring : public Term
{
public:
  std::string name() const override { return "moving spring"; }
  int n_items() const override { return 1; }
  bool update(const Eigen::VectorXd &) override { return std::exchange(has_moved_, false); }
  void unknowns(int, std::vector<int> &indices) const override { indices = {a_, b_}; }
  void evaluate(int, const Eigen::VectorXd &x, LocalSystem &local) const override
  {
    const double force = 5 * (x[b_] - x[a_]);
    local.residual = Eigen::Vector2d(-force, force);
    local.tangent = (Eigen::Matrix2d() << 5, -5, -5, 5).finished();
    local.energy = 0;
  }
  void move(int a, int b)
  {
    a_ = a;
    b_ = b;
    has_moved_ = true;
  }

private:
  int a_ = 1, b_ = 5;
  bool has_moved_ = false;
};

TEST(EquilibriumSystem, SparsityPatternGrowsWithNewPairsAndIsKeptWhenOldOnesComeBack)
{
  EquilibriumSystem system = chain(10, 8.0, 1), fresh = chain(10, 8.0, 1);
  const auto spring = std::make_shared<MovingSpring>(), same = std::make_shared<MovingSpring>();
  system.add_term(spring);
  Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(system.n_unknowns(), 0, 1);
  const auto patterns_after = [&](int a, int b)
  {
    spring->move(a, b);
    system.assemble(x, true);
    return system.n_patterns_built();
  };
  EXPECT_EQ(patterns_after(1, 5), 1);
  EXPECT_EQ(patterns_after(2, 7), 2);
  EXPECT_EQ(patterns_after(1, 5), 2);
  EXPECT_EQ(patterns_after(4, 5), 2); // neighbours in the chain have their entries already
  EXPECT_EQ(patterns_after(2, 7), 2);
  // Entries that nobody uses any more are zero: the solution is that of a system which never had them.
  fresh.add_term(same);
  same->move(2, 7);
  fresh.assemble(x, true);
  EXPECT_GT(system.tangent().n_entries(), fresh.tangent().n_entries());
  ASSERT_TRUE(system.factorise() && fresh.factorise());
  EXPECT_LT((system.solve(system.residual()) - fresh.solve(fresh.residual())).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(EquilibriumSystem, UnconstrainedPartIsReportedAsSingular)
{
  EquilibriumSystem system;
  system.add_unknowns(3, {.name = "displacement"});
  system.add_term(std::make_shared<SpringChain>(2, 1.0));
  Eigen::VectorXd x = Eigen::Vector3d(0, 1, 0);
  const NewtonResult result = solve_newton(system, x, {});
  EXPECT_EQ(result.status, NewtonStatus::singular);
  EXPECT_NE(result.message.find("displacement"), std::string::npos);
}

/// Records where it is linearised.
class Witness : public SpringChain
{
public:
  using SpringChain::SpringChain;
  void linearise_at(const Eigen::VectorXd &x) override { points.push_back(x); }
  std::vector<Eigen::VectorXd> points;
};

TEST(EquilibriumSystem, RejectedTrialIsNeverAPointOfLinearisation)
{
  // A start far out on the cubic spring: the monotone line search throws trials away.
  EquilibriumSystem system;
  system.add_unknowns(3, {.name = "displacement"});
  const auto witness = std::make_shared<Witness>(2, 1.0);
  system.add_term(witness);
  system.fix(0);
  Eigen::VectorXd x = Eigen::Vector3d(0, 0.01, 30);
  const Eigen::VectorXd start = x;
  const NewtonResult result = solve_newton(system, x, {.max_iterations = 100, .max_merit_growth = 0.9});
  ASSERT_TRUE(result.converged()) << result.message;
  ASSERT_EQ(witness->points.size(), result.iterations.size() + 1);
  EXPECT_EQ(witness->points.front(), start);
  EXPECT_EQ(witness->points[1], start);
}

TEST(EquilibriumSystem, NotANumberIsNeverConverged)
{
  EquilibriumSystem system = chain(3, 1.0, 1);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(system.n_unknowns());
  x[2] = std::nan("");
  EXPECT_EQ(solve_newton(system, x, {}).status, NewtonStatus::not_finite);
}
} // namespace
} // namespace pelvireg::reference_fe
