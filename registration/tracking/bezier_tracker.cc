#include "registration/tracking/bezier_tracker.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pelvireg::tracking
{
namespace
{
using Eigen::Vector2d;

constexpr double largest_round_trip = 1;   // px: flow that does not come back has lost its point
constexpr double agreement_of_found = 0.5; // of a joint that was lost
constexpr double largest_correction = 3;   // px, of a match against its prediction, unless searched for
constexpr int n_passes = 2; // of looking for joints and moving them together: the second starts from where all agree
constexpr int search_radius = 6;          // px
constexpr double joint_model_error = 0.2; // px, of a match beside noise: tissue that deforms or leaves the plane

/// Even-odd rule.
bool is_inside(const PixelPoints &closed, const Vector2d &point)
{
  bool inside = false;
  for (Eigen::Index i = 0, n = closed.rows(); i < n; ++i)
  {
    const Eigen::RowVector2d a = closed.row(i), b = closed.row((i + 1) % n);
    if ((a.y() > point.y()) != (b.y() > point.y()) &&
        point.x() < a.x() + (point.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()))
      inside = !inside;
  }
  return inside;
}

/// How a joint's surroundings have turned since the first frame: with the chord of its neighbours.
Eigen::Matrix2d local_turn(const BezierCurve &rest, const std::vector<Vector2d> &now, std::size_t joint)
{
  const std::size_t n = now.size(), next = (joint + 1) % n, before = (joint + n - 1) % n;
  const Vector2d a = rest.joints[next] - rest.joints[before], b = now[next] - now[before];
  const Vector2d turn(a.dot(b), a.x() * b.y() - a.y() * b.x());
  const Vector2d unit = turn.norm() > 1e-9 ? turn.normalized() : Vector2d(1, 0);
  return Eigen::Matrix2d{{unit.x(), -unit.y()}, {unit.y(), unit.x()}};
}
} // namespace

BezierTracker::Organ BezierTracker::make_organ(const InitialOutline &outline) const
{
  Organ organ{outline.organ, fit_bezier(outline, options_), nullptr, {}, {}};
  organ.curve = organ.fit.curve;
  for (const Vector2d &joint : organ.fit.curve.joints)
  {
    std::vector<char> inside;
    for (const Vector2d &offset : ReferencePatch::offsets())
      inside.push_back(is_inside(outline.points, joint + offset));
    organ.joints.push_back({ReferencePatch(first_, joint, inside, noise_)});
  }
  return organ;
}

void BezierTracker::do_start(const Image &first, const std::vector<InitialOutline> &outlines)
{
  first_ = GreyImage(first, options_.smoothing);
  // A Gaussian leaves 1 / (2 sqrt(pi) sigma) of white noise; one much narrower than a pixel leaves it all.
  noise_ = noise_of(first) / std::max(1.0, 2 * std::sqrt(std::numbers::pi) * options_.smoothing);
  tolerance_ = std::max(0.08 * contrast_of(first), 1e-9);
  scale_ = std::make_unique<FlowScale>(first);
  last_ = (*scale_)(first_.pixels());
  organs_.clear();
  for (const InitialOutline &outline : outlines)
    organs_.push_back(make_organ(outline));
  for (Organ &organ : organs_) // their addresses stay from here on
    organ.border = std::make_unique<BorderFit>(first_, organ.fit, noise_, tolerance_);
}

BezierTracker::Sighting BezierTracker::look_for(const Organ &organ, std::size_t index, const Vector2d &start,
                                                const Eigen::Matrix2d &turn, const GreyImage &image) const
{
  const Joint &joint = organ.joints[index];
  const PatchFinding finding =
      joint.is_lost ? joint.patch.search(image, start, turn, search_radius) : joint.patch.find(image, start, turn);
  const bool is_near = joint.is_lost || (finding.position - start).norm() < largest_correction;
  Sighting sighting;
  sighting.agreement = finding.is_in_image ? agreement_of(finding.squared_difference, noise_, tolerance_) : 0;
  sighting.is_lost = !is_near || sighting.agreement < (joint.is_lost ? agreement_of_found : options_.lost_below);
  sighting.measurement.was_seen = !joint.is_lost;
  if (sighting.is_lost)
    return sighting;
  const double variance = 2 * noise_ * noise_ + 0.1 * tolerance_ * tolerance_;
  const Eigen::Matrix2d slight = 1e-9 * (1 + finding.structure.trace()) * Eigen::Matrix2d::Identity();
  const Eigen::Matrix2d covariance = variance * (finding.structure + slight).inverse() +
                                     joint_model_error * joint_model_error * Eigen::Matrix2d::Identity();
  sighting.measurement.position = finding.position;
  sighting.measurement.precision = covariance.inverse();
  return sighting;
}

std::vector<Vector2d> BezierTracker::follow_joints(Organ &organ, const FlowPoint *flow, const GreyImage &image,
                                                   TrackedFrame &frame) const
{
  const std::size_t n = organ.joints.size();
  std::vector<Vector2d> joints = organ.curve.joints, starts = joints;
  for (std::size_t i = 0; i < n; ++i)
    if (flow[i].found && flow[i].round_trip < largest_round_trip && !organ.joints[i].is_lost)
      starts[i] = flow[i].position;
  std::vector<Sighting> sightings(n);
  for (int pass = 0; pass < n_passes; ++pass)
  {
    std::vector<JointMeasurement> measured(n);
    for (std::size_t i = 0; i < n; ++i)
    {
      sightings[i] = look_for(organ, i, starts[i], local_turn(organ.fit.curve, joints, i), image);
      measured[i] = sightings[i].measurement;
    }
    joints = move_joints(organ.fit.curve.joints, organ.curve.joints, measured, {});
    starts = joints;
  }
  for (std::size_t i = 0; i < n; ++i)
  {
    Joint &joint = organ.joints[i];
    frame.n_lost_joints += sightings[i].is_lost;
    frame.n_reacquired_joints += joint.is_lost && !sightings[i].is_lost;
    joint.is_lost = sightings[i].is_lost;
    joint.agreement = sightings[i].agreement;
  }
  return joints;
}

TrackedOutline BezierTracker::outline_of(const Organ &organ, const GreyImage &image) const
{
  const Eigen::Index n = static_cast<Eigen::Index>(organ.fit.places.size());
  TrackedOutline outline{organ.name, organ.fit.points_on(organ.curve), Eigen::VectorXd(n), {}};
  for (Eigen::Index i = 0; i < n; ++i)
  {
    const BezierPlace &place = organ.fit.places[static_cast<std::size_t>(i)];
    const std::size_t next = (place.segment + 1) % organ.joints.size();
    double confidence = 0;
    if (organ.fit.has_border[place.segment])
      confidence = organ.border->agreement(image, organ.curve, place);
    else
      confidence = (1 - place.t) * organ.joints[place.segment].agreement + place.t * organ.joints[next].agreement;
    outline.confidence[i] = std::clamp(confidence, 0.0, 1.0);
    outline.is_lost.push_back(outline.confidence[i] < options_.lost_below);
  }
  return outline;
}

TrackedFrame BezierTracker::do_update(const Image &frame)
{
  const GreyImage image(frame, options_.smoothing);
  FlowFrame now = (*scale_)(image.pixels());
  std::vector<Vector2d> joints;
  for (const Organ &organ : organs_)
    joints.insert(joints.end(), organ.curve.joints.begin(), organ.curve.joints.end());
  const std::vector<FlowPoint> predicted = last_.lucas_kanade(now, joints);

  TrackedFrame tracked;
  const FlowPoint *of_organ = predicted.data();
  for (Organ &organ : organs_)
  {
    const std::vector<Vector2d> moved = follow_joints(organ, of_organ, image, tracked);
    organ.curve = predict(organ.fit.curve, organ.curve, moved);
    of_organ += organ.joints.size();
    if (std::any_of(organ.fit.has_border.begin(), organ.fit.has_border.end(), [](char has) { return has != 0; }))
      organ.curve = organ.border->adjust(image, organ.curve, {});
    tracked.outlines.push_back(outline_of(organ, image));
  }
  last_ = std::move(now);
  return tracked;
}
} // namespace pelvireg::tracking
