// Where a joint of the first frame lies in another one: anchored to the first frame, so that errors do not add up from
// frame to frame.
#pragma once

#include "registration/tracking/grey_image.h"

namespace pelvireg::tracking
{
/// What was found of one joint.
struct PatchFinding
{
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  double squared_difference = 0; ///< weighted mean, in the image's unit squared
  bool is_in_image = false;
  Eigen::Matrix2d structure = Eigen::Matrix2d::Zero(); ///< sum of w grad grad^T at `position`'s side; small along a
                                                       ///< straight border, where a patch slides unseen
};

/// The surroundings of a point in the first frame: 15 x 15 samples a pixel apart under a Gaussian window; those inside
/// the organ count in full, those outside by a tenth, because neighbours slide past.
class ReferencePatch
{
public:
  /// @param is_inside one a sample, row by row, see offsets()
  /// @param noise     standard deviation of the noise in `first`
  ReferencePatch(const GreyImage &first, const Eigen::Vector2d &centre, const std::vector<char> &is_inside,
                 double noise);

  /// Of the samples from the centre, px.
  static const std::vector<Eigen::Vector2d> &offsets();

  /// Gauss-Newton from `start` over the two translations, with the patch turned by `turn` (a rotation: its
  /// surroundings' since the first frame).
  PatchFinding find(const GreyImage &image, const Eigen::Vector2d &start, const Eigen::Matrix2d &turn) const;

  /// The best of a grid of starts up to `radius` px away, refined: for a joint that was lost.
  PatchFinding search(const GreyImage &image, const Eigen::Vector2d &centre, const Eigen::Matrix2d &turn,
                      int radius) const;

private:
  double squared_difference(const GreyImage &image, const Eigen::Vector2d &position, const Eigen::Matrix2d &turn) const;

  std::vector<double> values_, weights_;
  double noise_structure_ = 0; ///< what noise alone adds to either diagonal entry of the structure
  std::vector<Eigen::Vector2d> gradients_;
};
} // namespace pelvireg::tracking
