#include "synthetic/anatomy/case.h"
#include "synthetic/dataset/error.h"
#include "validation/cli/case_overview.h"
#include "validation/cli/commands.h"
#include "validation/cli/images_stage.h"
#include "validation/cli/track_stage.h"
#include "validation/runner/register.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

namespace pelvireg::cli
{
namespace
{
struct Arguments
{
  std::vector<std::string> cases;
  std::string out;
  std::vector<std::string> conditions = runner::default_conditions();
  SampleSettings settings;
  int jobs = 1;
  std::string from = "exact";
  observation::ImageOptions images; ///< with from = "images"
};

bool from_images(const Arguments &given)
{
  return given.from == "images";
}

void print_times(const Manifest &manifest)
{
  double total = 0;
  fmt::print("\ntime by stage\n");
  for (const std::string &name : stage_order())
    if (const auto stage = manifest.stages.find(name); stage != manifest.stages.end())
    {
      fmt::print("  {:<32}{:>8.1f} s\n", name, stage->second.seconds);
      total += stage->second.seconds;
    }
  fmt::print("  {:<32}{:>8.1f} s\n", "total", total);
}

/// Of the first condition, `full` when it was registered; the report shows all.
void print_phases(const std::vector<runner::StepTiming> &timings)
{
  const auto shown = std::find_if(timings.begin(), timings.end(),
                                  [](const runner::StepTiming &timing) { return !timing.phases.empty(); });
  if (shown == timings.end())
    return;
  fmt::print("\ntime by phase of a registration step, nominal run of {}, mean\n", shown->condition);
  for (const runner::PhaseTiming &phase : shown->phases)
    fmt::print("  {:<32}{:>8.2f} ms{:>6.1f} %\n", runner::phase_title(phase.name), phase.mean_ms,
               shown->mean_ms > 0 ? 100 * phase.mean_ms / shown->mean_ms : 0);
  fmt::print("  {:<32}{:>8.2f} ms\n", "whole step", shown->mean_ms);
}

/// "all" stands for every built-in case.
std::vector<std::string> expanded_cases(const std::vector<std::string> &given)
{
  std::vector<std::string> cases;
  const auto add = [&](const std::string &name)
  {
    if (std::find(cases.begin(), cases.end(), name) == cases.end())
      cases.push_back(name);
  };
  for (const std::string &name : given)
    if (name == "all")
      for (const anatomy::CaseSummary &summary : anatomy::built_in_cases())
        add(summary.name);
    else
      add(name);
  return cases;
}

void run_chain(const std::string &case_name, const std::filesystem::path &out, const Arguments &given,
               const std::string &command_line)
{
  const std::vector<std::string> conditions = expanded_conditions(given.conditions);
  std::vector<RegisterRequest> requests = requests_of(conditions, given.settings);
  if (from_images(given))
    for (const RegisterRequest &request : tracked_requests_of(conditions))
      requests.push_back(request);
  const std::string text = anatomy::case_text(case_name);
  const std::string label = case_label(case_name);
  ResultDirectory directory(out, command_line, ResultDirectory::Missing::create);

  make_anatomy(directory, label, text);
  make_truth(directory, given.jobs);
  make_observations(directory);
  if (from_images(given))
  {
    observation::ImageOptions images = given.images;
    images.n_threads = given.jobs;
    make_image_files(directory, images);
    make_tracked(directory, {.all = true});
  }
  for (const RegisterRequest &request : requests)
    make_estimate(directory, request, given.jobs);
  Judge judge(given.jobs);
  make_errors(directory, judge);
  make_report(directory, judge);

  print_error_table(directory);
  if (from_images(given))
    print_contour_table(directory);
  print_times(directory.manifest());
  print_phases(recorded_timings(directory));
  fmt::print("\nreport: {}\n", (directory.path() / "report.html").string());
}

void run_cases(const Arguments &given, const std::string &command_line)
{
  if (const auto violations = given.images.violations(); !violations.empty())
    throw InputError(violations.front());
  const std::vector<std::string> cases = expanded_cases(given.cases);
  for (const std::string &name : cases)
    anatomy::case_text(name); // a wrong name is told before the first hour of work
  if (cases.size() == 1)
    return run_chain(cases[0], given.out.empty() ? "out/" + case_label(cases[0]) : given.out, given, command_line);
  std::vector<std::filesystem::path> folders;
  for (std::size_t i = 0; i < cases.size(); ++i)
  {
    fmt::print("\n== {} ({} of {})\n", cases[i], i + 1, cases.size());
    folders.push_back(std::filesystem::path(given.out.empty() ? "out" : given.out) / case_label(cases[i]));
    run_chain(cases[i], folders.back(), given, command_line);
  }
  fmt::print("\n{}", case_overview(folders));
}
} // namespace

void add_run_command(CLI::App &program, Invocation &invocation)
{
  const auto arguments = std::make_shared<Arguments>();
  CLI::App *command = program.add_subcommand(
      "run", "The whole chain: anatomy, reference, observe, register, evaluate, report; prints the error table");
  command
      ->add_option("CASE", arguments->cases,
                   "Built-in names (see 'pelvireg cases') or paths to .toml files; 'all' for every built-in case")
      ->required();
  command->add_option("--out", arguments->out,
                      "Result directory, made when missing; out/CASE when not given. For several cases the folder of "
                      "their directories");
  add_condition_option(*command, arguments->conditions);
  command
      ->add_option("--from", arguments->from,
                   "exact: outlines are intersections with the truth. images: the truth is also rendered as MR images "
                   "and the organs are tracked in them; the registration is driven by both, for comparison")
      ->check(CLI::IsMember({"exact", "images"}))
      ->capture_default_str();
  const CLI::Option *snr = command
                               ->add_option("--snr", arguments->images.snr,
                                            "With --from images: urine's signal over the noise in the dynamic images; "
                                            "0: no noise")
                               ->capture_default_str();
  add_sample_options(*command, arguments->settings);
  add_jobs_option(*command, arguments->jobs);
  command->footer("Examples:\n  pelvireg run quick\n  pelvireg run t005 --out out/t005 --jobs 2\n"
                  "  pelvireg run t005 --conditions all\n"
                  "  pelvireg run t005 --from images --snr 10\n"
                  "  pelvireg run all --conditions all --samples 100\n"
                  "  pelvireg run t005 --samples 100 --perturb modulus,surface,outline,plane\nA stage whose inputs "
                  "have not changed is not run again.");
  command->callback(
      [&invocation, arguments, snr]
      {
        if (snr->count() > 0 && arguments->from != "images")
          throw InputError(
              fmt::format("--snr {} is the noise of images, but outlines come from the exact motion (--from "
                          "{}); add --from images, or leave --snr out.",
                          arguments->images.snr, arguments->from));
        invocation.action = [&invocation, arguments] { run_cases(*arguments, invocation.command_line); };
      });
}
} // namespace pelvireg::cli
