// What a scanner makes of an ideal image: few k-space lines, one after the other, with noise.
#pragma once

#include "synthetic/observation/images/raster.h"

#include <cstdint>
#include <vector>

namespace pelvireg::observation
{
struct AcquisitionSetting
{
  int rows = 256, columns = 256;                   ///< of the image
  int acquired_rows = 256, acquired_columns = 192; ///< of k-space: the middle of it; the rest is filled with zeros
  int oversampling = 2;                            ///< of the ideal images
  double noise = 0;                                ///< standard deviation of real and imaginary part in the image
  std::uint64_t seed = 1;
};

/// Cartesian acquisition of the mean over fine pixels: Fourier transform, k-space truncated to the acquired lines
/// (columns are the phase direction: anterior to posterior, where the body ends within the field of view), zero-filled
/// transform back, magnitude. The fine pixels' own averaging is taken out again, so that what remains is the Fourier
/// series of the object up to the last line: with it, its ringing (Gibbs).
///
/// Noise is complex, normal and white over the acquired samples, so the magnitude is Rician with the given sigma in
/// every pixel; where k-space is filled with zeros neighbours are correlated. It depends on seed and image number
/// alone.
class Acquisition
{
public:
  /// Throws InputError when more is acquired than the image has, or less than 8 lines.
  explicit Acquisition(const AcquisitionSetting &setting);
  ~Acquisition();
  Acquisition(const Acquisition &) = delete;
  Acquisition &operator=(const Acquisition &) = delete;

  /// One image. The ideal images are the object while the 1st, 2nd, … equal share of the phase lines is taken, from the
  /// lowest to the highest frequency through 0. Threads may acquire at once.
  Raster acquire(const std::vector<Raster> &ideal, std::uint32_t image) const;

private:
  AcquisitionSetting setting_;
  void *forward_; ///< plans of FFTW
  void *backward_;
};
} // namespace pelvireg::observation
