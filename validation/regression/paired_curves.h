// Two families of curves laid side by side.
#pragma once

#include "validation/regression/curves.h"
#include "validation/regression/rule.h"

#include <string>
#include <vector>

namespace pelvireg::regression
{
/// One run's points on the abscissae that all runs share.
using PickedCurve = std::vector<const CurvePoint *>;

/// The curves of both sides, run by run. Points into the families, which must outlive it.
struct PairedCurves
{
  std::vector<int> abscissae;                 ///< that every run of both sides has
  std::vector<int> samples;                   ///< the nominal run first
  std::vector<PickedCurve> baseline, current; ///< one a run
  /// Slices that every run of the baseline meets and some run of the current does not: those that cut the organ, and
  /// those that graze it (Rule::grazing_share).
  std::vector<int> lost, lost_grazing;
};

/// Why the families cannot be laid side by side (a figure that is not finite, other samples, no nominal run, other
/// steps); empty when they can.
std::string pairing_problem(const FamilyName &name, const Family &baseline, const Family &current);

/// Lay them side by side. A slice that some run of the baseline does not meet is left out.
PairedCurves pair_up(const Family &baseline, const Family &current, const Rule &rule);

/// Why the points of the two sides are not the same places (no shared abscissa, another offset, another number of
/// points); empty when they are.
std::string place_problem(const PairedCurves &paired, const Rule &rule);

/// Largest relative change of any number.
struct Change
{
  double largest = 0;
  bool is_none = true; ///< within Rule::same_relative and same_absolute_mm
};
Change change_of(const PairedCurves &paired, const Rule &rule);

/// E: average of the mean errors, mm.
double average(const PickedCurve &curve);
/// Largest 95th percentile, mm.
double largest_p95(const PickedCurve &curve);
} // namespace pelvireg::regression
