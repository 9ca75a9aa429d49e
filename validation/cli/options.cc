#include "validation/cli/commands.h"
#include "validation/runner/conditions.h"
#include "validation/runner/perturbation.h"

#include <algorithm>
#include <filesystem>
#include <thread>

namespace pelvireg::cli
{
std::string case_label(const std::string &name_or_path)
{
  return std::filesystem::path(name_or_path).stem().string();
}

void add_jobs_option(CLI::App &command, int &jobs)
{
  jobs = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  command.add_option("--jobs,--threads", jobs, "Threads; results are the same bytes for every number")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
}

void add_sample_options(CLI::App &command, SampleSettings &settings)
{
  command.add_option("--samples", settings.samples, "Randomised runs beside the nominal one")
      ->check(CLI::Range(0, 9999))
      ->capture_default_str();
  command.add_option("--seed", settings.seed, "Seed of the randomised runs")->capture_default_str();
  command
      .add_option("--perturb", settings.kinds,
                  "What the randomised runs are given wrong, one at a time: modulus, surface, outline, plane")
      ->delimiter(',')
      ->check(CLI::IsMember(runner::perturbation_kinds()))
      ->capture_default_str();
  command.add_option("--spread", settings.spread, "modulus: Young's moduli times 1 + spread * U(-1, 1); 0.10");
  command.add_option("--surface-sd", settings.surface_sd, "surface: noise of the rest surfaces, mm; 1.0");
  command.add_option("--correlation-length", settings.correlation_length, "surface: of that noise, mm; 10");
  command.add_option("--outline-sd", settings.outline_sd, "outline: noise of the points along each axis, mm; 1.0");
  command.add_option("--plane-offset-sd", settings.plane_offset_sd, "plane: of the offset along its normal, mm; 2.0");
  command.add_option("--plane-tilt-sd", settings.plane_tilt_sd_degrees,
                     "plane: of the tilt about each of two axes in it, degrees; 2.0");
}

void add_condition_option(CLI::App &command, std::vector<std::string> &conditions)
{
  std::vector<std::string> known = runner::condition_names();
  known.push_back("all");
  command
      .add_option("--condition,--conditions", conditions,
                  "Which constraints hold; several with commas, or all; full and no_boundary_conditions when not given")
      ->delimiter(',')
      ->check(CLI::IsMember(known));
}

std::vector<std::string> expanded_conditions(const std::vector<std::string> &given)
{
  if (std::find(given.begin(), given.end(), "all") != given.end())
    return runner::condition_names();
  std::vector<std::string> once;
  for (const std::string &condition : given)
    if (std::find(once.begin(), once.end(), condition) == once.end())
      once.push_back(condition);
  return once;
}
} // namespace pelvireg::cli
