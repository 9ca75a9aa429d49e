#include "reference_fe/decks/decks.h"
#include "synthetic/dataset/atomic_file.h"
#include "synthetic/dataset/error.h"
#include "validation/cli/commands.h"
#include "validation/report/export_gltf.h"
#include "validation/report/export_vtk.h"
#include "validation/report/pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>

namespace pelvireg::cli
{
namespace
{
std::vector<dataset::Estimate> nominal_runs(const ResultDirectory &directory)
{
  std::vector<dataset::Estimate> estimates;
  for (const std::string &file : estimate_files(directory))
    estimates.push_back(dataset::load_first_run(directory.path() / file));
  return estimates;
}

void export_for_paraview(const ResultDirectory &directory)
{
  const std::filesystem::path folder = directory.path() / "vtk";
  report::export_vtk(dataset::load_anatomy(directory.path() / "anatomy.h5"),
                     dataset::load_truth(directory.path() / "truth.h5"),
                     dataset::load_observations(directory.path() / "observations.h5"), nominal_runs(directory), folder);
  fmt::print("export: {}\n", folder.string());
}

void export_for_viewers(const ResultDirectory &directory)
{
  const std::filesystem::path folder = directory.path() / "gltf";
  report::export_gltf(dataset::load_anatomy(directory.path() / "anatomy.h5"),
                      dataset::load_truth(directory.path() / "truth.h5"), nominal_runs(directory), folder);
  fmt::print("export: {}\n", folder.string());
}

struct ExportArguments
{
  std::string directory, format;
  reference_fe::DeckOptions deck;
  std::optional<double> pressure; ///< MPa
  bool with_cavities = false;
  std::vector<std::string> parts;
};

/// The pressures of truth.h5, or an even rise to the one that is given.
reference_fe::DeckLoads deck_loads(const ResultDirectory &directory, const dataset::Anatomy &anatomy,
                                   const ExportArguments &given)
{
  if (given.pressure)
  {
    if (given.with_cavities)
      throw InputError(
          "--cavity-pressures takes the pressures of truth.h5, --pressure an even rise; give one of the two");
    reference_fe::DeckLoads loads;
    for (int i = 1; i <= anatomy.reference.n_increments; ++i)
      loads.pressure.push_back(*given.pressure * i / anatomy.reference.n_increments);
    return loads;
  }
  if (!directory.has("truth.h5"))
    throw InputError(
        fmt::format("'{}' has no truth.h5, whose pressures would load the deck; give --pressure MPA or run "
                    "'pelvireg reference {}' first",
                    directory.path().string(), directory.path().string()));
  const dataset::Truth truth = dataset::load_truth(directory.path() / "truth.h5");
  const reference_fe::DeckLoads loads = reference_fe::loads_of(truth, given.with_cavities);
  if (std::all_of(loads.pressure.begin(), loads.pressure.end(), [](double p) { return p == 0; }))
    throw InputError("truth.h5 states no pressure (it was imported); give --pressure MPA");
  if (given.with_cavities && loads.cavity_pressure.empty())
    throw InputError("truth.h5 holds no cavity, so --cavity-pressures has nothing to take; leave it out");
  return loads;
}

void export_deck(const ResultDirectory &directory, const ExportArguments &given)
{
  if (!directory.has("anatomy.h5"))
    throw InputError(fmt::format("'{}' has no anatomy.h5; make it with 'pelvireg anatomy CASE --out {}'",
                                 directory.path().string(), directory.path().string()));
  dataset::Anatomy anatomy = dataset::load_anatomy(directory.path() / "anatomy.h5");
  if (!given.parts.empty())
    anatomy = reference_fe::cut_parts(anatomy, given.parts);
  const std::string text = reference_fe::abaqus_deck(anatomy, deck_loads(directory, anatomy, given), given.deck);
  const std::filesystem::path file = directory.path() / "abaqus" / "pelvis.inp";
  std::filesystem::create_directories(file.parent_path());
  dataset::write_text_file(file, text);
  fmt::print("export: {}\n", file.string());
}

void refuse_deck_options(const CLI::App &command)
{
  for (const char *option : {"--pressure", "--cavity-pressures", "--layers", "--springs", "--parts"})
    if (command.count(option) > 0)
      throw InputError(fmt::format("{} belongs to --format abaqus; leave it out", option));
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
  const auto arguments = std::make_shared<ExportArguments>();
  CLI::App *command = program.add_subcommand("export", "Files for other programs");
  command->add_option("DIR", arguments->directory, "Result directory")->required();
  command
      ->add_option(
          "--format", arguments->format,
          "vtk: VTK XML files and .pvd collections for ParaView, in DIR/vtk; gltf: the final state coloured by its "
          "error, a .glb an estimate, in DIR/gltf; abaqus: input deck for Abaqus and CalculiX, DIR/abaqus/pelvis.inp")
      ->required()
      ->check(CLI::IsMember({"vtk", "gltf", "abaqus"}));
  command->add_option("--pressure", arguments->pressure,
                      "Deck: abdominal pressure at the last step, MPa, rising evenly; truth.h5's when not given");
  command->add_flag("--cavity-pressures", arguments->with_cavities,
                    "Deck: truth.h5's fluid pressures act in the cavities, which are empty otherwise");
  command->add_option("--layers", arguments->deck.layers, "Deck: bricks through each wall")
      ->check(CLI::Range(1, 8))
      ->capture_default_str();
  command->add_flag("--springs", arguments->deck.springs,
                    "Deck: bars as nonlinear springs (SPRINGA) instead of T3D2, for CalculiX with many bars");
  command->add_option("--parts", arguments->parts, "Deck: these parts alone, bars to others end in space")
      ->delimiter(',');
  command->footer("Examples:\n  pelvireg export out/t005 --format vtk\n"
                  "  pelvireg export out/t005 --format gltf\n"
                  "  pelvireg export out/t005 --format abaqus --cavity-pressures\n"
                  "  pelvireg export out/t005 --format abaqus --parts bladder --pressure -0.001\n"
                  "Contact and incompressible fluid are not in a deck; docs/decks.md says what is.");
  command->callback(
      [&invocation, arguments, command]
      {
        invocation.action = [&invocation, arguments, command]
        {
          if (arguments->format != "abaqus")
            refuse_deck_options(*command);
          const ResultDirectory directory(arguments->directory, invocation.command_line,
                                          ResultDirectory::Missing::refuse);
          if (arguments->format == "vtk")
            export_for_paraview(directory);
          else if (arguments->format == "gltf")
            export_for_viewers(directory);
          else
            export_deck(directory, *arguments);
        };
      });
  add_hidden_render(program, invocation);
}
} // namespace pelvireg::cli
