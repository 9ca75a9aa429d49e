#include "registration/tracking/border_fit.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace pelvireg::tracking
{
namespace
{
using Eigen::Vector2d;

constexpr double sample_spacing = 1.5;  // px along the outline
constexpr double reference_spacing = 8; // px between joints
constexpr double remembered = 0.95;     // of an inner control point's place across its chord, from frame to frame
constexpr int n_iterations = 4;
constexpr double largest_shift = 1;    // px, asked for by one sample in one iteration
constexpr double model_error = 0.15;   // px, of a profile's shift beside noise: partial volume, other neighbours
constexpr double outside_weight = 0.5; // of taps beyond the border, where a neighbour may slide past
constexpr double slope_noise = 0.22;   // variance of a mean slope, of noise seen through 0.7 px
constexpr double largest_move = 4;     // px: a solution beyond is not believed
constexpr double correlation = 0.5;    // independent samples a sample, after smoothing

double angle_at(const BezierCurve &curve, std::size_t joint)
{
  const std::size_t before = (joint + curve.n_segments() - 1) % curve.n_segments();
  const Vector2d in = curve.joints[joint] - curve.inner[before][1], out = curve.inner[joint][0] - curve.joints[joint];
  return std::atan2(in.x() * out.y() - in.y() * out.x(), in.dot(out));
}

/// Half-way between the normals of the two segments that meet at a joint.
Vector2d joint_normal(const BezierCurve &curve, std::size_t joint)
{
  const std::size_t before = (joint + curve.n_segments() - 1) % curve.n_segments();
  const Vector2d sum = curve.normal(before, 1) + curve.normal(joint, 0);
  return sum.norm() > 1e-3 ? sum.normalized() : curve.normal(joint, 0);
}

Vector2d chord_normal(const BezierCurve &curve, std::size_t segment)
{
  const Vector2d chord = (curve.next_joint(segment) - curve.joints[segment]).stableNormalized();
  return {chord.y(), -chord.x()};
}

/// Squares of linear forms in the unknowns: joint moves (one a joint), then two inner moves a segment.
struct System
{
  explicit System(std::size_t n)
      : n_joints(n), matrix(Eigen::MatrixXd::Zero(3 * static_cast<Eigen::Index>(n), 3 * static_cast<Eigen::Index>(n))),
        right(Eigen::VectorXd::Zero(3 * static_cast<Eigen::Index>(n)))
  {
  }
  Eigen::Index joint(std::size_t i) const { return static_cast<Eigen::Index>(i % n_joints); }
  Eigen::Index inner(std::size_t segment, int which) const
  {
    return static_cast<Eigen::Index>(n_joints + 2 * (segment % n_joints)) + which;
  }
  /// precision * (form . unknowns - value)^2
  template <std::size_t N>
  void add(const std::array<std::pair<Eigen::Index, double>, N> &form, double value, double precision)
  {
    for (const auto &[row, a] : form)
    {
      right[row] += precision * a * value;
      for (const auto &[column, b] : form)
        matrix(row, column) += precision * a * b;
    }
  }

  std::size_t n_joints;
  Eigen::MatrixXd matrix;
  Eigen::VectorXd right;
};

double precision_of(double deviation)
{
  return 1 / (deviation * deviation);
}

/// How the outline may deviate from `predicted`, seen from `curve`, which has moved by `moved` already.
void add_priors(System &system, const BezierCurve &curve, const Eigen::VectorXd &moved, const BezierFit &fit,
                const std::vector<double> &rest_angle, const BorderPriors &priors)
{
  using Term = std::pair<Eigen::Index, double>;
  for (std::size_t i = 0; i < curve.n_segments(); ++i)
  {
    const Eigen::Index joint = system.joint(i), next = system.joint(i + 1);
    system.add<1>({Term{joint, 1}}, -moved[joint], precision_of(priors.joint));
    const double length = std::max((curve.next_joint(i) - curve.joints[i]).norm(), 0.5);
    const double difference = priors.difference * std::sqrt(length / reference_spacing);
    system.add<2>({Term{joint, 1}, Term{next, -1}}, moved[next] - moved[joint], precision_of(difference));
    for (int which = 0; which < 2; ++which)
    {
      const Eigen::Index inner = system.inner(i, which);
      system.add<1>({Term{inner, 1}}, -moved[inner], precision_of(priors.inner));
    }
    const std::size_t before = (i + curve.n_segments() - 1) % curve.n_segments();
    const double out = std::max((curve.inner[i][0] - curve.joints[i]).norm(), 0.3);
    const double in = std::max((curve.joints[i] - curve.inner[before][1]).norm(), 0.3);
    const double turned = std::remainder(angle_at(curve, i) - rest_angle[i], 2 * M_PI);
    // The normal points to the right of the direction of travel: a move along it turns what leaves clockwise.
    system.add<2>({Term{system.inner(i, 0), -1 / out}, Term{system.inner(before, 1), -1 / in}}, -turned,
                  precision_of(fit.is_corner[i] ? priors.corner_bend : priors.smooth_bend));
  }
}
} // namespace

BezierCurve carry(const BezierCurve &from, const std::vector<Vector2d> &joints)
{
  BezierCurve moved{joints, from.inner};
  for (std::size_t i = 0; i < joints.size(); ++i)
  {
    const Vector2d before = from.next_joint(i) - from.joints[i], now = moved.next_joint(i) - joints[i];
    const double squared = std::max(before.squaredNorm(), 1e-12);
    const double c = before.dot(now) / squared, s = (before.x() * now.y() - before.y() * now.x()) / squared;
    const Eigen::Matrix2d similarity{{c, -s}, {s, c}};
    moved.inner[i][0] = joints[i] + similarity * (from.inner[i][0] - from.joints[i]);
    moved.inner[i][1] = moved.next_joint(i) + similarity * (from.inner[i][1] - from.next_joint(i));
  }
  return moved;
}

BezierCurve predict(const BezierCurve &rest, const BezierCurve &last, const std::vector<Vector2d> &joints)
{
  BezierCurve predicted = carry(rest, joints);
  const BezierCurve now = carry(last, joints);
  for (std::size_t i = 0; i < joints.size(); ++i)
  {
    const Vector2d across = chord_normal(predicted, i);
    for (std::size_t k = 0; k < 2; ++k)
      predicted.inner[i][k] += remembered * across.dot(now.inner[i][k] - predicted.inner[i][k]) * across;
  }
  return predicted;
}

BorderFit::BorderFit(const GreyImage &first, const BezierFit &fit, double noise, double tolerance)
    : fit_(fit), noise_(noise), tolerance_(tolerance)
{
  const BezierCurve &curve = fit.curve;
  for (std::size_t i = 0; i < curve.n_segments(); ++i)
  {
    first_sample_.push_back(samples_.size());
    rest_angle_.push_back(angle_at(curve, i));
    const double length = (curve.next_joint(i) - curve.joints[i]).norm();
    const int n = std::max(3, static_cast<int>(std::ceil(length / sample_spacing)));
    for (int k = 0; k < n; ++k)
    {
      Sample sample{i, (k + 0.5) / n, {}};
      const Vector2d position = curve.position(i, sample.t), normal = curve.normal(i, sample.t);
      for (int tap = 0; tap < n_taps; ++tap)
        sample.profile[static_cast<std::size_t>(tap)] = first(position + (first_tap + tap) * normal);
      samples_.push_back(sample);
    }
  }
  first_sample_.push_back(samples_.size());
}

double BorderFit::squared_difference(const GreyImage &image, const BezierCurve &curve, const Sample &sample) const
{
  const Vector2d position = curve.position(sample.segment, sample.t), normal = curve.normal(sample.segment, sample.t);
  double sum = 0, weights = 0;
  for (int tap = 0; tap < n_taps; ++tap)
  {
    const int offset = first_tap + tap;
    const double weight = offset > 0 ? outside_weight : 1;
    const double difference = image(position + offset * normal) - sample.profile[static_cast<std::size_t>(tap)];
    sum += weight * difference * difference;
    weights += weight;
  }
  return sum / weights;
}

BorderFit::Shift BorderFit::wanted_shift(const GreyImage &image, const BezierCurve &curve, const Sample &sample) const
{
  const Vector2d position = curve.position(sample.segment, sample.t), normal = curve.normal(sample.segment, sample.t);
  if (!image.contains(position))
    return {};
  std::array<double, n_taps + 2> now{};
  for (int tap = 0; tap < n_taps + 2; ++tap)
    now[static_cast<std::size_t>(tap)] = image(position + (first_tap + tap - 1) * normal);
  double information = 0, right = 0, difference_sum = 0, noise_information = 0;
  for (int tap = 1; tap < n_taps - 1; ++tap)
  {
    const std::size_t k = static_cast<std::size_t>(tap);
    const double weight = first_tap + tap > 0 ? outside_weight : 1;
    // Mean slope of both profiles: second order (efficient second-order minimisation).
    const double slope = 0.25 * (now[k + 2] - now[k] + sample.profile[k + 1] - sample.profile[k - 1]);
    const double difference = sample.profile[k] - now[k + 1];
    information += weight * slope * slope;
    noise_information += weight * slope_noise * noise_ * noise_;
    right += weight * slope * difference;
    difference_sum += weight * difference * difference;
  }
  if (!(information > noise_information))
    return {};
  const double variance = 2 * noise_ * noise_ + 0.1 * tolerance_ * tolerance_;
  const double precision =
      1 / (variance / (correlation * (information - noise_information)) + model_error * model_error);
  // What does not look like the first frame has little to say.
  const double agreement = 1 / (1 + difference_sum / (n_taps * (variance + 4 * tolerance_ * tolerance_)));
  return {std::clamp(right / information, -largest_shift, largest_shift), precision * agreement};
}

BezierCurve BorderFit::adjust(const GreyImage &image, const BezierCurve &predicted, const BorderPriors &priors) const
{
  const std::size_t n = predicted.n_segments();
  BezierCurve curve = predicted;
  Eigen::VectorXd moved = Eigen::VectorXd::Zero(3 * static_cast<Eigen::Index>(n));
  std::vector<Vector2d> joint_normals(n), chord_normals(n);
  for (std::size_t i = 0; i < n; ++i)
  {
    joint_normals[i] = joint_normal(predicted, i);
    chord_normals[i] = chord_normal(predicted, i);
  }
  for (int iteration = 0; iteration < n_iterations; ++iteration)
  {
    System system(n);
    add_priors(system, curve, moved, fit_, rest_angle_, priors);
    for (const Sample &sample : samples_)
    {
      if (!fit_.has_border[sample.segment])
        continue;
      const Shift shift = wanted_shift(image, curve, sample);
      const Vector2d normal = curve.normal(sample.segment, sample.t);
      const Eigen::Vector4d b = bernstein(sample.t);
      const std::size_t i = sample.segment, next = (i + 1) % n;
      const double across = normal.dot(chord_normals[i]);
      using Term = std::pair<Eigen::Index, double>;
      system.add<4>({Term{system.joint(i), (b[0] + b[1]) * normal.dot(joint_normals[i])},
                     Term{system.joint(next), (b[2] + b[3]) * normal.dot(joint_normals[next])},
                     Term{system.inner(i, 0), b[1] * across}, Term{system.inner(i, 1), b[2] * across}},
                    shift.value, shift.precision);
    }
    const Eigen::VectorXd step = system.matrix.llt().solve(system.right);
    if (!((moved + step).cwiseAbs().maxCoeff() < largest_move))
      return predicted;
    moved += step;
    for (std::size_t i = 0; i < n; ++i)
    {
      const std::size_t next = (i + 1) % n;
      curve.joints[i] = predicted.joints[i] + moved[system.joint(i)] * joint_normals[i];
      curve.inner[i][0] = predicted.inner[i][0] + moved[system.joint(i)] * joint_normals[i] +
                          moved[system.inner(i, 0)] * chord_normals[i];
      curve.inner[i][1] = predicted.inner[i][1] + moved[system.joint(next)] * joint_normals[next] +
                          moved[system.inner(i, 1)] * chord_normals[i];
    }
    if (step.cwiseAbs().maxCoeff() < 0.01)
      break;
  }
  return curve;
}

double BorderFit::agreement(const GreyImage &image, const BezierCurve &curve, const BezierPlace &place) const
{
  const std::size_t first = first_sample_[place.segment], n = first_sample_[place.segment + 1] - first;
  const std::size_t nearest = std::min(n - 1, static_cast<std::size_t>(place.t * static_cast<double>(n)));
  const Sample &sample = samples_[first + nearest];
  if (!image.contains(curve.position(sample.segment, sample.t)))
    return 0;
  return agreement_of(squared_difference(image, curve, sample), noise_, tolerance_);
}
} // namespace pelvireg::tracking
