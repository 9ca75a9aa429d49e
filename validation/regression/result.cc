#include "validation/regression/result.h"

#include "synthetic/dataset/error.h"
#include "synthetic/dataset/store.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>

namespace pelvireg::regression
{
namespace
{
using nlohmann::json;
namespace fs = std::filesystem;

const char *const evaluate_again = "run 'pelvireg evaluate' on the result";
const char *const accept_again = "a baseline is changed by 'pelvireg baseline propose' and 'accept' alone; restore it";

json parse(const std::string &text, const fs::path &file, const std::string &remedy)
{
  json content = json::parse(text, nullptr, false);
  if (content.is_discarded() || !content.is_object())
    throw InputError(fmt::format("'{}' is not JSON; {}", file.string(), remedy));
  return content;
}

/// A value of a JSON object. Throws when it is missing or of another type.
template <class Value> Value entry(const json &object, const char *key, const fs::path &file)
{
  try
  {
    return object.at(key).get<Value>();
  }
  catch (const json::exception &)
  {
    throw InputError(fmt::format("'{}' has no usable entry '{}'; make it again with this version", file.string(), key));
  }
}

void require_entry(const json &object, const char *key, const std::string &wanted, const fs::path &file)
{
  const auto got = entry<std::string>(object, key, file);
  if (got != wanted)
    throw InputError(fmt::format("'{}': {} is '{}', must be '{}'; make it again with this version", file.string(), key,
                                 got, wanted));
}

/// Content of a file whose SHA-256 is known.
std::string checked_text(const fs::path &file, const std::string &sha256, const Digest &digest,
                         const std::string &remedy)
{
  std::string text = read_text(file, remedy);
  if (digest(text) != sha256)
    throw InputError(fmt::format("'{}' is not what was written (its SHA-256 differs); {}", file.string(), remedy));
  return text;
}

void add_curves(ErrorResult &result, const std::string &text, Axis axis, const fs::path &file)
{
  result.curves.merge(read_curves(text, axis, file.string()));
}

/// Every registered run has as many steps as it says, and every curve by step belongs to a run.
void require_runs(const ErrorResult &result)
{
  for (const auto &[name, family] : result.curves)
    for (const auto &[sample, curve] : family)
    {
      if (name.condition == "unregistered")
        continue;
      const auto run = result.runs.find({name.condition, sample});
      if (run == result.runs.end() ||
          (name.axis == Axis::step && run->second.n_steps != static_cast<int>(curve.size())))
        throw InputError(fmt::format("'{}': condition '{}', sample {}, {}: {} steps, the record of the run says {}; {}",
                                     result.label, name.condition, sample, name.organ, curve.size(),
                                     run == result.runs.end() ? 0 : run->second.n_steps, evaluate_again));
    }
}

void read_summary(ErrorResult &result, const json &summary, const fs::path &file)
{
  require_entry(summary, "format", "pelvireg summary", file);
  require_entry(summary, "format_version", dataset::store_format_version, file);
  require_entry(summary, "units", "mm", file);
  result.case_name = entry<std::string>(summary, "case", file);
  result.surface_spacing = entry<double>(summary, "surface_spacing_mm", file);
  result.contour_spacing = entry<double>(summary, "contour_spacing_mm", file);
  for (const json &run : entry<json>(summary, "runs", file))
    result.runs[{entry<std::string>(run, "condition", file), entry<int>(run, "sample", file)}] = {
        entry<int>(run, "n_steps", file), entry<int>(run, "n_failed_steps", file)};
}

/// The CSV files were made from the estimates that are there now.
void require_current(const json &stages, const json &files, const fs::path &manifest)
{
  const auto inputs =
      entry<std::map<std::string, std::string>>(entry<json>(stages, "evaluate", manifest), "inputs", manifest);
  for (const auto &[name, sha256] : inputs)
    if (entry<std::string>(entry<json>(files, name.c_str(), manifest), "sha256", manifest) != sha256)
      throw InputError(fmt::format("'{}': the errors were made from another '{}' than the one there now; {}",
                                   manifest.parent_path().string(), name, evaluate_again));
  for (const auto &[name, record] : files.items())
    if (name.starts_with("estimate-") && !inputs.contains(name))
      throw InputError(fmt::format("'{}': the errors were made without '{}'; {}", manifest.parent_path().string(), name,
                                   evaluate_again));
}

void read_runs(ErrorResult &result, const std::string &text, const fs::path &file)
{
  std::istringstream lines(text);
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line))
  {
    const std::size_t comma = line.find(',');
    int sample = 0;
    RunSteps steps;
    if (comma == std::string::npos ||
        std::sscanf(line.c_str() + comma, ",%d,%d,%d", &sample, &steps.n_steps, &steps.n_failed) != 3)
      throw InputError(fmt::format("'{}': '{}' is not a run; {}", file.string(), line, accept_again));
    result.runs[{line.substr(0, comma), sample}] = steps;
  }
}
} // namespace

