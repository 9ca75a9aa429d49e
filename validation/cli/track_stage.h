// The track stage: outlines followed through the images of a result directory.
#pragma once

#include "validation/cli/stage_cache.h"

#include <string>
#include <vector>

namespace pelvireg::cli
{
/// What the stage draws.
inline const std::string tracked_picture = "pictures/tracked_frames.png";
inline const std::string contour_error_figure = "pictures/contour_errors.svg";
inline const std::string dynamic_images = "images/dyn.nrrd"; ///< made by the images stage

struct TrackRequest
{
  std::string tracker = "bezier"; ///< whose outlines are kept
  bool all = false;               ///< every other tracker is compared too
  bool uterus_border = false;     ///< look for the uterus' border instead of following its flow alone
};

/// From images/dyn.nrrd and the rest outlines of observations.h5: tracked.h5, tracked_points.csv, and, against the
/// truth, contour_errors.csv, contour_table.txt, pictures/tracked_frames.png. Trackers see neither truth nor later
/// outlines.
void make_tracked(ResultDirectory &directory, const TrackRequest &request);

/// contour_table.txt and the frames a second on standard output.
void print_contour_table(const ResultDirectory &directory);

/// What the tracking costs: errors of estimates driven by tracked outlines beside those driven by exact ones, from
/// errors_by_step.csv: mean surface error of every organ at the last step, mm. Empty when there is no pair.
std::string tracking_cost_table(const ResultDirectory &directory);
} // namespace pelvireg::cli
