#include "validation/cli/commands.h"
#include "validation/report/export_vtk.h"
#include "validation/report/pictures.h"

#include <fmt/format.h>

#include <memory>

namespace pelvireg::cli
{
namespace
{
void export_for_paraview(const ResultDirectory &directory)
{
  const std::filesystem::path folder = directory.path() / "vtk";
  std::vector<dataset::Estimate> estimates;
  for (const std::string &file : estimate_files(directory))
    estimates.push_back(dataset::load_estimate(directory.path() / file));
  report::export_vtk(dataset::load_anatomy(directory.path() / "anatomy.h5"),
                     dataset::load_truth(directory.path() / "truth.h5"),
                     dataset::load_observations(directory.path() / "observations.h5"), estimates, folder);
  fmt::print("export: {}\n", folder.string());
}

/// Started by the report stage as a child, since VTK ends the process that has no display.
void add_hidden_render(CLI::App &program, Invocation &invocation)
{
  const auto paths = std::make_shared<std::pair<std::string, std::string>>();
  CLI::App *render = program.add_subcommand("render", "")->group("");
  render->add_option("RESULT", paths->first)->required();
  render->add_option("FOLDER", paths->second)->required();
  render->callback([&invocation, paths]
                   { invocation.action = [paths] { report::render_result(paths->first, paths->second); }; });
}
} // namespace

void add_export_command(CLI::App &program, Invocation &invocation)
{
  struct Arguments
  {
    std::string directory, format;
  };
  const auto arguments = std::make_shared<Arguments>();
  CLI::App *command = program.add_subcommand("export", "Files for other programs");
  command->add_option("DIR", arguments->directory, "Result directory")->required();
  command->add_option("--format", arguments->format, "vtk: VTK XML files and .pvd collections for ParaView, in DIR/vtk")
      ->required()
      ->check(CLI::IsMember({"vtk"}));
  command->footer("Example:\n  pelvireg export out/t005 --format vtk");
  command->callback(
      [&invocation, arguments]
      {
        invocation.action = [&invocation, arguments]
        {
          const ResultDirectory directory(arguments->directory, invocation.command_line,
                                          ResultDirectory::Missing::refuse);
          export_for_paraview(directory);
        };
      });
  add_hidden_render(program, invocation);
}
} // namespace pelvireg::cli
