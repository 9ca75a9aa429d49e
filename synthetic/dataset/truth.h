// truth.h5: how the outer surfaces of the reference moved.
#pragma once

#include "synthetic/dataset/geometry.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace pelvireg::dataset
{
/// The outer surface of one part: rest shape and its displacement at each increment (index 0 is increment 1).
struct TruthSurface
{
  std::string name;
  SurfaceMesh rest;                  ///< closed (caps over the rims), except the pelvic floor
  std::vector<Points> displacements; ///< n_increments x (n x 3), mm
};

/// One reference bar, for pictures: end points at rest and at each increment.
struct TruthTruss
{
  std::string group;
  Points rest;                   ///< 2 x 3, mm
  std::vector<Points> positions; ///< n_increments x (2 x 3), mm
};

/// What the solver reports of one converged increment.
struct IncrementRecord
{
  double pressure = 0;                  ///< abdominal pressure reached, MPa
  double mean_vaginal_displacement = 0; ///< mm, in the DYN plane (DESIGN 4, definitions)
  double residual = 0;                  ///< N, largest free nodal residual force
  double energy = 0;                    ///< N mm, strain energy of all parts
  int newton_iterations = 0;
  int cuts = 0;                     ///< how often the step was cut before it converged
  double max_penetration = 0;       ///< mm, deepest penetration between outer surfaces
  Eigen::VectorXd cavity_volumes;   ///< mm^3, in the order of Truth::cavity_names
  Eigen::VectorXd cavity_pressures; ///< MPa
};

using Points4 = Eigen::Matrix<double, Eigen::Dynamic, 4, Eigen::RowMajor>; ///< one column an organ

/// What an increment balances: where the work went on the way from rest, N mm, and which support carries what, N.
struct BalanceRecord
{
  double external_work = 0;      ///< of the abdominal pressure along the path: minus the integral of p dV swept
  double work_uncertainty = 0;   ///< bound of its quadrature error
  Eigen::VectorXd strain_energy; ///< in the order of Truth::energy_parts
  double contact_energy = 0, tie_energy = 0;
  Eigen::VectorXd cavity_work;     ///< given to the fluid of each cavity, minus the integral of q dV: 0 when closed
  double energy_error_percent = 0; ///< work minus everything above it went to, of the work
  Points reactions;                ///< r x 3, in the order of Truth::supports: on the pelvis
  Eigen::Vector3d pressure_resultant = Eigen::Vector3d::Zero(); ///< of the abdominal pressure on the pelvis
  double force_error = 0;                                       ///< length of the sum of all forces on the pelvis
};

/// The truth's own error bar: what its mesh leaves open, by a study of the same case on three meshes.
struct DiscretisationError
{
  Eigen::Vector3d cell_sizes = Eigen::Vector3d::Zero(); ///< mm, mean of the shells: coarse, middle, that of the truth
  Integers n_cells;                                     ///< 3, quadrilaterals of all shells
  double observed_order = 0, used_order = 0, safety_factor = 0;
  /// Grid convergence index of the displacement over material points of the organs' outer surfaces, mm, one an
  /// increment; away from bars and, for the last, near their nodes.
  Eigen::VectorXd mean, max, max_near_bars;
  Points4 mean_by_organ, max_by_organ;              ///< I x 4, mm, organ_names in order
  double bar_distance = 0;                          ///< mm from a bar's end at rest within which a point is near it
  double share_near_bars = 0;                       ///< of the points
  std::string case_sha256, solver_sha256, revision; ///< of the study's case (its reference part) and program
  bool same_solver = false;                         ///< the truth was made by exactly that solver's source
};

/// How Truth::source begins when the registration itself made the truth: an inverse crime (the model that is judged
/// also made the data), which everything that shows such errors must say.
inline const std::string truth_of_registration = "pelvireg registration";

/// Content of truth.h5.
struct Truth
{
  std::string case_name;
  std::string source; ///< "pelvireg reference (deal.II)", truth_of_registration …, or what was imported
  std::vector<TruthSurface> surfaces; ///< organ_names in order, then pelvic_floor
  std::vector<TruthTruss> trusses;
  std::vector<std::string> cavity_names;
  Eigen::VectorXd cavity_rest_volumes; ///< mm^3
  std::vector<IncrementRecord> increments;
  /// One an increment, or none: an imported motion need not know what it balanced. Nobody may take none for zero.
  std::vector<BalanceRecord> balances;
  std::vector<std::string> energy_parts; ///< shells and solids by name, bars as "bars GROUP"; empty without balances
  std::optional<DiscretisationError> discretisation_error; ///< when a mesh study of this case is known
  std::vector<std::string> supports; ///< "nodes of PART" (held nodes), "bars GROUP" (far ends); empty without balances
};

void save(const Truth &truth, const std::filesystem::path &file);
Truth load_truth(const std::filesystem::path &file);
} // namespace pelvireg::dataset
