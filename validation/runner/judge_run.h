// One run of the registration against the truth.
#pragma once

#include "synthetic/dataset/anatomy.h"
#include "synthetic/dataset/estimate.h"
#include "validation/runner/truth_organ.h"

#include <optional>
#include <string>
#include <vector>

namespace pelvireg::runner
{
/// One organ's rest mesh of the registration, with the points at which it is compared.
struct RestOrgan
{
  dataset::SurfaceMesh mesh;
  std::vector<metrics::SurfaceSample> own_samples;     ///< one per spacing^2 of its own area
  std::vector<metrics::SurfaceSample> material_points; ///< closest to the truth's, at rest
  double volume = 0;                                   ///< mm^3
};

/// Throws InputError as sample_surface does.
RestOrgan prepare_rest(const dataset::SurfaceMesh &mesh, const TruthOrgan &truth, double spacing);

/// What every run is compared with.
struct Context
{
  const dataset::Anatomy &anatomy;
  const EvaluateOptions &options;
  std::vector<TruthOrgan> truth;  ///< organ_names in order
  std::vector<RestOrgan> unmoved; ///< of the anatomy's registration model, organ_names in order
  int n_increments = 0;
  int steps_per_increment = 0;

  int last_step() const { return n_increments * steps_per_increment; }
};

/// One run to be judged; the rest mesh is a run whose positions never change.
struct Run
{
  std::string condition;
  int sample = 0;
  const dataset::EstimateSample *estimate = nullptr; ///< null: unregistered
};

struct RunResult
{
  std::vector<StepError> by_step;
  std::vector<SliceError> by_slice;
  std::vector<StepMetrics> metrics_by_step;
  std::vector<DistanceError> by_distance;
  std::vector<BodyElements> elements;
  std::vector<MissedSlice> missed_slices;
  std::vector<OrganPenetration> penetrations;
  std::optional<RunQuality> quality; ///< none of unregistered
};

template <typename Row> void append(std::vector<Row> &rows, const std::vector<Row> &more)
{
  rows.insert(rows.end(), more.begin(), more.end());
}

/// Throws InputError when the run has lost an organ from the DYN plane at the last step.
RunResult judge(const Context &context, const Run &run);
} // namespace pelvireg::runner
