#include "validation/regression/comparison_text.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace pelvireg::regression
{
namespace
{
using json = nlohmann::ordered_json;

/// Text safe in XML content and attributes; what XML 1.0 cannot hold at all becomes a question mark.
std::string xml(const std::string &text)
{
  std::string safe;
  for (const char character : text)
  {
    const auto code = static_cast<unsigned char>(character);
    if (code < 0x20)
      safe += code == '\n' || code == '\t' ? ' ' : '?';
    else if (character == '&')
      safe += "&amp;";
    else if (character == '<')
      safe += "&lt;";
    else if (character == '>')
      safe += "&gt;";
    else if (character == '"')
      safe += "&quot;";
    else
      safe += character;
  }
  return safe;
}

/// Neither passed nor failed: it could not be judged.
bool is_error(Verdict verdict)
{
  return verdict == Verdict::incomparable || verdict == Verdict::missing;
}

std::string test_case(const Comparison &comparison, const FamilyComparison &family)
{
  const std::string name = fmt::format("classname=\"pelvireg.{}.{}\" name=\"{} {}\"", xml(comparison.case_name),
                                       xml(family.name.condition), xml(family.name.organ), curve_title(family));
  const std::string verdict = to_string(family.verdict), words = xml(remarks_text(family));
  if (is_error(family.verdict))
    return fmt::format("    <testcase {}><error type=\"{}\" message=\"{}\"/></testcase>\n", name, verdict, words);
  if (family.verdict == Verdict::worse)
    return fmt::format("    <testcase {}><failure type=\"{}\" message=\"{}\"/></testcase>\n", name, verdict, words);
  return fmt::format("    <testcase {}><system-out>{}{}{}</system-out></testcase>\n", name, verdict,
                     words.empty() ? "" : ": ", words);
}

json bounds(const std::optional<MeanBounds> &bounds)
{
  if (!bounds)
    return nullptr;
  return {{"n_runs", bounds->n},
          {"mean_ratio", std::exp(bounds->mean)},
          {"lower_ratio", std::exp(bounds->lower)},
          {"upper_ratio", std::exp(bounds->upper)},
          {"sd_log_ratio", bounds->sd}};
}

json family_json(const FamilyComparison &family)
{
  json entry = {{"condition", family.name.condition},
                {"organ", family.name.organ},
                {"curve", curve_title(family)},
                {"verdict", to_string(family.verdict)},
                {"reasons", family.reasons},
                {"warnings", family.warnings},
                {"baseline_mean_mm", family.baseline_mean},
                {"current_mean_mm", family.current_mean},
                {"average", bounds(family.average)},
                {"largest_p95", bounds(family.tail)},
                {"pairing_correlation", family.pairing_correlation},
                {"largest_relative_change", family.largest_change}};
  entry["points"] = json::array();
  for (const ComparedPoint &point : family.points)
    entry["points"].push_back({{to_string(family.name.axis), point.abscissa},
                               {"baseline_mm", point.baseline},
                               {"baseline_sd_mm", point.baseline_sd},
                               {"current_mm", point.current},
                               {"current_sd_mm", point.current_sd},
                               {"ratio", point.ratio},
                               {"ratio_lower", point.ratio_lower},
                               {"ratio_upper", point.ratio_upper}});
  return entry;
}
} // namespace

std::string comparison_junit(const Comparison &comparison)
{
  std::string cases;
  std::size_t n_failures = 0, n_errors = comparison.problems.size();
  for (const std::string &problem : comparison.problems)
    cases += fmt::format("    <testcase classname=\"pelvireg.{}\" name=\"case\"><error type=\"INCOMPARABLE\" "
                         "message=\"{}\"/></testcase>\n",
                         xml(comparison.case_name), xml(problem));
  for (const FamilyComparison &family : comparison.families)
  {
    cases += test_case(comparison, family);
    n_failures += family.verdict == Verdict::worse;
    n_errors += is_error(family.verdict);
  }
  const std::size_t n_tests = comparison.problems.size() + comparison.families.size();
  return fmt::format("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
                     "<testsuites tests=\"{0}\" failures=\"{1}\" errors=\"{2}\">\n"
                     "  <testsuite name=\"pelvireg compare {3}\" tests=\"{0}\" failures=\"{1}\" errors=\"{2}\">\n"
                     "{4}  </testsuite>\n</testsuites>\n",
                     n_tests, n_failures, n_errors, xml(comparison.case_name), cases);
}

std::string comparison_json(const Comparison &comparison)
{
  json content = {{"format", "pelvireg comparison"},
                  {"format_version", "1.0"},
                  {"units", "mm"},
                  {"case", comparison.case_name},
                  {"verdict", to_string(comparison.verdict())},
                  {"exit_status", comparison.exit_status()},
                  {"baseline", {{"from", comparison.baseline_label}, {"revision", comparison.baseline_revision}}},
                  {"current", {{"from", comparison.current_label}, {"revision", comparison.current_revision}}},
                  {"has_anchor", comparison.has_anchor},
                  {"n_randomised_runs", comparison.n_runs},
                  {"problems", comparison.problems}};
  content["families"] = json::array();
  for (const FamilyComparison &family : comparison.families)
    content["families"].push_back(family_json(family));
  return content.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}
} // namespace pelvireg::regression
