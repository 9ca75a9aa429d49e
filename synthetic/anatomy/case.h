// A case: every dimension, material and load of one pelvis, read from a commented .toml file.
#pragma once

#include "synthetic/dataset/anatomy.h"

#include <string>
#include <vector>

namespace pelvireg::anatomy
{
/// Built-in cases: name and one line of what it is.
struct CaseSummary
{
  std::string name;
  std::string description;
};

/// The built-in cases in the order in which `pelvireg cases` lists them.
std::vector<CaseSummary> built_in_cases();

/// The text of a case file: a built-in name ("t005", "quick") or a path to a .toml file.
/// Throws InputError for an unknown name or an unreadable file.
std::string case_text(const std::string &name_or_path);

/// Read, check and build: case text (TOML) to the whole anatomy. Deterministic: the same text gives the same bytes.
/// Throws InputError (one sentence: what, where, got, allowed, remedy) for an unknown key, a wrong type, a value out of
/// range or organs that would overlap.
dataset::Anatomy build_anatomy(const std::string &text, const std::string &case_name);
} // namespace pelvireg::anatomy
