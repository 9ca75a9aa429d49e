// The judge: compare every registered run, and doing nothing, with the truth.
#pragma once

#include "synthetic/dataset/anatomy.h"
#include "synthetic/dataset/estimate.h"
#include "synthetic/dataset/truth.h"
#include "validation/metrics/statistics.h"

#include <functional>
#include <string>
#include <vector>

namespace pelvireg::runner
{
inline const std::string unregistered = "unregistered"; ///< the rest mesh against every increment

struct EvaluateOptions
{
  double surface_spacing = 5.0; ///< mm: one sample per its square of the truth's rest area (paper, section 6.2)
  double contour_spacing = 1.0; ///< mm of arc length between samples of the truth's contours
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

/// A slice that meets the truth's organ but not the estimate's: no distance exists. Counted, never scored.
struct MissedSlice
{
  std::string condition;
  int sample = 0;
  std::string organ;
  int slice_index = 0;
  double truth_length = 0; ///< mm of contour that the estimate does not answer
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
};

/// How deep two organs of one run reach into each other at the positions' last steps: the judge's own points against
/// the other organ's triangles.
struct OrganPenetration
{
  std::string condition;
  int sample = 0;
  std::string organ_a, organ_b;
  bool is_attached = false; ///< the registration holds the two together: they meet by design
  double deepest = 0;       ///< mm, over the positions
  int step_of_deepest = 0;  ///< 1-based; 0: never
  double last = 0;          ///< mm, at the last step
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
  std::vector<MissedSlice> missed_slices;
  std::vector<OrganMotion> motion; ///< dataset::organ_names in order
  std::vector<RunQuality> quality; ///< without unregistered
  /// Pairs of dataset::organ_names in order; of unregistered the rest meshes' overlap.
  std::vector<OrganPenetration> penetrations;
  /// Mean vaginal in-plane displacement of the last increment (DESIGN 4), mm: the judge's own cut of the truth's
  /// outer surface, and what the reference wrote.
  double vaginal_displacement = 0, reported_vaginal_displacement = 0;

  int n_steps() const { return n_increments * steps_per_increment; }
};

/// Compare. `estimates` may be empty: then only `unregistered` is judged. Fails closed with InputError, one sentence:
/// another case, a missing or repeated organ, condition or sample, a missing step, a position that is not finite, a
/// truth or estimate that the DYN plane misses at the last step.
Evaluation evaluate(const dataset::Anatomy &anatomy, const dataset::Truth &truth,
                    const std::vector<dataset::Estimate> &estimates, const EvaluateOptions &options = {});
} // namespace pelvireg::runner
