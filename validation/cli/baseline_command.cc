#include "synthetic/dataset/atomic_file.h"
#include "validation/cli/commands.h"
#include "validation/cli/sha256.h"
#include "validation/regression/baseline.h"
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
  std::string result, folder, reason;
  bool renew_anchor = false;
};

/// The widest vector instructions that the registration's kernels can use here.
std::string instruction_set()
{
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq"))
    return "x86-64 with AVX-512";
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
    return "x86-64 with AVX2";
  return "x86-64";
#else
  return "not x86-64";
#endif
}

void propose(const Arguments &given)
{
  const std::filesystem::path folder = given.folder;
  regression::propose_baseline(given.result, folder, {PELVIREG_PACKAGES, instruction_set()}, sha256_of_text);
  if (regression::is_baseline(folder))
  {
    const regression::Comparison comparison = regression::compare(
        regression::load_baseline(folder, sha256_of_text), regression::load_result(given.result, sha256_of_text));
    dataset::write_text_file(folder / "candidate" / "comparison.html", comparison_page(comparison));
    fmt::print("{}\nboth curves: {}\n", comparison_table(comparison),
               (folder / "candidate" / "comparison.html").string());
  }
  fmt::print("candidate: {}\naccept it: pelvireg baseline accept {} --reason \"...\"\n",
             (folder / "candidate").string(), folder.string());
}

void add_propose(CLI::App &group, Invocation &invocation)
{
  const auto arguments = std::make_shared<Arguments>();
  CLI::App *command = group.add_subcommand("propose", "Lay a result beside a baseline and show the difference");
  command->add_option("DIR", arguments->result, "Evaluated result directory")->required();
  command->add_option("--baseline", arguments->folder, "Baseline folder, made when missing")->required();
  command->footer("Example:\n  pelvireg baseline propose out/quick --baseline validation/regression/baselines/quick");
  command->callback([&invocation, arguments] { invocation.action = [arguments] { propose(*arguments); }; });
}

void add_accept(CLI::App &group, Invocation &invocation)
{
  const auto arguments = std::make_shared<Arguments>();
  CLI::App *command = group.add_subcommand("accept", "Make the candidate the baseline");
  command->add_option("BASELINE", arguments->folder, "Baseline folder with a candidate")->required();
  command->add_option("--reason", arguments->reason, "Why the curves may change: kept with the baseline")->required();
  command->add_flag("--anchor", arguments->renew_anchor,
                    "Freeze the candidate as the anchor too: at a release, or when a loss against the anchor is meant");
  command->footer("Example:\n  pelvireg baseline accept validation/regression/baselines/quick --reason \"friction of "
                  "0.05 instead of 0.1\"");
  command->callback(
      [&invocation, arguments]
      {
        invocation.action = [arguments]
        {
          regression::accept_baseline(arguments->folder, arguments->reason, arguments->renew_anchor, sha256_of_text);
          fmt::print("baseline: {}\n", arguments->folder);
        };
      });
}
} // namespace

void add_baseline_command(CLI::App &program, Invocation &invocation)
{
  CLI::App *group = program.add_subcommand("baseline", "Propose and accept what 'compare' holds results against");
  group->footer("Example:\n  pelvireg baseline propose out/quick --baseline validation/regression/baselines/quick");
  group->require_subcommand(1);
  add_propose(*group, invocation);
  add_accept(*group, invocation);
}
} // namespace pelvireg::cli
