// Closest point of a triangle, and the split of curved faces into triangles.
#pragma once

#include <Eigen/Core>

#include <array>
#include <vector>

namespace pelvireg::reference_fe
{
struct ClosestPoint
{
  double distance = 0;         ///< mm
  Eigen::Vector3d barycentric; ///< of the closest point, all >= 0, sum 1; exactly 0 on an edge or corner
};

/// Closest point of triangle (a, b, c) to p by Voronoi regions (Ericson, Real-Time Collision Detection, 5.1.5).
ClosestPoint closest_point(const Eigen::Vector3d &p, const Eigen::Vector3d &a, const Eigen::Vector3d &b,
                           const Eigen::Vector3d &c);

/// The triangles through the nodes of a face: 8 around the centre of a 9-node quadrilateral, 4 of a 6-node triangle.
/// Same orientation as the face.
const std::vector<std::array<int, 3>> &face_facets(int n_nodes);

/// Reference coordinates of a node of a face.
Eigen::Vector2d face_node_coordinates(int n_nodes, int node);
} // namespace pelvireg::reference_fe
