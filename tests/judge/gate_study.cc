// Detection and false alarms of the regression gate on real runs: docs/verification.md, "Power of the
// regression gate".
//   gate_study DIR [DIR_OF_ANOTHER_PROCESSOR] — result directories with many randomised runs (200)
#include "synthetic/dataset/error.h"
#include "synthetic/dataset/geometry.h"
#include "tests/judge/faults.h"
#include "validation/cli/sha256.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <numeric>
#include <string>
#include <vector>

namespace pelvireg::test
{
namespace
{
using regression::Comparison;
using regression::Verdict;

/// A permutation of 1 … n that depends on the trial alone.
std::vector<int> shuffled(int n, int trial)
{
  std::vector<int> order(static_cast<std::size_t>(n));
  std::iota(order.begin(), order.end(), 1);
  std::uint64_t state = 0x853C49E6748FEA9Bu + static_cast<std::uint64_t>(trial) * 0x9E3779B97F4A7C15u;
  for (std::size_t i = order.size() - 1; i > 0; --i)
  {
    state = state * 6364136223846793005u + 1442695040888963407u;
    std::swap(order[i], order[(state >> 33) % (i + 1)]);
  }
  return order;
}

struct Counts
{
  int trials = 0, pass = 0, worse = 0, unclear = 0;

  void add(const Comparison &comparison)
  {
    ++trials;
    const int status = comparison.exit_status();
    pass += status == 0;
    worse += status == 1;
    unclear += status == 2;
  }
};

using Fault = std::function<ErrorResult(const ErrorResult &, int trial)>;

struct NamedFault
{
  std::string name;
  Fault apply;
};

/// One registered family a trial, in turn.
FamilyName family_of_trial(const ErrorResult &result, int trial)
{
  const std::vector<FamilyName> names = registered_families(result);
  return names[static_cast<std::size_t>(trial) % names.size()];
}

/// A bump somewhere on the curve of a family, both in turn.
ErrorResult bumped(const ErrorResult &result, int trial, double factor)
{
  const FamilyName name = family_of_trial(result, trial);
  const std::size_t n = result.curves.at(name).at(0).size(), length = std::max<std::size_t>(1, n / 10);
  const std::size_t place = static_cast<std::size_t>(trial / 16) * 7 % (n - length + 1);
  return with_bump(result, name, place, factor);
}

std::vector<NamedFault> faults()
{
  const auto one_family = [](double factor)
  {
    return [factor](const ErrorResult &result, int trial)
    {
      const FamilyName name = family_of_trial(result, trial);
      return scaled(result, factor, [&](const FamilyName &other) { return other == name; });
    };
  };
  return {{"none", [](const ErrorResult &result, int) { return result; }},
          {"+2 %, one family", one_family(1.02)},
          {"+5 %, one family", one_family(1.05)},
          {"+5 %, all", [](const ErrorResult &result, int) { return scaled(result, 1.05); }},
          {"+10 %, one family", one_family(1.10)},
          {"bump +20 % on a tenth", [](const ErrorResult &result, int trial) { return bumped(result, trial, 1.2); }},
          {"tail +10 %, one family", [](const ErrorResult &result, int trial)
           { return with_longer_tail(result, family_of_trial(result, trial), 1.1); }},
          {"not-a-number, one value", [](const ErrorResult &result, int trial)
           { return with_nan(result, family_of_trial(result, trial), static_cast<std::size_t>(trial / 16)); }},
          {"an organ dropped", [](const ErrorResult &result, int trial)
           { return without_organ(result, dataset::organ_names[static_cast<std::size_t>(trial) % 4]); }},
          {"an organ one step early", [](const ErrorResult &result, int trial)
           { return shifted_by_one_step(result, dataset::organ_names[static_cast<std::size_t>(trial) % 4], true); }},
          {"an organ one step late", [](const ErrorResult &result, int trial)
           { return shifted_by_one_step(result, dataset::organ_names[static_cast<std::size_t>(trial) % 4], false); }}};
}

/// The two sides of a trial before the fault.
using Sides = std::function<std::pair<ErrorResult, ErrorResult>(int trial)>;

void print_table(const std::string &title, int n_trials, const Sides &sides)
{
  fmt::print("\n{}\n{:<26}{:>8}{:>10}{:>10}{:>14}\n", title, "fault", "trials", "not worse", "worse", "cannot tell");
  for (const NamedFault &fault : faults())
  {
    Counts counts;
    for (int trial = 0; trial < n_trials; ++trial)
    {
      const auto [baseline, current] = sides(trial);
      counts.add(gate(baseline, fault.apply(current, trial)));
    }
    fmt::print("{:<26}{:>8}{:>10.4f}{:>10.4f}{:>14.4f}\n", fault.name, counts.trials,
               static_cast<double>(counts.pass) / counts.trials, static_cast<double>(counts.worse) / counts.trials,
               static_cast<double>(counts.unclear) / counts.trials);
    std::fflush(stdout);
  }
}

int n_samples(const ErrorResult &result)
{
  return static_cast<int>(result.curves.at(registered_families(result).front()).size()) - 1;
}

void study(const ErrorResult &runs, const ErrorResult *other_processor)
{
  const int n_all = n_samples(runs), n_both = other_processor ? std::min(n_all, n_samples(*other_processor)) : 0;
  constexpr int many = 1000, some = 400;
  const auto eight_of = [](int n, int trial)
  {
    const std::vector<int> order = shuffled(n, trial);
    return std::vector<int>(order.begin(), order.begin() + 8);
  };
  if (other_processor)
    print_table("8 paired runs, CURRENT from another processor", many,
                [&](int trial)
                {
                  const std::vector<int> chosen = eight_of(n_both, trial);
                  return std::pair(resampled(runs, chosen), resampled(*other_processor, chosen));
                });
  for (const int n : {8, 16})
    print_table(fmt::format("{} runs, not paired: other moduli on each side", n), n == 8 ? many : some,
                [&](int trial)
                {
                  const std::vector<int> order = shuffled(n_all, trial);
                  return std::pair(resampled(runs, {order.begin(), order.begin() + n}),
                                   resampled(runs, {order.begin() + n, order.begin() + 2 * n}));
                });
  for (const double sd : {0.01, 0.03})
    print_table(fmt::format("8 paired runs, artificial noise of {} on every curve and value of CURRENT", sd), some,
                [&](int trial)
                {
                  const ErrorResult chosen = resampled(runs, eight_of(n_all, trial));
                  return std::pair(chosen, with_noise(chosen, sd, static_cast<std::uint64_t>(trial) + 1));
                });
}
} // namespace
} // namespace pelvireg::test

int main(int argc, char **argv)
{
  if (argc < 2 || argc > 3)
  {
    fmt::print(stderr, "usage: gate_study DIR [DIR_OF_ANOTHER_PROCESSOR]\n");
    return 2;
  }
  try
  {
    const auto read = [](const char *directory)
    { return pelvireg::regression::load_result(directory, pelvireg::cli::sha256_of_text); };
    const auto runs = read(argv[1]);
    if (argc == 3)
    {
      const auto other = read(argv[2]);
      pelvireg::test::study(runs, &other);
    }
    else
      pelvireg::test::study(runs, nullptr);
  }
  catch (const pelvireg::InputError &error)
  {
    fmt::print(stderr, "gate_study: {}\n", error.what());
    return 2;
  }
}
