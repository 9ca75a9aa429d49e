#include "synthetic/anatomy/case.h"
#include "synthetic/dataset/error.h"
#include "validation/cli/commands.h"
#include "validation/cli/studies.h"
#include "validation/cli/study_field.h"

#include <fmt/format.h>

#include <optional>
#include <utility>

namespace pelvireg::cli
{
namespace
{
using dataset::organ_names;

const std::vector<std::string> hollow_organs = {"bladder", "vagina", "rectum"};

/// None when the reference does not reach the end: a wall without fluid may have no way there. The reason is printed.
std::optional<dataset::Truth> solve_with(const StudySettings &settings, const std::string &name,
                                         const std::string &cavity)
{
  const std::string label = case_label(settings.case_name);
  std::string text = anatomy::case_text(settings.case_name);
  for (const std::string &organ : hollow_organs)
    text = anatomy::with_value(text, label, "cavity." + organ, cavity);
  fmt::print("cavities {}\n", name);
  ResultDirectory directory(settings.folder / name, settings.command_line, ResultDirectory::Missing::create);
  make_anatomy(directory, label, text);
  try
  {
    make_truth(directory, settings.jobs);
  }
  catch (const ComputationError &error)
  {
    fmt::print("cavities {}: {}\n", name, error.what());
    return {};
  }
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
  const std::optional<dataset::Truth> closed = solve_with(settings, "closed", "{mode = 'closed'}");
  if (!closed)
    throw ComputationError("the case does not converge with closed cavities, so there is nothing to compare with");
  const std::vector<std::pair<std::string, std::optional<dataset::Truth>>> others = {
      {"leaking", solve_with(settings, "leaking", fmt::format("{{mode = 'leak', rate = {:.6f}}}", leak_rate))},
      {"open", solve_with(settings, "open", "{mode = 'open'}")}};
  const StudyPoints points = study_points({*closed}, 0);
  const StudyField field(*closed, points);

  fmt::print("\nat the last increment, which all reach with the same mean vaginal displacement\n");
  print_volumes("closed", *closed);
  for (const auto &[name, truth] : others)
    if (truth)
      print_volumes(name, *truth);
  fmt::print("\ndisplacement against closed cavities, mean / largest over the outer surface, mm\n{:<10}", "");
  for (const std::string &organ : organ_names)
    fmt::print("{:>18}", organ);
  for (const auto &[name, truth] : others)
  {
    fmt::print("\n{:<10}", name);
    for (std::size_t organ = 0; organ < organ_names.size(); ++organ)
      fmt::print("{:>18}", truth ? difference(StudyField(*truth, points), field, organ, closed->increments.size() - 1)
                                 : "not reached");
  }
  fmt::print("\n");
}
} // namespace pelvireg::cli
