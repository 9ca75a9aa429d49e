#include "synthetic/dataset/error.h"
#include "validation/cli/commands.h"
#include "validation/cli/register_stage.h"

#include <fmt/format.h>

#include <charconv>
#include <memory>

namespace pelvireg::cli
{
namespace
{
constexpr int most_shards = 500; // merge has all of them open at once

struct Arguments
{
  std::string directory;
  std::vector<std::string> conditions = runner::default_conditions();
  SampleSettings settings;
  std::string shard;
  std::string outlines = "exact";
  int jobs = 1;
};

/// "2/4" as shard 2 of 4.
runner::Shard shard_of(const std::string &text)
{
  runner::Shard shard;
  const char *const end = text.data() + text.size();
  const auto index = std::from_chars(text.data(), end, shard.index);
  const bool has_slash = index.ec == std::errc() && index.ptr != end && *index.ptr == '/';
  const auto n = has_slash ? std::from_chars(index.ptr + 1, end, shard.n) : index;
  if (!has_slash || n.ec != std::errc() || n.ptr != end || shard.index < 1 || shard.index > shard.n ||
      shard.n > most_shards)
    throw InputError(fmt::format("--shard: got '{}', must be i/n with whole numbers 1 <= i <= n <= {}, for example 2/4",
                                 text, most_shards));
  return shard;
}

std::vector<RegisterRequest> requests_of(const Arguments &given)
{
  const std::vector<std::string> conditions = expanded_conditions(given.conditions);
  if (given.outlines == "exact")
    return requests_of(conditions, given.settings);
  if (given.settings.samples > 0 || !given.shard.empty())
    throw InputError("--outlines images plays the nominal run alone; leave --samples and --shard out");
  return tracked_requests_of(conditions);
}

void run_register(const Arguments &given, const std::string &command_line)
{
  const std::vector<RegisterRequest> requests = requests_of(given);
  if (given.shard.empty())
  {
    ResultDirectory directory(given.directory, command_line, ResultDirectory::Missing::refuse);
    for (const RegisterRequest &request : requests)
      make_estimate(directory, request, given.jobs);
    return;
  }
  const runner::Shard shard = shard_of(given.shard);
  ResultDirectory directory(given.directory, command_line, ResultDirectory::Missing::refuse,
                            ResultDirectory::Access::shared);
  for (const RegisterRequest &request : requests)
    make_shard(directory, request, shard, given.jobs);
}

void add_register(CLI::App &program, Invocation &invocation)
{
  const auto arguments = std::make_shared<Arguments>();
  CLI::App *command = program.add_subcommand("register", "Play the outlines to the registration: estimate-LABEL.h5");
  command->add_option("DIR", arguments->directory, "Result directory")->required();
  add_condition_option(*command, arguments->conditions);
  add_sample_options(*command, arguments->settings);
  command->add_option("--shard", arguments->shard,
                      "Play share i of n of the runs (i/n): shard-LABEL-i-of-n.h5 for 'pelvireg merge'");
  command
      ->add_option("--outlines", arguments->outlines,
                   "exact: intersections with the truth (observations.h5); images: tracked in images (tracked.h5, see "
                   "'pelvireg track'), for estimate-CONDITION_images.h5")
      ->check(CLI::IsMember({"exact", "images"}))
      ->capture_default_str();
  add_jobs_option(*command, arguments->jobs);
  command->footer("Examples:\n  pelvireg register out/t005\n  pelvireg register out/t005 --condition all\n"
                  "  pelvireg register out/t005 --samples 100 --spread 0.10 --seed 1 --jobs 2\n"
                  "  pelvireg register out/t005 --samples 100 --perturb outline --outline-sd 1.0\n"
                  "  pelvireg register out/t005 --samples 100 --shard 2/4\n"
                  "What is perturbed is part of the file's name: estimate-full.h5 (moduli), estimate-full_outline.h5.\n"
                  "A register that was killed goes on where it was.");
  command->callback(
      [&invocation, arguments]
      { invocation.action = [&invocation, arguments] { run_register(*arguments, invocation.command_line); }; });
}

void add_merge(CLI::App &program, Invocation &invocation)
{
  struct MergeArguments
  {
    std::string directory;
    std::vector<std::filesystem::path> shards;
  };
  const auto arguments = std::make_shared<MergeArguments>();
  CLI::App *command =
      program.add_subcommand("merge", "Put the shards of register together: the estimate-LABEL.h5 of one register");
  command->add_option("DIR", arguments->directory, "Result directory")->required();
  command->add_option("SHARD", arguments->shards, "Shard files, in any order; those in DIR when none is given");
  command->footer("Examples:\n  pelvireg merge out/t005\n  pelvireg merge out/t005 node1/shard-full-*.h5 "
                  "node2/shard-full-*.h5");
  command->callback(
      [&invocation, arguments]
      {
        invocation.action = [&invocation, arguments]
        {
          ResultDirectory directory(arguments->directory, invocation.command_line, ResultDirectory::Missing::refuse);
          merge_estimates(directory, arguments->shards);
        };
      });
}
} // namespace

void add_register_commands(CLI::App &program, Invocation &invocation)
{
  add_register(program, invocation);
  add_merge(program, invocation);
}
} // namespace pelvireg::cli
