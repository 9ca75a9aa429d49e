#include "validation/regression/comparison_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

namespace pelvireg::regression
{
namespace
{
std::string error_text(const FamilyComparison &family, double value)
{
  return family.points.empty() ? "-" : fmt::format("{:.3f}", value);
}

/// Markdown and HTML inside it: what a hostile name could break out of.
std::string cell(const std::string &text)
{
  std::string safe;
  for (const char character : text)
    switch (character)
    {
    case '|':
    case '`':
    case '*':
    case '_':
    case '[':
    case ']':
    case '\\':
    case '#':
      safe += '\\';
      safe += character;
      break;
    case '<':
      safe += "&lt;";
      break;
    case '&':
      safe += "&amp;";
      break;
    case '\n':
    case '\r':
      safe += ' ';
      break;
    default:
      safe += character;
    }
  return safe;
}

std::string markdown_table(const std::vector<const FamilyComparison *> &families)
{
  std::string text = "| verdict | condition | organ | curve | baseline, mm | current, mm | change | 99 % bounds | "
                     "remarks |\n|---|---|---|---|--:|--:|--:|---|---|\n";
  for (const FamilyComparison *family : families)
    text += fmt::format("| **{}** | {} | {} | {} | {} | {} | {} | {} | {} |\n", to_string(family->verdict),
                        cell(family->name.condition), cell(family->name.organ), curve_title(*family),
                        error_text(*family, family->baseline_mean), error_text(*family, family->current_mean),
                        change_text(*family), bounds_text(*family), cell(remarks_text(*family)));
  return text;
}

/// "BASELINE … (revision …), CURRENT … (revision …), N randomised runs"
std::string sides(const Comparison &comparison)
{
  return fmt::format("Case {}: BASELINE {} (revision {}{}), CURRENT {} (revision {}), {} randomised runs.",
                     comparison.case_name, comparison.baseline_label, comparison.baseline_revision,
                     comparison.has_anchor ? ", with anchor" : "", comparison.current_label,
                     comparison.current_revision, comparison.n_runs);
}
} // namespace

std::vector<const FamilyComparison *> by_gravity(const Comparison &comparison)
{
  std::vector<const FamilyComparison *> families;
  for (const FamilyComparison &family : comparison.families)
    families.push_back(&family);
  std::stable_sort(families.begin(), families.end(),
                   [](const FamilyComparison *a, const FamilyComparison *b) { return a->verdict > b->verdict; });
  return families;
}

std::string curve_title(const FamilyComparison &family)
{
  return family.is_steps ? "failed steps" : "by " + to_string(family.name.axis);
}

std::string change_text(const FamilyComparison &family)
{
  if (family.average)
    return fmt::format("{:+.2f} %", 100 * std::expm1(family.average->mean));
  if (family.points.empty() || !(family.baseline_mean > 0))
    return "-";
  return fmt::format("{:+.2f} %", 100 * (family.current_mean / family.baseline_mean - 1));
}

std::string bounds_text(const FamilyComparison &family)
{
  if (!family.average)
    return "-";
  return fmt::format("{:+.2f} … {:+.2f}", 100 * std::expm1(family.average->lower),
                     100 * std::expm1(family.average->upper));
}

std::string remarks_text(const FamilyComparison &family)
{
  std::string text;
  for (const auto *list : {&family.reasons, &family.warnings})
    for (const std::string &sentence : *list)
      text += (text.empty() ? "" : "; ") + sentence;
  return text;
}

std::string headline(const Comparison &comparison)
{
  std::map<Verdict, int> counts;
  for (const FamilyComparison &family : comparison.families)
    ++counts[family.verdict];
  std::string text = to_string(comparison.verdict()) + ":";
  for (auto verdict = counts.rbegin(); verdict != counts.rend(); ++verdict)
    text += fmt::format("{} {} {}", verdict == counts.rbegin() ? "" : ",", verdict->second, to_string(verdict->first));
  text += counts.empty() ? " nothing was compared" : fmt::format(" of {} curve families", comparison.families.size());
  if (counts.contains(Verdict::improved) && comparison.exit_status() == 0)
    text += "; accept a new baseline, or a later loss goes unseen";
  return text;
}

std::string comparison_table(const Comparison &comparison)
{
  std::string text = sides(comparison) + "\n\n";
  for (const std::string &problem : comparison.problems)
    text += fmt::format("INCOMPARABLE: {}\n", problem);
  if (!comparison.families.empty())
    text += fmt::format("{:<13}{:<24}{:<9}{:<14}{:>9}{:>9}{:>11}  {:<20}{}\n", "verdict", "condition", "organ", "curve",
                        "base, mm", "now, mm", "change", "99 % bounds, %", "remarks");
  for (const FamilyComparison *family : by_gravity(comparison))
  {
    const std::string line = fmt::format(
        "{:<13}{:<24}{:<9}{:<14}{:>9}{:>9}{:>11}  {:<20}{}", to_string(family->verdict), family->name.condition,
        family->name.organ, curve_title(*family), error_text(*family, family->baseline_mean),
        error_text(*family, family->current_mean), change_text(*family), bounds_text(*family), remarks_text(*family));
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return text + "\n" + headline(comparison) + "\n";
}

std::string comparison_markdown(const Comparison &comparison)
{
  std::string text = "### " + cell(headline(comparison)) + "\n\n" + cell(sides(comparison)) + "\n\n";
  for (const std::string &problem : comparison.problems)
    text += "- **INCOMPARABLE** " + cell(problem) + "\n";
  std::vector<const FamilyComparison *> families = by_gravity(comparison), passed;
  const auto first_passed =
      std::find_if(families.begin(), families.end(),
                   [](const FamilyComparison *family) { return family->verdict == Verdict::pass; });
  passed.assign(first_passed, families.end());
  families.erase(first_passed, families.end());
  if (!families.empty())
    text += markdown_table(families) + "\n";
  if (!passed.empty())
    text +=
        fmt::format("<details><summary>{} PASS</summary>\n\n{}\n</details>\n", passed.size(), markdown_table(passed));
  return text;
}
} // namespace pelvireg::regression
