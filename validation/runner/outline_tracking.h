// Play an image series to an outline tracker, and compare what it says with the truth.
#pragma once

#include "registration/tracking/outline_tracker.h"
#include "synthetic/dataset/image_series.h"
#include "synthetic/dataset/observations.h"
#include "synthetic/dataset/truth.h"

#include <functional>
#include <string>
#include <vector>

namespace pelvireg::runner
{
/// A closed outline of one organ in the image plane, as points that stand for material points.
struct OrganContour
{
  std::string organ;
  dataset::Points points;   ///< k x 3, mm, LPS
  dataset::Integers region; ///< k, SurfaceRegion code of the segment that starts at each point
};

/// One contour in one frame.
struct TrackedContour
{
  dataset::Points points;     ///< k x 3, mm, in the image plane, in the order of the contour at rest
  Eigen::VectorXd confidence; ///< k, 0 … 1
  std::vector<char> is_lost;  ///< k
};

/// What one tracker made of a series.
struct TrackedSeries
{
  std::string tracker;
  std::vector<OrganContour> rest;
  std::vector<std::vector<TrackedContour>> frames;     ///< by frame (0 is the first), then as `rest`
  std::vector<int> n_lost_joints, n_reacquired_joints; ///< by frame
  double processor_ms = 0;                             ///< a frame, mean
};

/// The outlines at rest, a point every mm: what the segmentation of the first frame would give. Organs in order.
std::vector<OrganContour> rest_contours(const dataset::DynamicFrame &rest);

struct TrackOptions
{
  std::string tracker = "bezier";
  std::vector<std::string> flow_only = {"uterus"}; ///< organs whose border is not looked for (paper, section 4)
  tracking::Options options = {};
  std::function<void(double, const std::string &)> progress = {};
};

/// Follow the contours from the first frame on. Throws InputError for a contour that is not in the image plane (more
/// than half the slice thickness away) or not in the image, an unknown tracker, and what the tracker refuses of a
/// frame.
TrackedSeries track(const dataset::ImageSeries &series, const std::vector<OrganContour> &rest,
                    const TrackOptions &options);

/// What the registration is driven by, from tracked outlines: the frames at the increments, with the control points of
/// `exact.rest` carried by the outlines they lie on at rest; their normals turn with the outline. Control points that
/// the tracker has lost are left out. `exact` gives nothing else but case, plane and the rest frame; slices are empty.
/// @param frames_per_increment image frames between two increments
dataset::Observations observations_of(const TrackedSeries &tracked, const dataset::Observations &exact,
                                      int frames_per_increment);

/// One row of contour_errors.csv.
struct ContourErrorRow
{
  std::string tracker, organ;
  int frame = 0;
  int n_points = 0;
  double mean = 0, hd95 = 0, normal = 0, tangential = 0; ///< mm, see metrics::OutlineTruth::Error
};

/// Errors of every organ in every frame. Throws InputError when frames and increments do not fit together.
std::vector<ContourErrorRow> contour_errors(const TrackedSeries &tracked, const dataset::Truth &truth,
                                            const dataset::Plane &plane, int frames_per_increment);

/// contour_errors.csv
std::string contour_error_csv(const std::vector<ContourErrorRow> &rows);
/// Means over the frames after the first by tracker and organ, for people.
std::string contour_error_table(const std::vector<ContourErrorRow> &rows);
/// tracked_points.csv: every point of every frame with its confidence.
std::string tracked_point_csv(const TrackedSeries &tracked);
} // namespace pelvireg::runner
