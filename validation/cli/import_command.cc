#include "reference_fe/decks/decks.h"
#include "synthetic/dataset/error.h"
#include "validation/cli/commands.h"
#include "validation/cli/sha256.h"

#include <fmt/format.h>

#include <memory>

namespace pelvireg::cli
{
namespace
{
struct Arguments
{
  std::string directory, file;
  double pressure = 0; ///< MPa
};

struct ResultFile
{
  reference_fe::NodalResults (*read)(const std::filesystem::path &);
  const char *kind;
};

ResultFile result_file(const std::filesystem::path &file)
{
  if (!std::filesystem::is_regular_file(file))
    throw InputError(
        fmt::format("'{}' is not a file; give CalculiX' .frd file or a .csv table of displacements", file.string()));
  if (file.extension() == ".frd")
    return {reference_fe::read_frd, "CalculiX .frd"};
  if (file.extension() == ".csv")
    return {reference_fe::read_displacement_csv, "displacement table"};
  throw InputError(fmt::format("'{}' ends in '{}', must end in .frd (CalculiX) or .csv (see docs/decks.md)",
                               file.string(), file.extension().string()));
}

/// truth.h5 from another program's displacements.
void import_truth(ResultDirectory &directory, const Arguments &given)
{
  const std::filesystem::path file = given.file;
  const ResultFile found = result_file(file);
  const std::string digest = sha256_of_file(file);
  directory.run({.name = "import",
                 .code = {"reference_fe", "reference_fe/decks", "synthetic/dataset"},
                 .options = fmt::format("{} {} pressure {}", found.kind, digest, given.pressure),
                 .inputs = {"anatomy.h5"},
                 .outputs = {"truth.h5"},
                 .work = [&](Progress &) -> Notes
                 {
                   const dataset::Anatomy anatomy = dataset::load_anatomy(directory.path() / "anatomy.h5");
                   save(reference_fe::imported_truth(anatomy, found.read(file),
                                                     fmt::format("imported {} (SHA-256 {})", found.kind, digest),
                                                     given.pressure),
                        directory.path() / "truth.h5");
                   return {};
                 }});
}
} // namespace

void add_import_command(CLI::App &program, Invocation &invocation)
{
  const auto arguments = std::make_shared<Arguments>();
  CLI::App *command =
      program.add_subcommand("import", "Take another program's motion of the exported deck as truth: truth.h5");
  command->add_option("DIR", arguments->directory, "Result directory with the anatomy that was exported")->required();
  command
      ->add_option("--from", arguments->file,
                   "CalculiX' result NAME.frd, or a table NAME.csv with the columns increment,node,u1,u2,u3 (mm)")
      ->required();
  command
      ->add_option("--pressure", arguments->pressure, "Abdominal pressure at the last increment, MPa, for the record")
      ->capture_default_str();
  command->footer("Examples:\n  pelvireg import out/t005 --from out/t005/abaqus/pelvis.frd --pressure 0.012\n"
                  "  pelvireg import out/t005 --from abaqus_report.csv\n"
                  "Then go on with 'pelvireg observe DIR'. 'pelvireg reference DIR' and 'run' put the reference's own "
                  "truth back.");
  command->callback(
      [&invocation, arguments]
      {
        invocation.action = [&invocation, arguments]
        {
          ResultDirectory directory(arguments->directory, invocation.command_line, ResultDirectory::Missing::refuse);
          import_truth(directory, *arguments);
        };
      });
}
} // namespace pelvireg::cli
