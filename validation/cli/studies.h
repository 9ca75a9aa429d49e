// What a truth owes to its mesh and to its fluids: studies of one case by several references.
#pragma once

#include "synthetic/dataset/truth.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace pelvireg::cli
{
/// A case to be studied, and where to work.
struct StudySettings
{
  std::string case_name;        ///< built-in name or path
  std::filesystem::path folder; ///< one result directory a reference; those that are up to date are not solved again
  std::string command_line;
  int jobs = 1;
};

/// Solves the case on three meshes, cells `ratio` times as large, as the case has them, and smaller by the same factor.
/// Prints the table of differences and writes mesh_study.json into the folder. Throws InputError for a ratio not above
/// 1 and what the stages throw.
void run_mesh_study(const StudySettings &settings, double ratio);

/// Solves the case with its cavities closed, leaking (`leak_rate` in mm^3 per kPa and increment) and open, and prints
/// how far the organs' motion differs.
void run_cavity_study(const StudySettings &settings, double leak_rate);

/// The error bar of a truth of this case, when a mesh study of it is known (built_in_mesh_studies()). What only
/// observation and registration read in the case does not matter.
std::optional<dataset::DiscretisationError> known_discretisation_error(const std::string &text,
                                                                       const std::string &case_name);

/// The text of every mesh_study.json that is part of the program. Defined in a generated file (CMakeLists.txt).
std::vector<std::string> built_in_mesh_studies();
} // namespace pelvireg::cli
