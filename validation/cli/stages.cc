#include "validation/cli/stages.h"

#include "reference_fe/reference.h"
#include "synthetic/anatomy/case.h"
#include "synthetic/dataset/atomic_file.h"
#include "synthetic/dataset/error.h"
#include "synthetic/observation/observe.h"
#include "validation/cli/register_stage.h"
#include "validation/cli/self_generated_stage.h"
#include "validation/cli/sha256.h"
#include "validation/cli/studies.h"
#include "validation/cli/timing_notes.h"
#include "validation/runner/condition_table.h"
#include "validation/runner/error_table.h"
#include "validation/runner/result_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <optional>
#include <sstream>
#include <utility>

namespace pelvireg::cli
{
std::vector<std::string> estimate_files(const ResultDirectory &directory)
{
  std::vector<std::string> files;
  for (const auto &entry : std::filesystem::directory_iterator(directory.path()))
  {
    const std::string name = entry.path().filename().string();
    if (name.rfind("estimate-", 0) == 0 && entry.path().extension() == ".h5")
      files.push_back(name);
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<runner::StepTiming> recorded_timings(const ResultDirectory &directory)
{
  std::vector<runner::StepTiming> timings;
  for (const std::string &label : estimate_labels())
  {
    const StageRecord *maker = directory.manifest().maker_of("estimate-" + label + ".h5");
    if (maker)
      if (const auto timing = timing_in(maker->notes, label))
        timings.push_back(*timing);
  }
  return timings;
}

const Judgement &Judge::of(const ResultDirectory &directory, Progress &progress)
{
  if (judgement_)
    return *judgement_;
  Judgement judgement{.anatomy = dataset::load_anatomy(directory.path() / "anatomy.h5"),
                      .truth = dataset::load_truth(directory.path() / "truth.h5"),
                      .nominal_runs = {},
                      .evaluation = {}};
  std::vector<runner::RunSource> sources;
  for (const std::string &file : estimate_files(directory))
  {
    sources.push_back(runner::runs_in(directory.path() / file));
    judgement.nominal_runs.push_back(dataset::load_first_run(directory.path() / file));
  }
  judgement.evaluation = runner::evaluate_runs(judgement.anatomy, judgement.truth, sources,
                                               {.n_threads = jobs_, .progress = progress.callback()});
  return judgement_.emplace(std::move(judgement));
}

std::vector<std::string> stage_order()
{
  std::vector<std::string> names = {"anatomy", "reference", "observe", "images", "track"};
  for (const std::string &label : estimate_labels())
    names.push_back("register " + label);
  names.insert(names.end(), {"evaluate", "report"});
  return names;
}

void make_anatomy(ResultDirectory &directory, const std::string &case_name, const std::string &text)
{
  directory.run({.name = "anatomy",
                 .code = {"synthetic/anatomy", "synthetic/dataset"},
                 .options = "case " + case_name + " " + sha256_of_text(text),
                 .inputs = {},
                 .outputs = {"anatomy.h5", "case.toml"},
                 .work = [&](Progress &) -> Notes
                 {
                   const dataset::Anatomy anatomy = anatomy::build_anatomy(text, case_name);
                   dataset::write_text_file(directory.path() / "case.toml", text);
                   save(anatomy, directory.path() / "anatomy.h5");
                   return {};
                 }});
}

void make_truth(ResultDirectory &directory, int jobs, const std::string &log_file,
                const std::filesystem::path &elsewhere)
{
  // An anatomy without its case file is not one that a mesh study can know.
  std::optional<dataset::DiscretisationError> error_bar;
  if (directory.has("case.toml"))
  {
    std::ostringstream text;
    text << std::ifstream(directory.path() / "case.toml", std::ios::binary).rdbuf();
    if (const auto driver = anatomy::self_generated_from(text.str(), "case.toml"))
      return make_self_generated_truth(directory, *driver, jobs);
    error_bar = known_discretisation_error(text.str(), "case.toml");
  }
  directory.run({.name = "reference",
                 .code = {"reference_fe", "synthetic/dataset"},
                 .options = error_bar ? "mesh study " + error_bar->revision + " " + error_bar->case_sha256 : "",
                 .inputs = {"anatomy.h5"},
                 .outputs = {"truth.h5"},
                 .work = [&](Progress &progress) -> Notes
                 {
                   const dataset::Anatomy anatomy = dataset::load_anatomy(directory.path() / "anatomy.h5");
                   reference_fe::ReferenceOptions options{.n_threads = jobs, .progress = progress.callback()};
                   std::ofstream log;
                   if (!log_file.empty())
                   {
                     log.open(log_file);
                     if (!log)
                       throw InputError(fmt::format("The log '{}' cannot be written; give another name.", log_file));
                     options.log = [&log](const std::string &line) { log << line << std::endl; };
                   }
                   dataset::Truth truth = reference_fe::solve_reference(anatomy, options);
                   truth.discretisation_error = error_bar;
                   save(truth, directory.path() / "truth.h5");
                   return {};
                 },
                 .elsewhere = {elsewhere}});
}

void make_observations(ResultDirectory &directory)
{
  directory.run({.name = "observe",
                 .code = {"synthetic/observation", "synthetic/dataset"},
                 .options = "",
                 .inputs = {"anatomy.h5", "truth.h5"},
                 .outputs = {"observations.h5"},
                 .work = [&](Progress &) -> Notes
                 {
                   const dataset::Anatomy anatomy = dataset::load_anatomy(directory.path() / "anatomy.h5");
                   const dataset::Truth truth = dataset::load_truth(directory.path() / "truth.h5");
                   save(observation::observe(anatomy, truth), directory.path() / "observations.h5");
                   return {};
                 }});
}

void make_errors(ResultDirectory &directory, Judge &judge)
{
  const std::vector<std::string> estimates = estimate_files(directory);
  std::vector<std::string> inputs = {"anatomy.h5", "truth.h5"};
  inputs.insert(inputs.end(), estimates.begin(), estimates.end());
  const std::vector<runner::StepTiming> timings = recorded_timings(directory);
  std::string options;
  for (const runner::StepTiming &timing : timings)
    for (const auto &[name, value] : notes_of(timing)) // summary.json and the table print them
      options += fmt::format("{} {} {}\n", timing.condition, name, value);
  directory.run(
      {.name = "evaluate",
       .code = {"validation/metrics", "validation/runner", "synthetic/dataset"},
       .options = options,
       .inputs = inputs,
       .outputs = {"errors_by_step.csv", "errors_by_slice.csv", "metrics_by_step.csv", "errors_by_distance.csv",
                   "curves_by_step.csv", "curves_by_slice.csv", "summary.json", "error_table.txt",
                   "condition_table.txt"},
       .work = [&](Progress &progress) -> Notes
       {
         const runner::Evaluation &evaluation = judge.of(directory, progress).evaluation;
         runner::write_result_files(evaluation, timings, directory.path());
         dataset::write_text_file(directory.path() / "error_table.txt", runner::error_table(evaluation, timings));
         dataset::write_text_file(directory.path() / "condition_table.txt", runner::condition_table(evaluation));
         return {};
       }});
}
} // namespace pelvireg::cli
