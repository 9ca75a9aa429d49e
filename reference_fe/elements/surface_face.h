// A curved face made of surface nodes: 9-node quadrilateral or 6-node triangle.
#pragma once

#include "reference_fe/elements/surface_node.h"

#include <Eigen/Geometry>

#include <vector>

namespace pelvireg::reference_fe
{
/// Isoparametric face of 9 nodes (VTK_BIQUADRATIC_QUAD order) or 6 nodes (VTK_QUADRATIC_TRIANGLE order), outward; or a
/// piece of a flat cap of 4 nodes: the cone x(s, t) = c + t (e(s) - c) from an apex c (node 0) over a quadratic edge
/// e(s) (nodes 1, 2, 3: corner, mid-side, corner, counter-clockwise seen from outside).
struct SurfaceFace
{
  std::vector<SurfaceNode> nodes;
};

/// Shape functions of a face at one quadrature point.
struct FacePoint
{
  Eigen::VectorXd value; ///< n
  Eigen::VectorXd d_xi;  ///< n, derivative in the first reference coordinate
  Eigen::VectorXd d_eta; ///< n
  double weight = 0;     ///< of the reference element
};

/// Shape functions of a 9-node (square [-1, 1]^2) or 6-node (unit triangle) face at one point.
FacePoint face_shape(int n_nodes, double xi, double eta);

/// Quadrature points that integrate N_i (x,xi cross x,eta) and x . (x,xi cross x,eta) exactly: 3 x 3 Gauss on the
/// square (degree 5 in each coordinate), 7 points of degree 5 on the triangle. For a cap piece `value`, `d_xi`, `d_eta`
/// are c, e, de/ds after exact integration over t: good for volumes only.
const std::vector<FacePoint> &face_quadrature(int n_nodes);

/// The matrix of the cross product, skew(a) b = a x b.
Eigen::Matrix3d skew(const Eigen::Vector3d &a);
} // namespace pelvireg::reference_fe
