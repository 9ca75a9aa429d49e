#include "validation/cli/commands.h"
#include "validation/cli/stages.h"
#include "validation/cli/track_stage.h"

#include <fmt/format.h>

#include <fstream>
#include <memory>
#include <sstream>

namespace pelvireg::cli
{
namespace
{
struct Arguments
{
  std::string directory;
  int jobs = 1;
  std::string log_file; ///< of the reference
  bool pdf = false;     ///< of the report
};

using Work = std::function<void(ResultDirectory &, const Arguments &)>;

/// A command on one result directory.
CLI::App *add_command(CLI::App &program, Invocation &invocation, const std::shared_ptr<Arguments> &arguments,
                      const std::string &name, const std::string &description, const Work &work)
{
  CLI::App *command = program.add_subcommand(name, description);
  command->add_option("DIR", arguments->directory, "Result directory")->required();
  command->callback(
      [&invocation, arguments, work]
      {
        invocation.action = [&invocation, arguments, work]
        {
          ResultDirectory directory(arguments->directory, invocation.command_line, ResultDirectory::Missing::refuse);
          work(directory, *arguments);
        };
      });
  return command;
}
} // namespace

void print_error_table(const ResultDirectory &directory)
{
  for (const char *file : {"error_table.txt", "condition_table.txt"})
  {
    std::ostringstream table;
    table << std::ifstream(directory.path() / file).rdbuf();
    fmt::print("\n{}", table.str());
  }
  if (const std::string cost = tracking_cost_table(directory); !cost.empty())
    fmt::print("\n{}", cost);
}

void add_stage_commands(CLI::App &program, Invocation &invocation)
{
  const auto reference = std::make_shared<Arguments>();
  CLI::App *command = add_command(
      program, invocation, reference, "reference", "Move the pelvis with the reference solver: truth.h5",
      [](ResultDirectory &directory, const Arguments &given) { make_truth(directory, given.jobs, given.log_file); });
  add_jobs_option(*command, reference->jobs);
  command->add_option("--log", reference->log_file, "Write a line for every step and Newton iteration to this file");
  command->footer("Examples:\n  pelvireg reference out/t005 --jobs 2\n"
                  "  pelvireg reference out/t005 --log reference.log");

  command = add_command(program, invocation, std::make_shared<Arguments>(), "observe",
                        "Outlines in the image plane and validation slices: observations.h5",
                        [](ResultDirectory &directory, const Arguments &) { make_observations(directory); });
  command->footer("Example:\n  pelvireg observe out/t005");

  const auto evaluate = std::make_shared<Arguments>();
  command = add_command(program, invocation, evaluate, "evaluate",
                        "Errors of every estimate in the directory: errors_by_*.csv, summary.json",
                        [](ResultDirectory &directory, const Arguments &given)
                        {
                          Judge judge(given.jobs);
                          make_errors(directory, judge);
                          print_error_table(directory);
                        });
  add_jobs_option(*command, evaluate->jobs);
  command->footer("Example:\n  pelvireg evaluate out/t005");

  const auto report = std::make_shared<Arguments>();
  command = add_command(program, invocation, report, "report",
                        "The page for people: report.html, with its pictures and figures beside it",
                        [](ResultDirectory &directory, const Arguments &given)
                        {
                          Judge judge(given.jobs);
                          make_report(directory, judge);
                          if (given.pdf)
                            make_summary_pdf(directory, judge);
                        });
  add_jobs_option(*command, report->jobs);
  command->add_flag("--pdf", report->pdf, "Also one A4 page: summary.pdf (needs Chromium)");
  command->footer("Examples:\n  pelvireg report out/t005\n  pelvireg report out/t005 --pdf");
}
} // namespace pelvireg::cli