std::string read_text(const fs::path &file, const std::string &remedy)
{
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  if (!stream || !(text << stream.rdbuf()))
    throw InputError(fmt::format("'{}' cannot be read or is empty; {}", file.string(), remedy));
  return text.str();
}

ErrorResult load_result(const fs::path &directory, const Digest &digest)
{
  const fs::path file = directory / "manifest.json";
  const json manifest = parse(read_text(file, "give an evaluated result directory"), file, "make the result again");
  require_entry(manifest, "format", "pelvireg manifest", file);
  require_entry(manifest, "format_version", dataset::store_format_version, file);
  require_entry(manifest, "units", dataset::store_units, file);
  require_entry(manifest, "frame", dataset::store_frame, file);
  const json files = entry<json>(manifest, "files", file), stages = entry<json>(manifest, "stages", file);
  require_current(stages, files, file);
  const auto text_of = [&](const char *name)
  {
    if (!files.contains(name))
      throw InputError(fmt::format("'{}' has no '{}'; {}", directory.string(), name, evaluate_again));
    return checked_text(directory / name, entry<std::string>(files.at(name), "sha256", file), digest, evaluate_again);
  };

  ErrorResult result;
  result.label = directory.string();
  result.case_text = text_of("case.toml");
  read_summary(result, parse(text_of("summary.json"), directory / "summary.json", evaluate_again),
               directory / "summary.json");
  add_curves(result, text_of("errors_by_step.csv"), Axis::step, directory / "errors_by_step.csv");
  add_curves(result, text_of("errors_by_slice.csv"), Axis::slice, directory / "errors_by_slice.csv");
  require_runs(result);
  result.build = entry<std::string>(entry<json>(manifest, "program", file), "build", file);
  for (const auto &[stage, record] : stages.items())
  {
    result.commands[stage] = entry<std::string>(record, "command_line", file);
    if (stage == "evaluate")
      result.revision = entry<std::string>(record, "revision", file);
  }
  result.inputs = entry<std::map<std::string, std::string>>(entry<json>(stages, "evaluate", file), "inputs", file);
  return result;
}

bool is_baseline(const fs::path &folder)
{
  return fs::is_regular_file(folder / "baseline.json");
}

ErrorResult load_baseline_part(const fs::path &folder, const Digest &digest)
{
  const fs::path file = folder / "baseline.json";
  const json content = parse(read_text(file, accept_again), file, accept_again);
  require_entry(content, "format", "pelvireg baseline", file);
  require_entry(content, "format_version", baseline_format_version, file);
  require_entry(content, "units", "mm", file);
  require_entry(content, "frame", dataset::store_frame, file);
  const auto digests = entry<std::map<std::string, std::string>>(content, "files", file);
  const auto text_of = [&](const char *name)
  {
    if (!digests.contains(name))
      throw InputError(fmt::format("'{}' does not list '{}'; {}", file.string(), name, accept_again));
    return checked_text(folder / name, digests.at(name), digest, accept_again);
  };

  ErrorResult result;
  result.label = folder.string();
  result.case_name = entry<std::string>(content, "case", file);
  result.surface_spacing = entry<double>(content, "surface_spacing_mm", file);
  result.contour_spacing = entry<double>(content, "contour_spacing_mm", file);
  result.case_text = text_of("case.toml");
  add_curves(result, text_of("errors_by_step.csv"), Axis::step, folder / "errors_by_step.csv");
  add_curves(result, text_of("errors_by_slice.csv"), Axis::slice, folder / "errors_by_slice.csv");
  read_runs(result, text_of("runs.csv"), folder / "runs.csv");
  require_runs(result);
  const json provenance = entry<json>(content, "provenance", file);
  result.revision = entry<std::string>(provenance, "revision", file);
  result.build = entry<std::string>(provenance, "build", file);
  result.commands = entry<std::map<std::string, std::string>>(provenance, "commands", file);
  result.inputs = entry<std::map<std::string, std::string>>(provenance, "inputs", file);
  return result;
}

Baseline load_baseline(const fs::path &folder, const Digest &digest)
{
  if (!is_baseline(folder) && !fs::is_regular_file(folder / "manifest.json"))
    throw InputError(fmt::format("MISSING: there is no baseline in '{}'; make one with 'pelvireg baseline propose "
                                 "RESULT --baseline {}' and 'pelvireg baseline accept {} --reason \"...\"'",
                                 folder.string(), folder.string(), folder.string()));
  if (!is_baseline(folder))
    return {load_result(folder, digest), std::nullopt};
  Baseline baseline{load_baseline_part(folder, digest), std::nullopt};
  if (!is_baseline(folder / "anchor"))
    throw InputError(fmt::format("'{}' has no anchor; {}", folder.string(), accept_again));
  baseline.anchor = load_baseline_part(folder / "anchor", digest);
  return baseline;
}

std::string runs_csv(const ErrorResult &result)
{
  std::string text = "condition,sample,n_steps,n_failed_steps\n";
  for (const auto &[run, steps] : result.runs)
    text += fmt::format("{},{},{},{}\n", run.first, run.second, steps.n_steps, steps.n_failed);
  return text;
}
} // namespace pelvireg::regression
