#include "registration/tracking/patch_match.h"

#include <Eigen/Dense>

#include <limits>

namespace pelvireg::tracking
{
namespace
{
constexpr int half_width = 7;          // px
constexpr double window = 4.0;         // px, standard deviation of the Gaussian window
constexpr double outside = 0.1;        // weight of what is not the organ's own
constexpr double gradient_noise = 0.8; // variance of a difference over a pixel, of noise seen through 0.7 px
constexpr double largest_step = 1.0;   // px, of one iteration
/// A structure tensor less what noise adds to it: along a straight border nothing may be left.
Eigen::Matrix2d without_noise(const Eigen::Matrix2d &structure, double noise)
{
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(structure);
  const Eigen::Vector2d left = (axes.eigenvalues().array() - noise).max(0.0);
  return axes.eigenvectors() * left.asDiagonal() * axes.eigenvectors().transpose();
}
} // namespace

const std::vector<Eigen::Vector2d> &ReferencePatch::offsets()
{
  static const std::vector<Eigen::Vector2d> all = []
  {
    std::vector<Eigen::Vector2d> offsets;
    for (int y = -half_width; y <= half_width; ++y)
      for (int x = -half_width; x <= half_width; ++x)
        offsets.emplace_back(x, y);
    return offsets;
  }();
  return all;
}

ReferencePatch::ReferencePatch(const GreyImage &first, const Eigen::Vector2d &centre,
                               const std::vector<char> &is_inside, double noise)
{
  for (std::size_t k = 0; k < offsets().size(); ++k)
  {
    const Eigen::Vector2d &offset = offsets()[k];
    const Eigen::Vector2d point = centre + offset;
    const double weight = std::exp(-offset.squaredNorm() / (2 * window * window)) * (is_inside[k] ? 1 : outside);
    values_.push_back(first(point));
    gradients_.push_back(first.gradient(point));
    weights_.push_back(first.contains(point) ? weight : 0);
    noise_structure_ += weights_.back() * gradient_noise * noise * noise;
  }
}

double ReferencePatch::squared_difference(const GreyImage &image, const Eigen::Vector2d &position,
                                          const Eigen::Matrix2d &turn) const
{
  double sum = 0, weights = 0;
  for (std::size_t k = 0; k < values_.size(); ++k)
  {
    const double difference = image(position + turn * offsets()[k]) - values_[k];
    sum += weights_[k] * difference * difference;
    weights += weights_[k];
  }
  return sum / weights;
}

PatchFinding ReferencePatch::find(const GreyImage &image, const Eigen::Vector2d &start,
                                  const Eigen::Matrix2d &turn) const
{
  PatchFinding finding{.position = start};
  for (std::size_t k = 0; k < values_.size(); ++k)
    finding.structure += weights_[k] * gradients_[k] * gradients_[k].transpose();
  finding.structure = turn * finding.structure * turn.transpose();
  // Keeps the solution where it is along directions in which nothing is seen.
  const Eigen::Matrix2d system = finding.structure + 1e-3 * finding.structure.trace() * Eigen::Matrix2d::Identity();
  if (!(system.determinant() > 0))
    return finding;
  const Eigen::Matrix2d inverse = system.inverse();
  for (int iteration = 0; iteration < 10; ++iteration)
  {
    Eigen::Vector2d right = Eigen::Vector2d::Zero();
    for (std::size_t k = 0; k < values_.size(); ++k)
      right += weights_[k] * (values_[k] - image(finding.position + turn * offsets()[k])) * gradients_[k];
    Eigen::Vector2d step = inverse * (turn * right);
    if (step.norm() > largest_step)
      step *= largest_step / step.norm();
    finding.position += step;
    if (step.squaredNorm() < 1e-4)
      break;
  }
  finding.structure = without_noise(finding.structure, noise_structure_);
  finding.is_in_image = image.contains(finding.position);
  finding.squared_difference = squared_difference(image, finding.position, turn);
  return finding;
}

PatchFinding ReferencePatch::search(const GreyImage &image, const Eigen::Vector2d &centre, const Eigen::Matrix2d &turn,
                                    int radius) const
{
  Eigen::Vector2d best = centre;
  double least = std::numeric_limits<double>::infinity();
  for (int y = -radius; y <= radius; y += 2)
    for (int x = -radius; x <= radius; x += 2)
    {
      const Eigen::Vector2d start = centre + Eigen::Vector2d(x, y);
      const double value = squared_difference(image, start, turn);
      if (image.contains(start) && value < least)
      {
        least = value;
        best = start;
      }
    }
  return find(image, best, turn);
}
} // namespace pelvireg::tracking
