#include "synthetic/anatomy/case.h"
#include "validation/cli/commands.h"
#include "validation/runner/register.h"

#include <fmt/format.h>

#include <memory>

namespace pelvireg::cli
{
namespace
{
struct Arguments
{
  std::string case_name, out;
  std::vector<std::string> conditions = runner::default_conditions();
  SampleSettings settings;
  int jobs = 1;
};

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

void run_chain(const Arguments &given, const std::string &command_line)
{
  const std::vector<RegisterRequest> requests = requests_of(expanded_conditions(given.conditions), given.settings);
  const std::string text = anatomy::case_text(given.case_name);
  const std::string label = case_label(given.case_name);
  const std::filesystem::path out = given.out.empty() ? "out/" + label : given.out;
  ResultDirectory directory(out, command_line, ResultDirectory::Missing::create);

  make_anatomy(directory, label, text);
  make_truth(directory, given.jobs);
  make_observations(directory);
  for (const RegisterRequest &request : requests)
    make_estimate(directory, request, given.jobs);
  Judge judge(given.jobs);
  make_errors(directory, judge);
  make_report(directory, judge);

  print_error_table(directory);
  print_times(directory.manifest());
  fmt::print("\nreport: {}\n", (directory.path() / "report.html").string());
}
} // namespace

void add_run_command(CLI::App &program, Invocation &invocation)
{
  const auto arguments = std::make_shared<Arguments>();
  CLI::App *command = program.add_subcommand(
      "run", "The whole chain: anatomy, reference, observe, register, evaluate, report; prints the error table");
  command->add_option("CASE", arguments->case_name, "Built-in name (see 'pelvireg cases') or path to a .toml file")
      ->required();
  command->add_option("--out", arguments->out, "Result directory, made when missing; out/CASE when not given");
  add_condition_option(*command, arguments->conditions);
  add_sample_options(*command, arguments->settings);
  add_jobs_option(*command, arguments->jobs);
  command->footer("Examples:\n  pelvireg run quick\n  pelvireg run t005 --out out/t005 --jobs 2\n"
                  "  pelvireg run t005 --conditions all\n"
                  "  pelvireg run t005 --samples 100 --perturb modulus,surface,outline,plane\nA stage whose inputs "
                  "have not changed is not run again.");
  command->callback(
      [&invocation, arguments]
      { invocation.action = [&invocation, arguments] { run_chain(*arguments, invocation.command_line); }; });
}
} // namespace pelvireg::cli
