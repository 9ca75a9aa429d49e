// Everything that the judge found.
#pragma once

#include "validation/metrics/element_jacobian.h"
#include "validation/metrics/material_error.h"
#include "validation/metrics/statistics.h"
#include "validation/metrics/symmetric_distance.h"

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace pelvireg::runner
{
inline const std::string unregistered = "unregistered"; ///< the rest mesh against every increment

struct EvaluateOptions
{
  double surface_spacing = 5.0; ///< mm: one sample per its square of the truth's rest area (paper, section 6.2)
  double contour_spacing = 1.0; ///< mm of arc length between samples of the truth's contours
  double line_spacing = 1.0;    ///< mm between the lines along which volumes in common are measured
  int n_threads = 1;            ///< the result is bit-identical for every value
  std::function<void(double, const std::string &)> progress;
};

/// Distance of the truth's surface samples to the registered outer surface at one step.
struct StepError
{
  std::string condition;
  int sample = 0;
  std::string organ;
  int step = 0;                 ///< 1-based; compared with increment ceil(step / steps per increment)
  metrics::Statistics distance; ///< mm
};

/// Distance of the truth's contour samples to the estimate's contour in one validation slice at the last step.
struct SliceError
{
  std::string condition;
  int sample = 0;
  std::string organ;
  int slice_index = 0;          ///< 0 is the DYN plane
  double offset = 0;            ///< mm along the plane's normal (to the left)
  metrics::Statistics distance; ///< mm
};

/// Beyond surface distance, at the last step of a position. Of `unregistered` the estimate is the rest mesh.
struct StepMetrics
{
  std::string condition;
  int sample = 0;
  std::string organ;
  int step = 0; ///< 1-based
  /// The estimate's displacement minus the truth's, both of the truth's surface sample: the point of the estimate's
  /// rest surface that is closest to it at rest stands for it.
  metrics::MaterialError material;
  metrics::SymmetricDistance symmetric;          ///< of the outer surfaces, caps excluded, samples on both
  double dice = 0;                               ///< of what the closed outer surfaces enclose, lumen included
  double volume = 0, truth_volume = 0;           ///< mm^3, enclosed by the closed outer surface
  double rest_volume = 0, truth_rest_volume = 0; ///< mm^3
  double rotation_error = 0; ///< rad, of the rotation that best carries the estimate's material points to the truth's
  double truth_rotation = 0; ///< rad, of the rotation that best carries the truth's from rest
};

/// Surface and material-point error at the last step of the samples in one slab parallel to the DYN plane.
struct DistanceError
{
  std::string condition;
  int sample = 0;
  std::string organ;
  int bin = 0; ///< offsets [(bin - 1/2) pitch, (bin + 1/2) pitch) of where the truth's sample is; + left
  metrics::Statistics distance; ///< mm, to the closest triangle
  double material_mean = 0;     ///< mm
};

/// The elements of one body of the registration at the last step.
struct BodyElements
{
  std::string condition;
  int sample = 0;
  std::string body;
  metrics::ElementJacobian jacobian;
};

/// The truth's section in one validation slice at the last increment.
struct TruthSection
{
  std::string organ;
  int slice_index = 0;
  double area = 0;  ///< mm^2, caps included
  double share = 0; ///< of the organ's largest section over the slices, 0 … 1
};

/// A slice that meets the truth's organ but not the estimate's: no distance exists. Counted, never scored.
struct MissedSlice
{
  std::string condition;
  int sample = 0;
  std::string organ;
  int slice_index = 0;
  double truth_length = 0; ///< mm of contour that the estimate does not answer
};

/// Nodes of one body of the registration, those inside too.
struct BodySize
{
  std::string body;
  int n_nodes = 0;
};

/// How the truth moved one organ from rest to the last increment, over its surface samples; mm.
struct OrganMotion
{
  std::string organ;
  double mean = 0, max = 0;                     ///< length of the displacement
  double mean_off_plane = 0, max_off_plane = 0; ///< its component along the DYN plane's normal, absolute value
  /// Distance of the samples at rest to the registration's rest mesh: what two meshes of one shape differ before
  /// anything moves. No registration can be expected to come below it.
  metrics::Statistics mesh_difference;
};

/// What one run says of itself (issue A: acceptance at least 90 %, residual at most 0.3 mm at each position's last
/// step).
struct RunQuality
{
  std::string condition;
  int sample = 0;
  int n_steps = 0, n_failed_steps = 0;
  double least_acceptance = 0;      ///< least share of accepted control points over the steps, 0 … 1
  double largest_mean_residual = 0; ///< mm, over the last steps of the positions, of the mean in-plane residual
  double largest_residual = 0;      ///< mm, same, of the maximum
  double largest_out_of_plane_force = 0, largest_in_plane_force = 0; ///< N, over all steps
  double mean_outline_constraints = 0;                               ///< accepted control points a step
  double mean_contacts = 0;                                          ///< contact constraints a step
};

/// How deep two organs of one run reach into each other at the positions' last steps: the judge's own points against
/// the other organ's triangles.
struct OrganPenetration
{
  std::string condition;
  int sample = 0;
  std::string organ_a, organ_b;
  bool is_attached = false;                   ///< the registration holds the two together: they meet by design
  double deepest = 0;                         ///< mm, over the positions
  int step_of_deepest = 0;                    ///< 1-based; 0: never
  double last = 0;                            ///< mm, at the last step
  double largest_volume = 0, last_volume = 0; ///< mm^3 inside both, over the positions and at the last step
};

/// Everything that the judge found. Rows are ordered by condition (unregistered, no_boundary_conditions, full, others
/// by name), sample, organ (dataset::organ_names), step or slice.
struct Evaluation
{
  std::string case_name, truth_source;
  int n_increments = 0, steps_per_increment = 0;
  double slice_pitch = 0; ///< mm
  int n_slices_each_side = 0;
  EvaluateOptions options;
  std::vector<std::string> conditions; ///< in order
  std::vector<StepError> by_step;
  std::vector<SliceError> by_slice;
  std::vector<StepMetrics> metrics_by_step;
  std::vector<DistanceError> by_distance;
  std::vector<BodyElements> elements; ///< of the runs whose estimate holds its bodies' nodes; without unregistered
  std::vector<TruthSection> sections; ///< organ_names in order, slices that meet the truth
  std::vector<MissedSlice> missed_slices;
  std::vector<OrganMotion> motion; ///< dataset::organ_names in order
  std::vector<RunQuality> quality; ///< without unregistered
  /// Pairs of dataset::organ_names in order; of unregistered the rest meshes' overlap.
  std::vector<OrganPenetration> penetrations;
  /// Mean vaginal in-plane displacement of the last increment (DESIGN 4), mm: the judge's own cut of the truth's
  /// outer surface, and what the reference wrote.
  double vaginal_displacement = 0, reported_vaginal_displacement = 0;

  std::vector<BodySize> registration_nodes;         ///< of all bodies, as the paper's Table 1 counts
  std::map<std::string, std::string> perturbations; ///< by condition, what its randomised runs were given: "modulus", …
  std::map<std::string, double> modulus_spreads;    ///< by condition, of Young's moduli
  bool is_inverse_crime = false; ///< the registration itself made the truth: the error says nothing of its model

  int n_steps() const { return n_increments * steps_per_increment; }
  int n_registration_nodes() const
  {
    int sum = 0;
    for (const BodySize &size : registration_nodes)
      sum += size.n_nodes;
    return sum;
  }
};
} // namespace pelvireg::runner
