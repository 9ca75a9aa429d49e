#include "tests/unit/tracking/moving_scene.h"

#include <cmath>
#include <numbers>
#include <random>

namespace pelvireg::tracking
{
namespace
{
using Eigen::Vector2d;

double texture(const Vector2d &x)
{
  return (std::sin(0.9 * x.x() + 0.4 * x.y()) + std::sin(0.5 * x.x() - 0.8 * x.y() + 1) +
          std::sin(0.23 * x.x() * 1.7 + 0.31 * x.y() + 2));
}

double smooth_step(double distance)
{
  return 0.5 * (1 + std::tanh(distance / 0.7));
}

double signal(const Scene &scene, const Vector2d &place)
{
  double value = 0.6;
  for (const EllipticOrgan &organ : scene.organs)
  {
    const Vector2d q = (place - organ.centre).cwiseQuotient(organ.radii);
    // First-order distance to the ellipse, positive inside.
    const double gradient = q.cwiseQuotient(organ.radii).norm();
    const double inside = gradient > 1e-9 ? (1 - q.norm()) * q.norm() / gradient : organ.radii.minCoeff();
    const double wall = smooth_step(inside), lumen = smooth_step(inside - organ.wall);
    value = (1 - wall) * value + wall * ((1 - lumen) * 0.27 + lumen * organ.filling);
  }
  return value + scene.texture * texture(place);
}
} // namespace

Image Scene::image(double time, unsigned seed) const
{
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0, 1);
  Image frame{size, size, {}};
  for (int row = 0; row < size; ++row)
    for (int column = 0; column < size; ++column)
    {
      const Vector2d here(column, row);
      Vector2d start = here;
      for (int iteration = 0; iteration < 12; ++iteration)
        start = here - time * displacement(start);
      frame.pixels.push_back(static_cast<float>(signal(*this, start) + (noise > 0 ? noise * normal(random) : 0)));
    }
  return frame;
}

PixelPoints Scene::outline(std::size_t organ, double time) const
{
  const EllipticOrgan &shape = organs[organ];
  const int n = static_cast<int>(std::lround(std::numbers::pi * shape.radii.sum() / 2));
  PixelPoints points(n, 2);
  for (int i = 0; i < n; ++i)
  {
    const double angle = 2 * std::numbers::pi * i / n;
    const Vector2d start = shape.centre + shape.radii.cwiseProduct(Vector2d(std::cos(angle), std::sin(angle)));
    points.row(i) = (start + time * displacement(start)).transpose();
  }
  return points;
}

std::vector<InitialOutline> Scene::initial_outlines() const
{
  std::vector<InitialOutline> outlines;
  for (std::size_t i = 0; i < organs.size(); ++i)
    outlines.push_back({organs[i].name, outline(i, 0), {}, false});
  return outlines;
}

Scene four_organs()
{
  Scene scene;
  scene.organs = {{"bladder", {36, 78}, {22, 17}, 1.0, 2},
                  {"vagina", {68, 92}, {6, 22}, 0.95, 3},
                  {"uterus", {66, 42}, {24, 14}, 0.43, 3},
                  {"rectum", {100, 76}, {10, 30}, 0.9, 2.5}};
  return scene;
}

OutlineError error_of(const PixelPoints &tracked, const PixelPoints &truth)
{
  OutlineError error;
  const Eigen::Index n = truth.rows();
  for (Eigen::Index i = 0; i < n; ++i)
  {
    const Eigen::RowVector2d miss = tracked.row(i) - truth.row(i);
    const Eigen::RowVector2d along = (truth.row((i + 1) % n) - truth.row((i + n - 1) % n)).normalized();
    const double tangential = std::abs(miss.dot(along));
    error.mean += miss.norm() / static_cast<double>(n);
    error.max = std::max(error.max, miss.norm());
    error.tangential += tangential / static_cast<double>(n);
    error.normal += std::sqrt(std::max(0.0, miss.squaredNorm() - tangential * tangential)) / static_cast<double>(n);
  }
  return error;
}
} // namespace pelvireg::tracking
