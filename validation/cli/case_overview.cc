#include "validation/cli/case_overview.h"

#include "synthetic/dataset/error.h"
#include "synthetic/dataset/geometry.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>

namespace pelvireg::cli
{
namespace
{
using json = nlohmann::json;

json summary_of(const std::filesystem::path &directory)
{
  std::ifstream file(directory / "summary.json");
  const json summary = json::parse(file, nullptr, false);
  if (summary.is_discarded() || !summary.contains("claims") || !summary.contains("errors"))
    throw InputError(fmt::format("'{}' is not a summary that can be read; run 'pelvireg evaluate {}'",
                                 (directory / "summary.json").string(), directory.string()));
  return summary;
}

std::string error_of(const json &summary, const std::string &condition, const std::string &organ)
{
  const json::json_pointer place("/errors/" + condition + "/" + organ + "/last_step/mean_mm");
  return summary.contains(place) ? fmt::format("{:.2f}", summary.at(place).get<double>()) : "-";
}

std::string mark(const std::string &verdict)
{
  return verdict == "confirmed" ? "+" : verdict == "refuted" ? "x" : ".";
}

std::string verdict_of(const json &summary, const std::string &claim)
{
  for (const json &entry : summary.at("claims"))
    if (entry.at("id") == claim)
      return entry.at("verdict").get<std::string>();
  return "-";
}
/// One column a claim, numbered as in the list under the table.
std::string claims_table(const std::vector<json> &summaries, std::size_t width)
{
  const json &claims = summaries.front().at("claims");
  std::string text = fmt::format("The paper's claims: confirmed (+), refuted (x), not assessed (.)\n{:<{}}", "", width);
  for (std::size_t k = 1; k <= claims.size(); ++k)
    text += fmt::format("{:>4}", k);
  for (const json &summary : summaries)
  {
    text += fmt::format("\n{:<{}}", summary.at("case").get<std::string>(), width);
    for (const json &claim : claims)
      text += fmt::format("{:>4}", mark(verdict_of(summary, claim.at("id"))));
  }
  text += "\n";
  for (std::size_t k = 1; k <= claims.size(); ++k)
    text += fmt::format("{}{} {}", k == 1 ? "" : ", ", k, claims[k - 1].at("id").get<std::string>());
  return text + "\n";
}
} // namespace

std::string case_overview(const std::vector<std::filesystem::path> &directories)
{
  std::vector<json> summaries;
  std::size_t width = 8;
  for (const std::filesystem::path &directory : directories)
  {
    summaries.push_back(summary_of(directory));
    width = std::max(width, summaries.back().at("case").get<std::string>().size() + 2);
  }
  if (summaries.empty())
    return "";
  std::string text =
      fmt::format("Mean surface error at the last step, mm: without / with boundary conditions\n{:<{}}", "", width);
  for (const std::string &organ : dataset::organ_names)
    text += fmt::format("{:>15}", organ);
  for (const json &summary : summaries)
  {
    text += fmt::format("\n{:<{}}", summary.at("case").get<std::string>(), width);
    for (const std::string &organ : dataset::organ_names)
      text += fmt::format("{:>15}", error_of(summary, "no_boundary_conditions", organ) + " / " +
                                        error_of(summary, "full", organ));
    text += summary.value("inverse_crime", false) ? "  (inverse crime)" : "";
  }
  return text + "\n\n" + claims_table(summaries, width);
}
} // namespace pelvireg::cli
