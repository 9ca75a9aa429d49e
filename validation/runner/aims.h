// What this project wants of its registration, beyond the paper's claims.
#pragma once

#include "validation/runner/evaluate.h"

#include <string>
#include <vector>

namespace pelvireg::runner
{
/// "met", "missed", or "not assessed" with the reason in `ours`.
struct Aim
{
  std::string id;   ///< short, stable, for programs
  std::string aim;  ///< what is wanted
  std::string ours; ///< our numbers, or why there are none
  std::string verdict;
};

/// Mean surface error with all constraints on (at most 1.5 mm in small, 3 mm in large motion, every organ and step),
/// what it leaves of doing nothing (at most 40 % for vagina and bladder), and what the boundary conditions gain for the
/// vagina (2 and 4 times). They are aims for the registration; no truth is made to meet them.
std::vector<Aim> assess_aims(const Evaluation &evaluation);
} // namespace pelvireg::runner
