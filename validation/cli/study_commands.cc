#include "validation/cli/commands.h"
#include "validation/cli/studies.h"

#include <fmt/format.h>

#include <memory>

namespace pelvireg::cli
{
namespace
{
struct Arguments
{
  std::string case_name, out;
  int jobs = 1;
  double ratio = 1.41421356, leak_rate = 100;
};

CLI::App *add_study(CLI::App &program, Invocation &invocation, const std::shared_ptr<Arguments> &arguments,
                    const std::string &name, const std::string &description,
                    const std::function<void(const StudySettings &, const Arguments &)> &work)
{
  CLI::App *command = program.add_subcommand(name, description);
  command->add_option("CASE", arguments->case_name, "Built-in name (see 'pelvireg cases') or path to a .toml file")
      ->required();
  command->add_option("--out", arguments->out,
                      "Folder of the study, made when missing; out/CASE-" + name + " when not given");
  add_jobs_option(*command, arguments->jobs);
  command->callback(
      [&invocation, arguments, work, name]
      {
        invocation.action = [&invocation, arguments, work, name]
        {
          const std::string folder =
              arguments->out.empty() ? "out/" + case_label(arguments->case_name) + "-" + name : arguments->out;
          work({arguments->case_name, folder, invocation.command_line, arguments->jobs}, *arguments);
        };
      });
  return command;
}
} // namespace

void add_study_commands(CLI::App &program, Invocation &invocation)
{
  const auto mesh = std::make_shared<Arguments>();
  CLI::App *command =
      add_study(program, invocation, mesh, "mesh-study",
                "Solve the reference on three meshes: observed order and error bar of the truth",
                [](const StudySettings &settings, const Arguments &given) { run_mesh_study(settings, given.ratio); });
  command->add_option("--ratio", mesh->ratio,
                      "Cell size of each mesh over that of the next finer one; the finest is the case's own");
  command->footer("Examples:\n  pelvireg mesh-study t005 --jobs 2\n  pelvireg mesh-study quick --ratio 1.3\n"
                  "The fine mesh is the case's own.");

  const auto cavities = std::make_shared<Arguments>();
  command = add_study(program, invocation, cavities, "cavity-study",
                      "Solve the reference with closed, leaking and open cavities: how far the motion differs",
                      [](const StudySettings &settings, const Arguments &given)
                      { run_cavity_study(settings, given.leak_rate); });
  command->add_option("--leak", cavities->leak_rate, "mm^3 per kPa and increment that leave each leaking cavity")
      ->check(CLI::PositiveNumber);
  command->footer("Example:\n  pelvireg cavity-study quick --leak 100");
}
} // namespace pelvireg::cli
