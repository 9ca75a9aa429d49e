// A case: every dimension, material and load of one pelvis, read from a commented .toml file.
#pragma once

#include "synthetic/dataset/anatomy.h"

#include <optional>
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

/// The whole text of a case: a built-in name ("t005", "quick") or a path to a .toml file, its base filled in.
/// Throws InputError for an unknown name, an unreadable file and what with_base() refuses.
std::string case_text(const std::string &name_or_path);

/// A case that says `base = "t005"` is that built-in case with what it says itself put in its place: tables key by key,
/// arrays of tables ([[support]]) by their `name`, all else as a whole. Returns the whole case (comments are lost), or
/// the text as it is when it names no base. Throws InputError for a text that is not TOML and for an unknown base.
std::string with_base(const std::string &text, const std::string &case_name);

/// The case with one value replaced or added: `key` is a dotted path ("reference.cell_size.vagina", "cavity.bladder"),
/// `value` TOML ("6.6", "{mode = 'open'}"). Comments are lost. Throws InputError for a text or value that is not TOML.
std::string with_value(const std::string &text, const std::string &case_name, const std::string &key,
                       const std::string &value);

/// What the reference solver's problem depends on, in one canonical form: without comments, name, description and
/// everything that only observation and registration read. Equal texts give equal truths. Throws InputError.
std::string reference_text(const std::string &text, const std::string &case_name);

/// The case whose outlines drive the registration that makes this case's truth (an inverse crime: the paper's Figure
/// 7), when the case says `self_generated_from = "t005_large"`. Throws InputError for a text that is not TOML.
std::optional<std::string> self_generated_from(const std::string &text, const std::string &case_name);

/// The value of a number of the case, by its dotted path. Throws InputError when there is none.
double number_in_case(const std::string &text, const std::string &case_name, const std::string &key);

/// Read, check and build: case text (TOML) to the whole anatomy. Deterministic: the same text gives the same bytes.
/// Throws InputError (one sentence: what, where, got, allowed, remedy) for an unknown key, a wrong type, a value out of
/// range or organs that would overlap.
dataset::Anatomy build_anatomy(const std::string &text, const std::string &case_name);
} // namespace pelvireg::anatomy
