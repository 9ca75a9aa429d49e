#pragma once

#include "synthetic/dataset/truth.h"

#include <string>

namespace pelvireg::cli
{
/// The content of mesh_study.json: every field of the error bar but same_solver.
std::string mesh_study_text(const std::string &case_name, const dataset::DiscretisationError &error);
/// Throws InputError for a text that is not such a file.
dataset::DiscretisationError read_mesh_study(const std::string &text);

/// SHA-256 of what the reference sees of a case.
std::string case_digest(const std::string &text, const std::string &case_name);
/// SHA-256 of the sources that decide its truth: anatomy and reference solver.
std::string solver_digest();
} // namespace pelvireg::cli
