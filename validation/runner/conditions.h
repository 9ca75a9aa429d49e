// The conditions of the registration: which of its constraints hold.
#pragma once

#include "registration/registration.h"
#include "synthetic/dataset/anatomy.h"

#include <string>
#include <vector>

namespace pelvireg::runner
{
/// "full"; "no_boundary_conditions" (image constraints alone); and full with one thing taken away: "no_contact",
/// "no_friction" (organs in contact slide freely), "no_ligaments", "no_fascia", "no_uterus_attachment".
std::vector<std::string> condition_names();

/// Those that are run when nobody asks for others: the two of the paper.
std::vector<std::string> default_conditions();

/// The registration's options in a condition.
registration::Options options_of(const std::string &condition, const dataset::Anatomy &anatomy);

/// The registration's model without what the condition takes away: attachments of a kind, and grids that then hold
/// nothing. Throws InputError when there is nothing to take away: that run would be `full` under another name.
dataset::RegistrationModel model_of(const std::string &condition, const dataset::RegistrationModel &model);

/// Throws InputError that names the known conditions.
void require_known_condition(const std::string &condition);
} // namespace pelvireg::runner
