#include "validation/cli/commands.h"

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
  command.add_option("--spread", settings.spread, "Young's moduli are multiplied by 1 + spread * U(-1, 1)")
      ->check(CLI::Range(0.0, 0.99))
      ->capture_default_str();
  command.add_option("--seed", settings.seed, "Seed of the randomised runs")->capture_default_str();
}
} // namespace pelvireg::cli
