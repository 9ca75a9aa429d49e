// truth.h5: how the outer surfaces of the reference moved.
#pragma once

#include "synthetic/dataset/geometry.h"

#include <filesystem>
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
  double pressure = 0;               ///< abdominal pressure reached, MPa
  double mean_vaginal_displacement = 0; ///< mm, in the DYN plane (DESIGN 4, definitions)
  double residual = 0;               ///< N, largest free nodal residual force
  double energy = 0;                 ///< N mm, strain energy of all parts
  int newton_iterations = 0;
  int cuts = 0;                      ///< how often the step was cut before it converged
  double max_penetration = 0;        ///< mm, deepest penetration between outer surfaces
  Eigen::VectorXd cavity_volumes;    ///< mm^3, in the order of Truth::cavity_names
  Eigen::VectorXd cavity_pressures;  ///< MPa
};

/// Content of truth.h5.
struct Truth
{
  std::string case_name;
  std::string source;                 ///< "pelvireg reference (deal.II)" or what was imported
  std::vector<TruthSurface> surfaces; ///< organ_names in order, then pelvic_floor
  std::vector<TruthTruss> trusses;
  std::vector<std::string> cavity_names;
  Eigen::VectorXd cavity_rest_volumes; ///< mm^3
  std::vector<IncrementRecord> increments;
};

void save(const Truth &truth, const std::filesystem::path &file);
Truth load_truth(const std::filesystem::path &file);
} // namespace pelvireg::dataset
