#include "synthetic/anatomy/case.h"
#include "validation/cli/commands.h"
#include "validation/cli/stages.h"
#include "validation/runner/node_table.h"

#include <fmt/format.h>

#include <memory>

namespace pelvireg::cli
{
void add_case_commands(CLI::App &program, Invocation &invocation)
{
  CLI::App *cases = program.add_subcommand("cases", "List the built-in cases");
  cases->callback(
      [&invocation]
      {
        invocation.action = []
        {
          for (const anatomy::CaseSummary &summary : anatomy::built_in_cases())
            fmt::print("{:<12} {}\n", summary.name, summary.description);
        };
      });

  struct Arguments
  {
    std::string case_name, out;
  };
  const auto arguments = std::make_shared<Arguments>();
  CLI::App *anatomy = program.add_subcommand("anatomy", "Build the pelvis of a case: case.toml, anatomy.h5");
  anatomy->add_option("CASE", arguments->case_name, "Built-in name (see 'pelvireg cases') or path to a .toml file")
      ->required();
  anatomy->add_option("--out", arguments->out, "Result directory, made when missing")->required();
  anatomy->footer("Examples:\n  pelvireg anatomy t005 --out out/t005\n  pelvireg anatomy my_case.toml --out out/mine");
  anatomy->callback(
      [&invocation, arguments]
      {
        invocation.action = [&invocation, arguments]
        {
          const std::string text = anatomy::case_text(arguments->case_name);
          ResultDirectory directory(arguments->out, invocation.command_line, ResultDirectory::Missing::create);
          make_anatomy(directory, case_label(arguments->case_name), text);
          const dataset::Anatomy made = dataset::load_anatomy(directory.path() / "anatomy.h5");
          fmt::print("\n{}", runner::node_table(runner::body_sizes(made.registration)));
        };
      });
}
} // namespace pelvireg::cli
