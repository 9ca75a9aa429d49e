// Two parts grown together over a patch: vagina and cervix.
#pragma once

#include "reference_fe/elements/surface_face.h"
#include "reference_fe/term.h"

namespace pelvireg::reference_fe
{
/// Stiff penalty tie: energy 1/2 k int |x_a - x_b - (X_a - X_b)|^2 dA over the rest area of the faces of a; x_b is the
/// material point of b's faces closest to x_a at rest. The gap left at rest is kept, so nothing is loaded at rest.
class Tie : public Term
{
public:
  /// @param stiffness k, MPa/mm. Two: a traction of 0.02 MPa opens the tie by 0.01 mm.
  Tie(std::string name, const std::vector<SurfaceFace> &faces_a, const std::vector<SurfaceFace> &faces_b,
      double stiffness = 2);

  std::string name() const override { return name_; }
  int n_items() const override { return static_cast<int>(points_.size()); }
  void unknowns(int item, std::vector<int> &indices) const override;
  void evaluate(int item, const Eigen::VectorXd &solution, LocalSystem &local) const override;

  /// Largest distance that the tie has opened, mm.
  double opening(const Eigen::VectorXd &solution) const;
  /// Largest distance between the tied points at rest, mm.
  double rest_gap() const;

private:
  /// x_a - x_b = sum_i weights_i x_i.
  struct TiedPoint
  {
    std::vector<SurfaceNode> nodes;
    Eigen::VectorXd weights;
    Eigen::Vector3d rest_difference;
    double area = 0; ///< mm^2
  };
  Eigen::Vector3d gap(const TiedPoint &point, const Eigen::VectorXd &solution) const;

  std::string name_;
  double stiffness_;
  std::vector<TiedPoint> points_;
};
} // namespace pelvireg::reference_fe
