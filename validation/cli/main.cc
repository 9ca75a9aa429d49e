// The pelvireg program: words in, exit status out. 0: done. 1: a computation failed. 2: bad input.
#include "synthetic/dataset/error.h"
#include "validation/cli/commands.h"
#include "validation/cli/environment.h"
#include "validation/cli/version.h"

#include <fmt/format.h>

#include <iostream>

namespace
{
constexpr int exit_computation_failed = 1;
constexpr int exit_bad_input = 2;

std::string joined(int argc, char **argv)
{
  std::string line = "pelvireg";
  for (int i = 1; i < argc; ++i)
    line += std::string(" ") + argv[i];
  return line;
}

int fail(const std::string &sentence, int status)
{
  std::cout.flush();
  std::cerr << "pelvireg: " << sentence << std::endl;
  return status;
}

void describe(CLI::App &program, pelvireg::cli::Invocation &invocation)
{
  using namespace pelvireg::cli;
  program.name("pelvireg");
  program.set_version_flag("--version", fmt::format("pelvireg {} (revision {}, {})", version(), revision(), build()));
  program.footer("Examples:\n"
                 "  pelvireg run quick             the whole chain on a coarse case, under half a minute\n"
                 "  pelvireg run t005              the paper's synthetic evaluation, results in out/t005\n"
                 "  pelvireg register --help       options of one stage\n"
                 "Exit status: 0 done, 1 a computation failed (compare: curves are worse), 2 bad input. Units: mm, N, "
                 "MPa, s, t. Frame: LPS.");
  add_run_command(program, invocation);
  add_case_commands(program, invocation);
  add_stage_commands(program, invocation);
  add_images_command(program, invocation);
  add_track_command(program, invocation);
  add_register_commands(program, invocation);
  add_study_commands(program, invocation);
  add_export_command(program, invocation);
  add_import_command(program, invocation);
  add_compare_command(program, invocation);
  add_baseline_command(program, invocation);
}

/// One sentence for a mistake in the command line.
std::string sentence_of(const CLI::App &program, const CLI::ParseError &error)
{
  std::string command = "pelvireg";
  for (const CLI::App *used : program.get_subcommands())
    command += " " + used->get_name();
  std::string message = error.what();
  for (char &character : message)
    if (character == '\n')
      character = ' ';
  return fmt::format("{}; see '{} --help'", message, command);
}

int run(int argc, char **argv)
{
  pelvireg::cli::Invocation invocation{.command_line = joined(argc, argv), .action = {}};
  CLI::App program(
      "Reference-validation harness: how far can a registration driven by one image plane be trusted in 3D?");
  describe(program, invocation);
  try
  {
    program.parse(argc, argv);
  }
  catch (const CLI::Success &request) // --help, --version
  {
    return program.exit(request);
  }
  catch (const CLI::ParseError &error)
  {
    return fail(sentence_of(program, error), exit_bad_input);
  }
  if (!invocation.action)
    return fail("a command is required, for example 'run'; see 'pelvireg --help'", exit_bad_input);
  pelvireg::cli::ensure_single_threaded_libraries(argv);
  invocation.action();
  return invocation.status;
}
} // namespace

int main(int argc, char **argv)
{
  try
  {
    return run(argc, argv);
  }
  catch (const pelvireg::InputError &error)
  {
    return fail(error.what(), exit_bad_input);
  }
  catch (const std::exception &error) // ComputationError, a full disk, no memory
  {
    return fail(error.what(), exit_computation_failed);
  }
}
