#include "validation/regression/paired_curves.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <set>
#include <utility>

namespace pelvireg::regression
{
namespace
{
std::set<int> common_abscissae(const Family &family)
{
  std::set<int> common;
  bool is_first = true;
  for (const auto &[sample, curve] : family)
  {
    std::set<int> here;
    for (const CurvePoint &point : curve)
      if (is_first || common.contains(point.abscissa))
        here.insert(point.abscissa);
    common = here;
    is_first = false;
  }
  return common;
}

/// The judge puts one point on a mm of the truth's contour.
bool grazes(const Curve &nominal, int abscissa, const Rule &rule)
{
  int here = 0, longest = 0;
  for (const CurvePoint &point : nominal)
  {
    longest = std::max(longest, point.n_points);
    if (point.abscissa == abscissa)
      here = point.n_points;
  }
  return here < rule.grazing_share * longest;
}

PickedCurve pick(const Curve &curve, const std::vector<int> &abscissae)
{
  PickedCurve points;
  for (const CurvePoint &point : curve)
    if (std::binary_search(abscissae.begin(), abscissae.end(), point.abscissa))
      points.push_back(&point);
  return points;
}

bool is_same(double before, double now, const Rule &rule)
{
  return std::abs(now - before) <=
         rule.same_absolute_mm + rule.same_relative * std::max(std::abs(before), std::abs(now));
}

bool is_finite(const CurvePoint &point)
{
  return std::isfinite(point.mean) && std::isfinite(point.sd) && std::isfinite(point.p95) && std::isfinite(point.max);
}
} // namespace

PairedCurves pair_up(const Family &baseline, const Family &current, const Rule &rule)
{
  PairedCurves paired;
  const std::set<int> before = common_abscissae(baseline), now = common_abscissae(current);
  std::set_intersection(before.begin(), before.end(), now.begin(), now.end(), std::back_inserter(paired.abscissae));
  for (const int abscissa : before)
    if (!now.contains(abscissa))
      (grazes(baseline.at(0), abscissa, rule) ? paired.lost_grazing : paired.lost).push_back(abscissa);
  for (const auto &[sample, curve] : baseline)
  {
    paired.samples.push_back(sample);
    paired.baseline.push_back(pick(curve, paired.abscissae));
    paired.current.push_back(pick(current.at(sample), paired.abscissae));
  }
  return paired;
}

std::string pairing_problem(const FamilyName &name, const Family &baseline, const Family &current)
{
  for (const auto &[family, side] : {std::pair(&baseline, "BASELINE"), std::pair(&current, "CURRENT")})
    for (const auto &[sample, curve] : *family)
      for (const CurvePoint &point : curve)
        if (!is_finite(point))
          return fmt::format("{}, sample {}: a figure at {} is not finite", side, sample, point.abscissa);
  for (const auto &[sample, curve] : baseline)
    if (!current.contains(sample))
      return fmt::format("sample {} is not in CURRENT", sample);
  for (const auto &[sample, curve] : current)
    if (!baseline.contains(sample))
      return fmt::format("sample {} is not in BASELINE", sample);
  if (!baseline.contains(0))
    return "there is no nominal run (sample 0)";
  if (name.axis == Axis::step)
    for (const auto &[sample, curve] : baseline)
      if (curve.size() != current.at(sample).size())
        return fmt::format("sample {} has {} steps in CURRENT, {} in BASELINE", sample, current.at(sample).size(),
                           curve.size());
  return "";
}

std::string place_problem(const PairedCurves &paired, const Rule &rule)
{
  if (paired.abscissae.empty())
    return "the curves share no abscissa";
  for (std::size_t run = 0; run < paired.samples.size(); ++run)
    for (std::size_t i = 0; i < paired.abscissae.size(); ++i)
    {
      const CurvePoint &before = *paired.baseline[run][i], &now = *paired.current[run][i];
      if (!(std::abs(now.offset - before.offset) <= 1e-6))
        return fmt::format("slice {} lies at {:g} mm, was {:g} mm", now.abscissa, now.offset, before.offset);
      const double allowed = std::max<double>(rule.points_absolute, rule.points_relative * before.n_points);
      if (!(std::abs(now.n_points - before.n_points) <= allowed))
        return fmt::format("the judge has {} points at {}, had {}", now.n_points, now.abscissa, before.n_points);
    }
  return "";
}

double average(const PickedCurve &curve)
{
  double sum = 0;
  for (const CurvePoint *point : curve)
    sum += point->mean;
  return sum / static_cast<double>(curve.size());
}

double largest_p95(const PickedCurve &curve)
{
  double largest = 0;
  for (const CurvePoint *point : curve)
    largest = std::max(largest, point->p95);
  return largest;
}

Change change_of(const PairedCurves &paired, const Rule &rule)
{
  Change change;
  for (std::size_t run = 0; run < paired.samples.size(); ++run)
    for (std::size_t i = 0; i < paired.abscissae.size(); ++i)
    {
      const CurvePoint &before = *paired.baseline[run][i], &now = *paired.current[run][i];
      const double pairs[][2] = {
          {before.mean, now.mean}, {before.sd, now.sd}, {before.p95, now.p95}, {before.max, now.max}};
      for (const auto &[a, b] : pairs)
      {
        change.is_none = change.is_none && is_same(a, b, rule);
        change.largest = std::max(change.largest, std::abs(b - a) / (std::max(a, b) + rule.floor_mm));
      }
    }
  return change;
}
} // namespace pelvireg::regression
