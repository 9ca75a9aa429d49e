// MR images of the moving pelvis: what a clinic would have.
#pragma once

#include "synthetic/dataset/anatomy.h"
#include "synthetic/dataset/image_series.h"
#include "synthetic/dataset/truth.h"

#include <cstdint>
#include <functional>
#include <string>

namespace pelvireg::observation
{
/// Signal-to-noise ratio: signal of urine over the noise's standard deviation, real or imaginary part.
struct ImageOptions
{
  int matrix = 256;             ///< pixels each way of dynamic images and FFE slices, 64 … 512
  double pixel = 1.5;           ///< mm, 0.5 … 4
  double slice_thickness = 8;   ///< mm of the dynamic images, 2 … 12
  double snr = 20;              ///< of the dynamic images; 0: no noise
  double static_snr = 30;       ///< of TSE and FFE; 0: no noise
  double frame_rate = 4;        ///< frames a second, 0.5 … 10
  int frames_per_increment = 3; ///< 1 … 12
  int segments = 5;       ///< instants that share the lines of one dynamic frame, odd, 1 … 15; 1: no motion within
  std::uint64_t seed = 1; ///< of the noise
  int n_threads = 1;
  std::function<void(double, const std::string &)> progress = {};

  /// What is out of range, one sentence each.
  std::vector<std::string> violations() const;
};

/// The images of one case.
struct Images
{
  dataset::ImageSeries dyn; ///< the DYN plane: frame 0 at rest, frame n k at increment k (n frames an increment)
  dataset::ImageVolume tse; ///< at rest, pixels half as large
  dataset::ImageVolume ffe; ///< at the last increment: slices -n … n of the anatomy
};

/// Renders and acquires all of it; the same bytes for every number of threads.
///
/// *Frames.* Frame f has the time f / frame_rate: when the middle of its k-space is taken. Its lines are spread over
/// one frame's time around that. Between increments every point moves straight and evenly; before frame 0 and after the
/// last one the pelvis rests, so that the last frame's first lines still see motion.
///
/// *Planes.* Columns run to the back, rows down, the view is from the left. The field of view is centred on the organs'
/// outlines in the DYN plane at rest.
///
/// Throws InputError for options out of range and a truth that does not belong to the anatomy.
Images make_images(const dataset::Anatomy &anatomy, const dataset::Truth &truth, const ImageOptions &options);

/// The dynamic images' pixels: where make_images() puts them.
dataset::ImageGeometry dynamic_geometry(const dataset::Anatomy &anatomy, const dataset::Truth &truth,
                                        const ImageOptions &options);
} // namespace pelvireg::observation
