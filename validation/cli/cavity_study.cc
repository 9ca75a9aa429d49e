#include "synthetic/anatomy/case.h"
#include "validation/cli/commands.h"
#include "validation/cli/studies.h"
#include "validation/cli/study_field.h"

#include <fmt/format.h>

#include <algorithm>

namespace pelvireg::cli
{
namespace
{
using dataset::organ_names;

const std::vector<std::string> hollow_organs = {"bladder", "vagina", "rectum"};

dataset::Truth solve_with(const StudySettings &settings, const std::string &name, const std::string &cavity)
{
  const std::string label = case_label(settings.case_name);
  std::string text = anatomy::case_text(settings.case_name);
  for (const std::string &organ : hollow_organs)
    text = anatomy::with_value(text, label, "cavity." + organ, cavity);
  fmt::print("cavities {}\n", name);
  ResultDirectory directory(settings.folder / name, settings.command_line, ResultDirectory::Missing::create);
  make_anatomy(directory, label, text);
  make_truth(directory, settings.jobs);
  return dataset::load_truth(directory.path() / "truth.h5");
}

/// Length of the displacement differences over one organ's points at the last increment: mean and largest, mm.
std::string difference(const StudyField &one, const StudyField &other, std::size_t organ, std::size_t increment)
{
  const Eigen::VectorXd length =
      (one.displacements(organ, increment) - other.displacements(organ, increment)).rowwise().norm();
  return fmt::format("{:.3f} / {:.3f}", length.mean(), length.maxCoeff());
}

void print_volumes(const std::string &name, const dataset::Truth &truth)
{
  const dataset::IncrementRecord &last = truth.increments.back();
  fmt::print("{:<10} abdominal pressure {:.3f} kPa", name, 1e3 * last.pressure);
  for (std::size_t c = 0; c < truth.cavity_names.size(); ++c)
  {
    const auto i = static_cast<Eigen::Index>(c);
    fmt::print("; {} {:.2f} kPa, volume {:+.2f} %", truth.cavity_names[c], 1e3 * last.cavity_pressures[i],
               100 * (last.cavity_volumes[i] / truth.cavity_rest_volumes[i] - 1));
  }
  fmt::print("\n");
}
} // namespace

void run_cavity_study(const StudySettings &settings, double leak_rate)
{
  const std::vector<std::string> names = {"closed", "leaking", "open"};
  const std::vector<dataset::Truth> truths = {
      solve_with(settings, "closed", "{mode = 'closed'}"),
      solve_with(settings, "leaking", fmt::format("{{mode = 'leak', rate = {:.6f}}}", leak_rate)),
      solve_with(settings, "open", "{mode = 'open'}")};
  const StudyPoints points = study_points({truths[0]}, 0);
  std::vector<StudyField> fields;
  for (const dataset::Truth &truth : truths)
    fields.emplace_back(truth, points);

  fmt::print("\nat the last increment, which every one reaches with the same mean vaginal displacement\n");
  for (std::size_t i = 0; i < names.size(); ++i)
    print_volumes(names[i], truths[i]);
  fmt::print("\ndisplacement against closed cavities, mean / largest over the outer surface, mm\n{:<10}", "");
  for (const std::string &organ : organ_names)
    fmt::print("{:>18}", organ);
  for (std::size_t i = 1; i < names.size(); ++i)
  {
    fmt::print("\n{:<10}", names[i]);
    for (std::size_t organ = 0; organ < organ_names.size(); ++organ)
      fmt::print("{:>18}", difference(fields[i], fields[0], organ, truths[0].increments.size() - 1));
  }
  fmt::print("\n");
}
} // namespace pelvireg::cli
