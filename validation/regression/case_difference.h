// Are two results of the same case?
#pragma once

#include <optional>
#include <string>

namespace pelvireg::regression
{
/// The first place where two case files differ in content: "registration.youngs_modulus.vagina is 0.7, was 0.66".
/// Nothing when they say the same; order, spaces, comments and the description do not matter. Throws InputError when
/// one is not TOML.
std::optional<std::string> case_difference(const std::string &baseline_text, const std::string &current_text);
} // namespace pelvireg::regression
