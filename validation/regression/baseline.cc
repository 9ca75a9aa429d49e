#include "validation/regression/baseline.h"

#include "synthetic/dataset/atomic_file.h"
#include "synthetic/dataset/error.h"
#include "synthetic/dataset/store.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cctype>

namespace pelvireg::regression
{
namespace
{
using nlohmann::ordered_json;
namespace fs = std::filesystem;

const std::array<const char *, 4> content_files = {"case.toml", "errors_by_step.csv", "errors_by_slice.csv",
                                                   "runs.csv"};
const char *const propose_first = "make one with 'pelvireg baseline propose'";

std::string digest_of_baseline(const fs::path &folder, const Digest &digest)
{
  return is_baseline(folder) ? digest(read_text(folder / "baseline.json", propose_first)) : "";
}

ordered_json read_json(const fs::path &file)
{
  return ordered_json::parse(read_text(file, propose_first)); // load_baseline_part has seen that it is sound
}

void require_enough_runs(const ErrorResult &result)
{
  const int least = Rule().least_samples;
  for (const auto &[name, family] : result.curves)
  {
    const auto n = std::count_if(family.begin(), family.end(), [](const auto &run) { return run.first != 0; });
    if (name.condition != "unregistered" && n < least)
      throw InputError(
          fmt::format("'{}': condition '{}' has {} randomised runs, a baseline needs at least {}; register "
                      "with --samples {}",
                      result.label, name.condition, n, least, 2 * least));
  }
}

ordered_json description(const ErrorResult &result, const Machine &machine)
{
  return {{"format", "pelvireg baseline"},
          {"format_version", baseline_format_version},
          {"units", "mm"},
          {"frame", dataset::store_frame},
          {"case", result.case_name},
          {"surface_spacing_mm", result.surface_spacing},
          {"contour_spacing_mm", result.contour_spacing},
          {"provenance",
           {{"revision", result.revision},
            {"build", result.build},
            {"packages", machine.packages},
            {"instruction_set", machine.instruction_set},
            {"commands", result.commands},
            {"inputs", result.inputs}}}};
}

/// Copy the content files and write baseline.json last: until it is there, the folder is not sound.
void publish(const fs::path &from, const fs::path &to, const std::string &description)
{
  fs::create_directories(to);
  for (const char *name : content_files)
    dataset::write_text_file(to / name, read_text(from / name, propose_first));
  dataset::write_text_file(to / "baseline.json", description);
}

void require_reason(const std::string &reason)
{
  constexpr int least = 10;
  if (std::count_if(reason.begin(), reason.end(), [](unsigned char c) { return std::isalpha(c); }) < least)
    throw InputError(fmt::format("the reason '{}' says nothing; say in --reason why the curves may change (at least {} "
                                 "letters)",
                                 reason, least));
}

void require_no_loss_against_anchor(const ErrorResult &candidate, const fs::path &folder, const Digest &digest)
{
  const Comparison comparison = compare({load_baseline_part(folder / "anchor", digest), std::nullopt}, candidate);
  if (comparison.exit_status() == 0)
    return;
  std::string first = comparison.problems.empty() ? "" : comparison.problems.front();
  for (const FamilyComparison &family : comparison.families)
    if (first.empty() && family.verdict >= Verdict::incomparable)
      first = fmt::format("{}, {}: {}", family.name.condition, family.name.organ, family.reasons.front());
  throw InputError(fmt::format("the candidate is {} against the frozen anchor ({}); when that is meant, freeze it anew "
                               "with --anchor",
                               to_string(comparison.verdict()), first));
}
} // namespace

void propose_baseline(const fs::path &result_directory, const fs::path &folder, const Machine &machine,
                      const Digest &digest)
{
  const ErrorResult result = load_result(result_directory, digest);
  require_enough_runs(result);
  const fs::path candidate = folder / "candidate";
  fs::remove_all(candidate);
  fs::create_directories(candidate);
  ordered_json content = description(result, machine);
  content["parent"] = digest_of_baseline(folder, digest);
  for (const char *name : content_files)
  {
    const std::string text =
        std::string(name) == "runs.csv" ? runs_csv(result) : read_text(result_directory / name, propose_first);
    dataset::write_text_file(candidate / name, text);
    content["files"][name] = digest(text);
  }
  dataset::write_text_file(candidate / "baseline.json", content.dump(2) + "\n");
}

void accept_baseline(const fs::path &folder, const std::string &reason, bool renew_anchor, const Digest &digest)
{
  require_reason(reason);
  const fs::path candidate = folder / "candidate";
  if (!is_baseline(candidate))
    throw InputError(fmt::format("there is no candidate in '{}'; {}", folder.string(), propose_first));
  const ErrorResult proposed = load_baseline_part(candidate, digest);
  ordered_json content = read_json(candidate / "baseline.json");
  const std::string parent = digest_of_baseline(folder, digest);
  if (content.at("parent") != parent)
    throw InputError(fmt::format("the baseline in '{}' is another one than when the candidate was proposed; propose "
                                 "again",
                                 folder.string()));
  const bool has_anchor = is_baseline(folder / "anchor");
  if (has_anchor && !renew_anchor)
    require_no_loss_against_anchor(proposed, folder, digest);
  content["reason"] = reason;
  content["history"] = ordered_json::array();
  if (!parent.empty())
  {
    const ordered_json before = read_json(folder / "baseline.json");
    content["history"] = before.at("history");
    content["history"].push_back(
        {{"sha256", parent}, {"revision", before.at("provenance").at("revision")}, {"reason", before.at("reason")}});
  }
  const std::string text = content.dump(2) + "\n";
  publish(candidate, folder, text);
  if (!has_anchor || renew_anchor)
    publish(candidate, folder / "anchor", text);
  fs::remove_all(candidate);
}
} // namespace pelvireg::regression
