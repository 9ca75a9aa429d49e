#include "registration/registration.h"

#include <cmath>

namespace pelvireg::registration
{
namespace
{
/// A finer raster than any mesh needs, still within memory.
constexpr double least_pixel = 0.05;
} // namespace

std::vector<std::string> Options::violations() const
{
  std::vector<std::string> problems;
  const auto demand = [&](bool holds, const std::string &name, double got, const std::string &allowed)
  {
    if (!holds)
      problems.push_back("registration option " + name + " is " + std::to_string(got) + ", must be " + allowed);
  };
  const auto is_compliance = [](double c) { return c >= 0 && std::isfinite(c); };
  demand(time_step > 0 && std::isfinite(time_step), "time_step", time_step, "positive and finite (s)");
  demand(max_match_distance > 0 && std::isfinite(max_match_distance), "max_match_distance", max_match_distance,
         "positive and finite (mm)");
  demand(min_normal_agreement >= -1 && min_normal_agreement <= 1, "min_normal_agreement", min_normal_agreement,
         "a cosine in [-1, 1]");
  demand(is_compliance(sliding_compliance), "sliding_compliance", sliding_compliance, "finite and not negative (mm/N)");
  demand(is_compliance(attachment_compliance), "attachment_compliance", attachment_compliance,
         "finite and not negative (mm/N)");
  demand(friction_coefficient >= 0 && std::isfinite(friction_coefficient), "friction_coefficient", friction_coefficient,
         "finite and not negative");
  demand(contact_pixel >= least_pixel && std::isfinite(contact_pixel), "contact_pixel", contact_pixel,
         "finite and at least 0.05 (mm)");
  demand(contact_cell >= contact_pixel && std::isfinite(contact_cell), "contact_cell", contact_cell,
         "finite and at least contact_pixel (mm)");
  demand(contact_margin > 0 && std::isfinite(contact_margin), "contact_margin", contact_margin,
         "positive and finite (mm)");
  demand(is_compliance(contact_compliance), "contact_compliance", contact_compliance, "finite and not negative (mm/N)");
  demand(max_recovery > 0 && std::isfinite(max_recovery), "max_recovery", max_recovery, "positive and finite (mm)");
  demand(max_sweeps >= 1, "max_sweeps", max_sweeps, "at least 1");
  demand(tolerance_mm > 0 && std::isfinite(tolerance_mm), "tolerance_mm", tolerance_mm, "positive and finite (mm)");
  demand(tolerance_newton > 0 && std::isfinite(tolerance_newton), "tolerance_newton", tolerance_newton,
         "positive and finite (N)");
  demand(n_threads >= 1, "n_threads", n_threads, "at least 1");
  demand(reserved_control_points >= 0, "reserved_control_points", reserved_control_points, "at least 0");
  demand(reserved_contacts >= 0, "reserved_contacts", reserved_contacts, "at least 0");
  return problems;
}

std::string to_string(StepStatus status)
{
  switch (status)
  {
  case StepStatus::ok:
    return "The step succeeded.";
  case StepStatus::no_control_points:
    return "No control point was offered or accepted, so nothing drives the step; positions are unchanged.";
  case StepStatus::not_finite:
    return "The observation or the solution is not finite; positions are unchanged.";
  case StepStatus::diverged:
    return "The solution throws a node out of the neighbourhood of the model; positions are unchanged.";
  case StepStatus::factorisation_failed:
    return "A matrix of the step is not positive definite; positions are unchanged.";
  case StepStatus::invalid_observation:
    return "The observation names a body that cannot be matched, has unequal numbers of points and normals, or its "
           "plane normal is not unit; positions are unchanged.";
  }
  return "unknown status";
}
} // namespace pelvireg::registration
