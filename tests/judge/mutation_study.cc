// What the regression gate says of faults built into the registration: docs/verification.md, "Power of the
// regression gate".
//   mutation_study DIR [SAMPLES] — an evaluated result directory
#include "synthetic/dataset/error.h"
#include "synthetic/dataset/geometry.h"
#include "tests/judge/faults.h"
#include "tests/judge/mutated_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>

namespace pelvireg::test
{
namespace
{
void print_line(const std::string &name, const regression::Comparison &comparison)
{
  int n_worse = 0, n_changed = 0, n_up = 0, n_down = 0;
  double largest = 0, smallest = 0, largest_change = 0;
  std::string worst;
  for (const regression::FamilyComparison &family : comparison.families)
  {
    n_worse += family.verdict == regression::Verdict::worse;
    n_changed += family.verdict != regression::Verdict::pass;
    largest_change = std::max(largest_change, family.largest_change);
    if (!family.average)
      continue;
    n_up += family.average->lower > 0;
    n_down += family.average->upper < 0;
    if (family.average->mean > largest)
      worst = family.name.condition + ", " + family.name.organ + ", by " + to_string(family.name.axis);
    largest = std::max(largest, family.average->mean);
    smallest = std::min(smallest, family.average->mean);
  }
  fmt::print("{:<34} exit {}  worse {:>2}  not PASS {:>2}  E {:+.2f} % ({}) to {:+.2f} %, proven up {:>2}, down {:>2}, "
             "any number {:.2g} %\n",
             name, comparison.exit_status(), n_worse, n_changed, 100 * std::expm1(largest), worst,
             100 * std::expm1(smallest), n_up, n_down, 100 * largest_change);
  std::fflush(stdout);
}

void study(const char *directory, int n_samples)
{
  const MutatedRun run(directory);
  const ErrorResult sound = run.play({}, n_samples);
  const auto say = [&](const std::string &name, const registration::Mutation &mutation)
  { print_line(name, gate(sound, run.play(mutation, n_samples))); };
  say("none", {});
  say("normals not projected", {.unprojected_normals = true});
  say("stale rotations", {.stale_rotations = true});
  const dataset::RegistrationModel &model = run.anatomy().registration;
  for (std::size_t k = 0; k < model.attachments.size(); ++k)
    say("without attachment " + model.attachments[k].name, {.dropped_attachment = static_cast<int>(k)});
  for (std::size_t body = 0; body < model.bodies.size(); ++body)
    for (const double factor : {0.97, 1.03, 2.0})
      if (std::count(dataset::organ_names.begin(), dataset::organ_names.end(), model.bodies[body].name))
        say(fmt::format("modulus of the {} {:+.0f} %", model.bodies[body].name, 100 * (factor - 1)),
            {.wrong_body = static_cast<int>(body), .wrong_factor = factor});
}
} // namespace
} // namespace pelvireg::test

int main(int argc, char **argv)
{
  const int n_samples = argc == 3 ? std::atoi(argv[2]) : 8;
  if (argc < 2 || argc > 3 || n_samples < 2)
  {
    fmt::print(stderr, "usage: mutation_study DIR [SAMPLES]\n");
    return 2;
  }
  try
  {
    pelvireg::test::study(argv[1], n_samples);
  }
  catch (const pelvireg::InputError &error)
  {
    fmt::print(stderr, "mutation_study: {}\n", error.what());
    return 2;
  }
}
