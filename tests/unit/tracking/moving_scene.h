// Moving images whose motion is known in closed form: organs with walls in textured fat.
#pragma once

#include "registration/tracking/outline_tracker.h"

#include <functional>

namespace pelvireg::tracking
{
/// An elliptic organ with a dark wall.
struct EllipticOrgan
{
  std::string name;
  Eigen::Vector2d centre, radii; ///< px
  double filling = 1;            ///< signal inside the wall; that of fat is 0.6, of a wall 0.27
  double wall = 2;               ///< px
};

struct Scene
{
  int size = 128; ///< columns and rows
  std::vector<EllipticOrgan> organs;
  /// Displacement (px) of the material point that starts at a place, at full time.
  std::function<Eigen::Vector2d(const Eigen::Vector2d &)> displacement = [](const Eigen::Vector2d &)
  { return Eigen::Vector2d(0, 0); };
  double texture = 0.05; ///< amplitude of each of three waves in the tissue
  double noise = 0;      ///< standard deviation; the signal lies between 0.2 and 1

  /// At time 0 (rest) … 1, with noise drawn from `seed`.
  Image image(double time, unsigned seed) const;
  /// Material points of organ i at a time, 2 px apart at rest.
  PixelPoints outline(std::size_t organ, double time) const;
  std::vector<InitialOutline> initial_outlines() const;
};

/// Bladder, vagina, uterus and rectum as ellipses.
Scene four_organs();

struct OutlineError
{
  double mean = 0, max = 0;          ///< px, between tracked and true material points
  double normal = 0, tangential = 0; ///< px, means of its parts across and along the true outline
};
OutlineError error_of(const PixelPoints &tracked, const PixelPoints &truth);
} // namespace pelvireg::tracking
