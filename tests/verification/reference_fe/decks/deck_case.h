// A piece of the pelvis that CalculiX and the reference's own solver move alike.
#pragma once

#include "synthetic/dataset/anatomy.h"
#include "synthetic/dataset/truth.h"

#include <filesystem>
#include <string>
#include <vector>

namespace pelvireg::reference_fe::deck_case
{
/// One shell of a built-in case with its bars, without its fluid and whatever it touches. It is called 'vagina', since
/// the reference measures that part. One increment a pressure.
dataset::Anatomy lone_shell(const std::string &case_name, const std::string &part, int n_increments);

/// Every quadrilateral in four, on the same biquadratic surface; nodes that were there keep their numbers. Every bar
/// becomes parallel ones over the hat function of its node, so that its pull is a traction that refinement leaves
/// alone: the indentation under a single node would grow without limit.
dataset::Anatomy refined(const dataset::Anatomy &anatomy);

/// Equilibrium of the reference's own terms at each pressure (MPa): one surface displacement an increment.
/// Throws std::runtime_error when Newton's method does not converge.
dataset::Truth moved_by_reference(const dataset::Anatomy &anatomy, const std::vector<double> &pressures,
                                  double *seconds);

/// Exports the deck, runs ccx in `folder` and imports its result. Throws std::runtime_error when ccx fails.
dataset::Truth moved_by_calculix(const dataset::Anatomy &anatomy, const std::vector<double> &pressures, int layers,
                                 const std::filesystem::path &folder, double *seconds);

/// Difference of two displacement fields at the last increment over the first `n_nodes` nodes of the only surface.
struct FieldDifference
{
  double largest_displacement = 0; ///< mm, of b
  double largest = 0, mean = 0;    ///< mm, over the nodes away from bars
  double largest_anywhere = 0;     ///< mm
  int n_away = 0, n_nodes = 0;
};
/// `clearance`: mm around a bar's node that do not count as away.
FieldDifference difference(const dataset::Anatomy &anatomy, const dataset::Truth &a, const dataset::Truth &b,
                           Eigen::Index n_nodes, double clearance);
} // namespace pelvireg::reference_fe::deck_case
