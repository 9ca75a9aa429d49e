#include "validation/runner/conditions.h"

#include "synthetic/dataset/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace pelvireg::runner
{
namespace
{
/// What an ablation of attachments takes away.
struct Ablation
{
  std::string kind;  ///< of the attachments
  std::string organ; ///< that they hold; empty: any
};

const std::map<std::string, Ablation> &ablations()
{
  static const std::map<std::string, Ablation> known = {
      {"no_ligaments", {"ligament", ""}}, {"no_fascia", {"fascia", ""}}, {"no_uterus_attachment", {"organ", "uterus"}}};
  return known;
}

bool is_taken_away(const dataset::RegistrationAttachment &attachment, const Ablation &ablation)
{
  return attachment.kind == ablation.kind &&
         (ablation.organ.empty() || attachment.body_a == ablation.organ || attachment.body_b == ablation.organ);
}

bool holds_nothing(const dataset::RegistrationBody &body, const dataset::RegistrationModel &model)
{
  return body.outer_triangles.rows() == 0 &&
         std::none_of(model.attachments.begin(), model.attachments.end(),
                      [&](const dataset::RegistrationAttachment &attachment)
                      { return attachment.body_a == body.name || attachment.body_b == body.name; });
}
} // namespace

std::vector<std::string> condition_names()
{
  return {"full",      "no_boundary_conditions", "no_contact", "no_friction", "no_ligaments",
          "no_fascia", "no_uterus_attachment"};
}

std::vector<std::string> default_conditions()
{
  return {"full", "no_boundary_conditions"};
}

registration::Options options_of(const std::string &condition, const dataset::Anatomy &anatomy)
{
  registration::Options options;
  options.time_step = anatomy.registration_time_step;
  options.friction_coefficient = anatomy.registration_friction;
  options.use_attachments = condition != "no_boundary_conditions";
  options.use_contact = condition != "no_boundary_conditions" && condition != "no_contact";
  if (condition == "no_friction")
    options.friction_coefficient = 0;
  return options;
}

dataset::RegistrationModel model_of(const std::string &condition, const dataset::RegistrationModel &model)
{
  dataset::RegistrationModel reduced = model;
  const auto ablation = ablations().find(condition);
  if (ablation == ablations().end())
    return reduced;
  const auto n_taken = std::erase_if(reduced.attachments, [&](const dataset::RegistrationAttachment &attachment)
                                     { return is_taken_away(attachment, ablation->second); });
  if (n_taken == 0)
    throw InputError(fmt::format("register: condition '{}' has nothing to take away: the model has no attachment of "
                                 "kind '{}'{}; leave that condition out",
                                 condition, ablation->second.kind,
                                 ablation->second.organ.empty() ? "" : " at '" + ablation->second.organ + "'"));
  std::erase_if(reduced.bodies, [&](const dataset::RegistrationBody &body) { return holds_nothing(body, reduced); });
  return reduced;
}

void require_known_condition(const std::string &condition)
{
  const std::vector<std::string> known = condition_names();
  if (std::find(known.begin(), known.end(), condition) == known.end())
    throw InputError(
        fmt::format("register: condition '{}' is unknown, allowed are: {}", condition, fmt::join(known, ", ")));
}
} // namespace pelvireg::runner
