#include "registration/tracking/baselines/snake_tracker.h"

#include "registration/tracking/baselines/static_tracker.h"
#include "registration/tracking/closed_spline.h"

#include <Eigen/Dense>

namespace pelvireg::tracking
{
namespace
{
constexpr double spacing = 2; // px between the snake's points
constexpr double blur = 1.0;  // px
constexpr double tension = 0.05, bending = 0.1;
constexpr double step = 1; // px moved by the force of a strong edge in one iteration
constexpr int n_iterations = 40;

/// Magnitude of the gradient at every pixel.
Image edges_of(const GreyImage &image)
{
  Image edges{image.columns(), image.rows(), {}};
  for (int row = 0; row < image.rows(); ++row)
    for (int column = 0; column < image.columns(); ++column)
      edges.pixels.push_back(static_cast<float>(image.gradient(Eigen::Vector2d(column, row)).norm()));
  return edges;
}
} // namespace

SnakeTracker::Snake SnakeTracker::make_snake(const PixelPoints &outline)
{
  const ArcLength arc(outline);
  const Eigen::Index m = std::max<Eigen::Index>(8, std::lround(arc.perimeter / spacing));
  Snake snake;
  snake.rest = even_points(outline, m);
  snake.points = snake.rest;
  snake.share.resize(outline.rows());
  snake.remainder.resize(outline.rows(), 2);
  for (Eigen::Index i = 0; i < outline.rows(); ++i)
  {
    const double place = arc.share[i] * static_cast<double>(m);
    const Eigen::Index before = std::min<Eigen::Index>(static_cast<Eigen::Index>(place), m - 1);
    snake.before.push_back(before);
    snake.share[i] = place - static_cast<double>(before);
    snake.remainder.row(i) = outline.row(i) - (1 - snake.share[i]) * snake.rest.row(before) -
                             snake.share[i] * snake.rest.row((before + 1) % m);
  }
  Eigen::MatrixXd second = Eigen::MatrixXd::Zero(m, m);
  for (Eigen::Index i = 0; i < m; ++i)
  {
    second(i, i) = -2;
    second(i, (i + 1) % m) += 1;
    second(i, (i + m - 1) % m) += 1;
  }
  snake.inverse = (Eigen::MatrixXd::Identity(m, m) - tension * second + bending * second * second).inverse();
  return snake;
}

void SnakeTracker::do_start(const Image &first, const std::vector<InitialOutline> &outlines)
{
  tracked_ = as_given(outlines);
  slope_ = std::max(contrast_of(edges_of(GreyImage(first, blur))), 1e-12);
  snakes_.clear();
  for (const InitialOutline &outline : outlines)
    snakes_.push_back(make_snake(outline.points));
}

TrackedFrame SnakeTracker::do_update(const Image &frame)
{
  const GreyImage edges(edges_of(GreyImage(frame, blur)), 0);
  for (std::size_t organ = 0; organ < snakes_.size(); ++organ)
  {
    Snake &snake = snakes_[organ];
    const Eigen::Index m = snake.rest.rows();
    for (int iteration = 0; iteration < n_iterations; ++iteration)
    {
      PixelPoints force(m, 2);
      for (Eigen::Index i = 0; i < m; ++i)
      {
        const Eigen::Vector2d along = (snake.points.row((i + 1) % m) - snake.points.row((i + m - 1) % m)).transpose();
        const Eigen::Vector2d normal = Eigen::Vector2d(along.y(), -along.x()).stableNormalized();
        const Eigen::Vector2d uphill = edges.gradient(snake.points.row(i).transpose());
        force.row(i) = (uphill.dot(normal) / slope_ * normal).transpose();
      }
      snake.points = snake.rest + snake.inverse * (snake.points + step * force - snake.rest);
    }
    PixelPoints &points = tracked_.outlines[organ].points;
    for (Eigen::Index i = 0; i < points.rows(); ++i)
    {
      const Eigen::Index before = snake.before[static_cast<std::size_t>(i)];
      points.row(i) = (1 - snake.share[i]) * snake.points.row(before) +
                      snake.share[i] * snake.points.row((before + 1) % m) + snake.remainder.row(i);
    }
  }
  return tracked_;
}
} // namespace pelvireg::tracking
