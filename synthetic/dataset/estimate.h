// estimate-<label>.h5: where the registration put the organs.
#pragma once

#include "synthetic/dataset/geometry.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace pelvireg::dataset
{
/// What one registration step says of itself.
struct StepRecord
{
  std::string status = "ok"; ///< "ok", or why the step failed
  int offered_control_points = 0;
  int accepted_control_points = 0;
  double in_plane_residual = 0;     ///< mm, mean over the accepted points after the step, re-matched
  double max_in_plane_residual = 0; ///< mm
  double attachment_residual = 0;   ///< mm, largest
  double out_of_plane_force = 0;    ///< N, largest nodal component along the plane's normal of the sliding rows' forces
  double in_plane_force = 0;        ///< N, largest nodal in-plane component of the same
  int solver_sweeps = 0;
  int contacts = 0;                   ///< contact constraints offered to the solver
  double contact_force = 0;           ///< N, sum of the contacts' normal forces
  double contact_residual = 0;        ///< mm, how far the solve is from the laws of contact and friction
  double friction_cone_violation = 0; ///< N, largest excess of a friction force over its limit
  int open_rays = 0;                  ///< rays that an organ's surface did not close: left out of the contacts
  /// After the step, one a pair of Estimate::contact_pairs, as the registration sees it.
  std::vector<double> penetration_depth;  ///< mm
  std::vector<double> penetration_volume; ///< mm^3
};

/// One registered organ: the outer surface, with its positions at each step.
struct EstimateSurface
{
  std::string name;
  SurfaceMesh rest;
  std::vector<Points> positions; ///< n_steps x (n x 3), mm
};

/// The kind of an estimate whose outlines were tracked in images: nothing is drawn, every run has them.
inline const std::string tracked_outlines = "images";

/// What the randomised runs of an estimate were given instead of the truth, one thing at a time; 0 for all others. The
/// draws are described where they are made (validation/runner/perturbation.h).
struct Perturbation
{
  std::string kind = "modulus";          ///< "modulus", "surface", "outline", "plane" or tracked_outlines
  std::uint64_t seed = 1;                ///< run k depends on seed and k alone
  double modulus_spread = 0;             ///< Young's moduli times 1 + spread U(-1, 1)
  double surface_sd = 0;                 ///< mm, of the rest surfaces along their normal
  double surface_correlation_length = 0; ///< mm
  double outline_sd = 0;                 ///< mm, of a control point along each of two axes in the plane
  double plane_offset_sd = 0;            ///< mm, along the DYN plane's normal
  double plane_tilt_sd = 0;              ///< rad, about each of two axes in the DYN plane
  bool operator==(const Perturbation &) const = default;
};

/// All nodes of one body of the registration, those inside too: what became of its elements.
struct BodyNodes
{
  std::string name;
  Points rest; ///< n x 3, mm, in the order of the body's nodes in the anatomy
  Points last; ///< n x 3, mm, at the last step
};

/// One run of the registration.
struct EstimateSample
{
  int sample = 0;                        ///< 0 is the nominal run
  std::vector<EstimateSurface> surfaces; ///< organ_names in order
  std::vector<StepRecord> steps;
  std::vector<BodyNodes> bodies; ///< those that take part; empty when they were not kept
};

/// Content of estimate-<label>.h5.
struct Estimate
{
  std::string case_name;
  std::string condition; ///< "full", "no_boundary_conditions", …
  std::vector<EstimateSample> samples;
  /// Organs that were kept from penetrating each other; empty when the condition has no contact.
  std::vector<std::pair<std::string, std::string>> contact_pairs;
  Perturbation perturbation = {};

  /// What files and tables call these runs: the condition, followed by what was perturbed when that is not the moduli:
  /// "full", "full_outline".
  std::string label() const { return perturbation.kind == "modulus" ? condition : condition + "_" + perturbation.kind; }
};

/// The rest surfaces of the file are those of the first sample; a sample whose rest points differ keeps its own.
void save(const Estimate &estimate, const std::filesystem::path &file);
Estimate load_estimate(const std::filesystem::path &file);
/// With its first run alone, which is the nominal one of a whole estimate; the others are not read.
Estimate load_first_run(const std::filesystem::path &file);
} // namespace pelvireg::dataset
