// Closest-point projection onto a curved face, and the gap's derivatives with respect to all nodes.
#pragma once

#include <Eigen/Core>

namespace pelvireg::reference_fe
{
/// Columns: N, N,1, N,2, N,11, N,12, N,22 of a face of 9 nodes (square [-1, 1]^2) or 6 nodes (unit triangle).
using SurfaceShapes = Eigen::Matrix<double, Eigen::Dynamic, 6, 0, 9, 6>;
SurfaceShapes surface_shapes(int n_nodes, const Eigen::Vector2d &at);

/// The point of a face closest to a given point, on the face's own polynomial continued beyond its edges.
struct FaceProjection
{
  bool converged = false; ///< false: no such point within one face's width of the face
  Eigen::Vector2d at = Eigen::Vector2d::Zero(); ///< reference coordinates of the closest point
  SurfaceShapes shapes;                         ///< there
  Eigen::Matrix<double, 3, 2> tangents;         ///< x,1 and x,2, mm
  Eigen::Vector3d normal;                       ///< unit, outward
  Eigen::Matrix2d metric, curvature;            ///< a = x,i . x,j and b = n . x,ij
  double gap = 0;                               ///< g = n . (point - x), mm: positive outside
};

/// Newton's method on the distance from `start`.
/// @param nodes 3 x n, mm, outward. @param point mm.
FaceProjection project(const Eigen::Matrix3Xd &nodes, const Eigen::Vector3d &point, const Eigen::Vector2d &start);

/// First and second derivative of one gap with respect to the positions of the nodes of the point's own face (n_own,
/// first) and of the face that it is projected onto: dg = gradient, d2g = basis * coupling * basis^T. The projection
/// moves with the nodes; the derivatives are exact (Laursen and Simo 1993; Wriggers, Computational Contact Mechanics).
struct GapDerivatives
{
  Eigen::VectorXd gradient;                      ///< 3 (n_own + n)
  Eigen::Matrix<double, Eigen::Dynamic, 4> basis; ///< 3 (n_own + n) x 4
  Eigen::Matrix4d coupling;                      ///< symmetric
};

/// @param own_shape N of the point on its own face, n_own.
GapDerivatives gap_derivatives(const FaceProjection &projection, const Eigen::VectorXd &own_shape);
} // namespace pelvireg::reference_fe
