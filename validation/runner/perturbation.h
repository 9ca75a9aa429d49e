// What a randomised run is given instead of the truth: one thing at a time. Run 0 is nominal; run k depends on the seed
// and k alone, and so do its numbers for each body, wave, frame and point.
#pragma once

#include "synthetic/dataset/anatomy.h"
#include "synthetic/dataset/estimate.h"
#include "synthetic/dataset/observations.h"
#include "validation/runner/random_numbers.h"

#include <Eigen/Geometry>

#include <cstdint>
#include <string>
#include <vector>

namespace pelvireg::runner
{
/// "modulus", "surface", "outline", "plane".
std::vector<std::string> perturbation_kinds();
/// The same, and dataset::tracked_outlines: all that an estimate can be given.
std::vector<std::string> estimate_kinds();

/// Throws InputError for an unknown kind, a magnitude out of range (0 <= spread < 1, standard deviations >= 0, a
/// correlation length > 0 for surfaces) and a magnitude of another kind than this one.
void require_usable(const dataset::Perturbation &perturbation);

/// Factor of body `body`'s Young's modulus in run `sample`: 1 + spread U, U uniform in [-1, 1). Sample 0 is nominal: 1.
double modulus_factor(std::uint64_t seed, int sample, int body, double spread);

/// A smooth random displacement of space: each component is a Gaussian random field of standard deviation sd and
/// correlation exp(-r^2 / (2 L^2)), drawn as 128 cosine waves (random Fourier features; Rahimi and Recht 2007).
class DisplacementNoise
{
public:
  DisplacementNoise(std::uint64_t seed, int sample, double sd, double correlation_length);
  /// mm, at a point in mm.
  Eigen::Vector3d at(const Eigen::Vector3d &point) const;

private:
  static constexpr int n_waves = 128;
  using WaveNumbers = Eigen::Matrix<double, n_waves, 3>;
  double amplitude_;
  std::array<WaveNumbers, 3> wave_numbers_;                ///< 1/mm, one set a component
  std::array<Eigen::Array<double, n_waves, 1>, 3> phases_; ///< rad
};

/// Where the registration believes an image of the true plane to lie: a rotation about `centre` around an axis in the
/// plane, then an offset along the true normal. Both axes' angles and the offset are normal numbers.
Eigen::Isometry3d plane_error(const dataset::Perturbation &perturbation, int sample, const dataset::Plane &plane,
                              const Eigen::Vector3d &centre);

/// The registration's model in run `sample`. "modulus": Young's modulus of every body. "surface": one
/// DisplacementNoise moves all nodes, so that walls keep their thickness, attachments stay closed and organs that touch
/// share the error of their common boundary. Throws InputError when that inverts an element.
dataset::RegistrationModel perturbed(const dataset::RegistrationModel &model, const dataset::Perturbation &perturbation,
                                     int sample);

/// What drives the registration in run `sample`. "outline": every control point of every frame moves in the plane, by
/// independent normal numbers along two axes; its normal stays. "plane": plane and control points move by plane_error()
/// about the centroid of the first frame's control points.
dataset::Observations perturbed(const dataset::Observations &observations, const dataset::Perturbation &perturbation,
                                int sample);
} // namespace pelvireg::runner
