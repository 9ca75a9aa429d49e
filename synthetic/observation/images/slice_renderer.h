// One slice of the moving pelvis as an ideal image: what a scanner of endless resolution and no noise would see.
#pragma once

#include "synthetic/observation/images/raster.h"
#include "synthetic/observation/images/tissue_bodies.h"
#include "synthetic/observation/images/tissue_signals.h"

#include <memory>
#include <vector>

namespace pelvireg::observation
{
/// One plane through the slice and its weight in the slice's profile.
struct ProfileSample
{
  double offset = 0; ///< mm along the normal
  double weight = 0;
};

/// The profile of an excited slice: 1 within 0.4 thicknesses of the middle, falling as cos^2 to 0 at 0.6: its full
/// width at half maximum is the thickness. Midpoints of n intervals; the weights add up to 1.
std::vector<ProfileSample> slice_profile(double thickness, int n);

struct SliceSetting
{
  dataset::ImageGeometry geometry; ///< of the pixels that are acquired
  double thickness = 8;            ///< mm
  TissueSignals signals = bssfp_signals;
  double texture = 1;         ///< scales every texture of organs; 0: each tissue has one signal
  bool has_background = true; ///< false: nothing but air around the organs
  int n_planes = 7;           ///< through the slice
  int oversampling = 2;       ///< fine pixels a pixel, each way
};

/// Renders one slice at any time. Bodies must outlive it. Threads may render at once.
class SliceRenderer
{
public:
  /// Extends the motion of increments first … last into the slice; times outside are not to be asked for.
  SliceRenderer(const std::vector<TissueBody> &bodies, const SliceSetting &setting, std::size_t first,
                std::size_t last);
  ~SliceRenderer();

  /// Signals on the fine pixels, each the mean over its area and the slice's profile. `increment`: 0 rest, k at the end
  /// of increment k, linear in between, held at both ends.
  Raster at(double increment) const;

private:
  struct Implementation;
  std::unique_ptr<const Implementation> implementation_;
};
} // namespace pelvireg::observation
