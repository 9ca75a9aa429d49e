// A piece of the pelvis that CalculiX and the reference's own solver move alike.
#pragma once

#include "reference_fe/decks/decks.h"
#include "synthetic/dataset/anatomy.h"
#include "synthetic/dataset/truth.h"

#include <filesystem>
#include <string>
#include <vector>

namespace pelvireg::reference_fe::deck_case
{
/// Parts of a built-in case with their bars, without fluid, contact and what else they hang together with. When none of
/// them is the vagina, the first shell is called so: the reference measures that part. Whole cells carry the pressure, by
/// their region, so that a deck, which knows one value a face, has the same load. One increment a pressure.
dataset::Anatomy bare_parts(const std::string &case_name, const std::vector<std::string> &parts, int n_increments);

/// Every quadrilateral in four, on the same biquadratic surface; nodes that were there keep their numbers. Every bar
/// becomes parallel ones over the hat function of its node, so that its pull is a traction that refinement leaves
/// alone: the indentation under a single node would grow without limit.
dataset::Anatomy refined(const dataset::Anatomy &anatomy);

/// Equilibrium of the reference's own terms at each pressure (MPa): one surface displacement an increment.
/// Throws std::runtime_error when Newton's method does not converge.
dataset::Truth moved_by_reference(const dataset::Anatomy &anatomy, const std::vector<double> &pressures,
                                  double *seconds = nullptr);

/// Exports the deck, runs ccx in `folder` and imports its result. Throws std::runtime_error when ccx fails.
dataset::Truth moved_by_calculix(const dataset::Anatomy &anatomy, const std::vector<double> &pressures,
                                 const DeckOptions &options, const std::filesystem::path &folder,
                                 double *seconds = nullptr);

/// Difference of two displacement fields of one surface at the last increment.
struct FieldDifference
{
  double largest_displacement = 0; ///< mm, of b
  double largest = 0, mean = 0;    ///< mm, over the nodes away from bars
  int n_away = 0, n_nodes = 0;
};
/// @param a  an imported truth
/// @param n_nodes  how many nodes of the surface are looked at, from the first
/// @param clearance  mm around a bar's end that do not count as away; 0: every node counts
FieldDifference difference(const dataset::Anatomy &anatomy, const dataset::Truth &a, const dataset::Truth &b,
                           std::size_t surface, Eigen::Index n_nodes, double clearance);
} // namespace pelvireg::reference_fe::deck_case
