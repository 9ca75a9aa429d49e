#include "synthetic/dataset/atomic_file.h"
#include "validation/cli/commands.h"
#include "validation/cli/sha256.h"
#include "validation/regression/compare.h"
#include "validation/regression/comparison_page.h"
#include "validation/regression/comparison_text.h"

#include <fmt/format.h>

#include <memory>

namespace pelvireg::cli
{
namespace
{
struct Arguments
{
  std::string baseline, current;
  std::string markdown, junit, json, html; ///< files to write
  bool fail_on_change = false;
};

void write_if_asked(const std::string &file, const std::string &text)
{
  if (!file.empty())
    dataset::write_text_file(file, text);
}

int compare_results(const Arguments &given)
{
  const regression::Baseline baseline =
      regression::load_baseline(given.baseline, sha256_of_text); // MISSING comes first
  const regression::Comparison comparison =
      regression::compare(baseline, regression::load_result(given.current, sha256_of_text));
  write_if_asked(given.markdown, comparison_markdown(comparison));
  write_if_asked(given.junit, comparison_junit(comparison));
  write_if_asked(given.json, comparison_json(comparison));
  write_if_asked(given.html, comparison_page(comparison));
  fmt::print("{}", comparison_table(comparison));
  const int status = comparison.exit_status();
  const bool has_changed = comparison.verdict() != regression::Verdict::pass;
  return status == 0 && given.fail_on_change && has_changed ? 1 : status;
}
} // namespace

void add_compare_command(CLI::App &program, Invocation &invocation)
{
  const auto arguments = std::make_shared<Arguments>();
  CLI::App *command = program.add_subcommand(
      "compare", "The regression gate: have the error curves become worse? Exit 0 no, 1 yes, 2 cannot be told");
  command->add_option("BASELINE", arguments->baseline, "Baseline folder, or an evaluated result directory")->required();
  command->add_option("CURRENT", arguments->current, "Evaluated result directory")->required();
  command->add_option("--markdown", arguments->markdown, "Write a summary for a CI's page");
  command->add_option("--junit", arguments->junit, "Write a JUnit XML file, one test case a curve family");
  command->add_option("--json", arguments->json, "Write every figure");
  command->add_option("--html", arguments->html, "Write a page with both curves and bands of every family");
  command->add_flag("--fail-on-change", arguments->fail_on_change,
                    "Exit 1 for CHANGED and IMPROVED too: any other numbers than another processor's round-off gives");
  command->footer("Examples:\n  pelvireg compare validation/regression/baselines/quick out/quick\n"
                  "  pelvireg compare out/before out/after --html compare.html\n"
                  "  pelvireg compare baselines/t005 out/t005 --junit junit.xml --markdown summary.md\n"
                  "Verdicts: PASS, CHANGED, IMPROVED (exit 0), WORSE (1), INCOMPARABLE, MISSING (2).");
  command->callback(
      [&invocation, arguments]
      { invocation.action = [&invocation, arguments] { invocation.status = compare_results(*arguments); }; });
}
} // namespace pelvireg::cli
