// The gate: has an error curve become worse? docs/regression.md says the rule in words, rule.h has its numbers.
#pragma once

#include "validation/regression/paired_bounds.h"
#include "validation/regression/result.h"
#include "validation/regression/rule.h"

#include <optional>
#include <string>
#include <vector>

namespace pelvireg::regression
{
/// From the best to the gravest.
enum class Verdict
{
  pass,         ///< not worse, and the same numbers to the round-off of another processor
  changed,      ///< not worse, other numbers
  improved,     ///< proven better by more than the line: time to accept a new baseline
  incomparable, ///< cannot be judged: other abscissae, runs, points or truth, or too few runs
  missing,      ///< a family that one of the two sides has not
  worse         ///< proven worse, by more than the rule allows
};

/// "PASS", "CHANGED", …
std::string to_string(Verdict verdict);

/// Mean error of a family's randomised runs at one abscissa; mm.
struct ComparedPoint
{
  int abscissa = 0;
  double baseline = 0, baseline_sd = 0, current = 0, current_sd = 0;
  double ratio = 1, ratio_lower = 1, ratio_upper = 1; ///< current over baseline, and the band that holds all of them
};

/// What was found of one family of curves (or, with is_steps, of the steps that failed in one condition).
struct FamilyComparison
{
  FamilyName name; ///< organ "all" for the failed steps
  bool is_steps = false;
  Verdict verdict = Verdict::pass;
  std::vector<std::string> reasons;           ///< why the verdict is not PASS
  std::vector<std::string> warnings;          ///< what deserves a look and is no reason
  std::vector<ComparedPoint> points;          ///< empty when the family could not be compared
  double baseline_mean = 0, current_mean = 0; ///< mm, of E over the randomised runs (the nominal one when it is alone)
  std::optional<MeanBounds> average;          ///< of the logarithm of the ratio of E
  std::optional<MeanBounds> tail;             ///< of the largest 95th percentile of a curve
  double pairing_correlation = 0;             ///< of E in the paired runs; 0 when they do not scatter
  double largest_change = 0;                  ///< relative, of any number of the family
};

struct Comparison
{
  std::string case_name, baseline_label, current_label, baseline_revision, current_revision;
  bool has_anchor = false;
  int n_runs = 0; ///< randomised, paired
  /// Why nothing can be compared (another case, other judge's points); families is empty then.
  std::vector<std::string> problems;
  std::vector<FamilyComparison> families;

  /// The gravest of all families.
  Verdict verdict() const;
  /// 0: nothing is worse. 1: something is, whatever else was found. 2: nothing is proven worse, and something cannot be
  /// compared.
  int exit_status() const;
};

/// Judge every family of both sides. Never throws for what the two sides hold: what cannot be judged is a verdict.
Comparison compare(const Baseline &baseline, const ErrorResult &current, const Rule &rule = {});
} // namespace pelvireg::regression
