// The tests that one family of curves has to stand (docs/regression.md).
#pragma once

#include "validation/regression/compare.h"

#include <Eigen/Core>

#include <map>

namespace pelvireg::regression
{
/// What the tests of all families share.
struct TestContext
{
  const Rule &rule;
  double band_level = 0.01; ///< Rule::level shared among the families
  /// Bootstrap shares by the number of runs (paired_bounds.h), made when first needed.
  const Eigen::MatrixXd &shares(int n_runs);

private:
  std::map<int, Eigen::MatrixXd> shares_;

public:
  TestContext(const Rule &given, double level) : rule(given), band_level(level) {}
};

/// Judge the curves of `current` against those of `baseline`. A family of the condition `unregistered` is the control:
/// it must be the same.
FamilyComparison test_family(const FamilyName &name, const Family &baseline, const Family &current,
                             TestContext &context);
} // namespace pelvireg::regression
