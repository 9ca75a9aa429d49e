#include "validation/regression/compare.h"

#include "validation/regression/case_difference.h"
#include "validation/regression/family_test.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace pelvireg::regression
{
namespace
{
/// Why two results say nothing about each other.
std::vector<std::string> problems_between(const ErrorResult &baseline, const ErrorResult &current)
{
  std::vector<std::string> problems;
  if (baseline.case_name != current.case_name)
    problems.push_back(fmt::format("CURRENT is of case '{}', BASELINE of '{}'", current.case_name, baseline.case_name));
  if (const auto difference = case_difference(baseline.case_text, current.case_text))
    problems.push_back(fmt::format("the case has changed: {}", *difference));
  const auto demand = [&](double before, double now, const std::string &what)
  {
    if (!(std::abs(now - before) <= 1e-9))
      problems.push_back(fmt::format("{} is {:g} mm, was {:g} mm", what, now, before));
  };
  demand(baseline.surface_spacing, current.surface_spacing, "the spacing of the judge's surface points");
  demand(baseline.contour_spacing, current.contour_spacing, "the spacing of the judge's contour points");
  return problems;
}

FamilyComparison missing(const FamilyName &name, const std::string &side)
{
  FamilyComparison family;
  family.name = name;
  family.verdict = Verdict::missing;
  family.reasons.push_back("not in " + side);
  return family;
}

std::set<std::string> registered_conditions(const ErrorResult &result)
{
  std::set<std::string> conditions;
  for (const auto &[run, steps] : result.runs)
    conditions.insert(run.first);
  return conditions;
}

/// Steps that failed, run by run: one more than before in any run is worse.
FamilyComparison test_failed_steps(const std::string &condition, const ErrorResult &baseline,
                                   const ErrorResult &current)
{
  FamilyComparison family;
  family.name = {condition, "all", Axis::step};
  family.is_steps = true;
  const auto verdict = [&](Verdict found, const std::string &reason)
  {
    family.verdict = std::max(family.verdict, found);
    family.reasons.push_back(reason);
  };
  for (const auto &[run, before] : baseline.runs)
  {
    if (run.first != condition)
      continue;
    const auto found = current.runs.find(run);
    if (found == current.runs.end())
      verdict(Verdict::incomparable, fmt::format("sample {} is not in CURRENT", run.second));
    else if (!(found->second.n_failed <= before.n_failed))
      verdict(Verdict::worse, fmt::format("sample {}: {} of {} steps failed, {} before", run.second,
                                          found->second.n_failed, found->second.n_steps, before.n_failed));
    else if (found->second.n_failed < before.n_failed)
      verdict(Verdict::improved, fmt::format("sample {}: {} of {} steps failed, {} before", run.second,
                                             found->second.n_failed, found->second.n_steps, before.n_failed));
  }
  return family;
}

std::vector<FamilyComparison> compare_families(const ErrorResult &baseline, const ErrorResult &current,
                                               const Rule &rule)
{
  TestContext context(rule, rule.level / static_cast<double>(std::max<std::size_t>(1, baseline.curves.size())));
  std::vector<FamilyComparison> families;
  for (const auto &[name, curves] : baseline.curves)
  {
    const auto found = current.curves.find(name);
    families.push_back(found == current.curves.end() ? missing(name, "CURRENT")
                                                     : test_family(name, curves, found->second, context));
  }
  for (const auto &[name, curves] : current.curves)
    if (!baseline.curves.contains(name))
      families.push_back(missing(name, "BASELINE"));
  for (const std::string &condition : registered_conditions(baseline))
    families.push_back(test_failed_steps(condition, baseline, current));
  return families;
}

/// What the frozen anchor finds counts when it is a reason to stop; changes and gains against it do not.
void add_anchor(std::vector<FamilyComparison> &families, const std::vector<FamilyComparison> &against_anchor)
{
  for (FamilyComparison &family : families)
    for (const FamilyComparison &other : against_anchor)
      if (other.name == family.name && other.is_steps == family.is_steps && other.verdict >= Verdict::incomparable)
      {
        family.verdict = std::max(family.verdict, other.verdict);
        for (const std::string &reason : other.reasons)
          if (std::find(family.reasons.begin(), family.reasons.end(), reason) == family.reasons.end())
            family.reasons.push_back("against the anchor: " + reason);
      }
}
} // namespace

std::string to_string(Verdict verdict)
{
  switch (verdict)
  {
  case Verdict::pass:
    return "PASS";
  case Verdict::changed:
    return "CHANGED";
  case Verdict::improved:
    return "IMPROVED";
  case Verdict::incomparable:
    return "INCOMPARABLE";
  case Verdict::missing:
    return "MISSING";
  case Verdict::worse:
    break;
  }
  return "WORSE";
}

Verdict Comparison::verdict() const
{
  Verdict gravest = problems.empty() ? Verdict::pass : Verdict::incomparable;
  for (const FamilyComparison &family : families)
    gravest = std::max(gravest, family.verdict);
  return gravest;
}

int Comparison::exit_status() const
{
  const Verdict gravest = verdict();
  return gravest <= Verdict::improved ? 0 : gravest == Verdict::worse ? 1 : 2;
}

Comparison compare(const Baseline &baseline, const ErrorResult &current, const Rule &rule)
{
  Comparison comparison;
  comparison.case_name = current.case_name;
  comparison.baseline_label = baseline.rolling.label;
  comparison.current_label = current.label;
  comparison.baseline_revision = baseline.rolling.revision;
  comparison.current_revision = current.revision;
  comparison.has_anchor = baseline.anchor.has_value();
  comparison.problems = problems_between(baseline.rolling, current);
  if (baseline.anchor)
    for (const std::string &problem : problems_between(*baseline.anchor, current))
      comparison.problems.push_back("against the anchor: " + problem);
  if (registered_conditions(baseline.rolling).empty() || baseline.rolling.curves.empty())
    comparison.problems.push_back("BASELINE holds no registered run");
  if (!comparison.problems.empty())
    return comparison;
  comparison.families = compare_families(baseline.rolling, current, rule);
  if (baseline.anchor)
    add_anchor(comparison.families, compare_families(*baseline.anchor, current, rule));
  for (const FamilyComparison &family : comparison.families)
    if (family.average)
      comparison.n_runs = std::max(comparison.n_runs, family.average->n);
  return comparison;
}
} // namespace pelvireg::regression
