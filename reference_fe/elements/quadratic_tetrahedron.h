// The solid organ (uterus): quadratic tetrahedra, nearly incompressible, finite strain.
#pragma once

#include "reference_fe/materials/yeoh.h"
#include "reference_fe/term.h"
#include "synthetic/dataset/anatomy.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace pelvireg::reference_fe
{
/// Integration point of a 10-node tetrahedron.
struct TetrahedronPoint
{
  Eigen::Matrix<double, 3, 10> gradient; ///< of the shape functions in the rest frame, 1/mm
  double volume = 0;                     ///< weight times Jacobian, mm^3
};

/// 10-node tetrahedra, total Lagrangian. Energy of a cell: int W(I1bar) dV + kappa/2 V (Jbar - 1)^2, where Jbar is the
/// mean of J over the cell: displacement quadratic, pressure constant a cell (the stable P2-P0 pair), so that
/// kappa/mu of 1000 does not lock. 4 integration points. Exact tangent.
class QuadraticTetrahedra : public Term
{
public:
  /// Node n of the solid owns the unknowns first_unknown + 3 n … + 2. Throws InputError for a cell that is inverted or
  /// folded at an integration point or node.
  QuadraticTetrahedra(const dataset::ReferenceSolid &solid, const dataset::YeohMaterial &material, int first_unknown);

  std::string name() const override { return name_; }
  int n_items() const override { return static_cast<int>(cells_.size()); }
  void unknowns(int item, std::vector<int> &indices) const override;
  void evaluate(int item, const Eigen::VectorXd &solution, LocalSystem &local) const override;

private:
  struct Cell
  {
    Eigen::Matrix<int, 10, 1> nodes;
    TetrahedronPoint points[4];
    double volume = 0; ///< mm^3
  };

  std::string name_;
  Yeoh isochoric_; ///< the law without its volumetric part
  double kappa_;
  int first_unknown_;
  dataset::Points rest_;
  std::vector<Cell> cells_;
};
} // namespace pelvireg::reference_fe
