// A shell's nodes and cells: what the elements, the ties and the loads of one shell share.
#pragma once

#include "reference_fe/elements/shell_kinematics.h"
#include "synthetic/dataset/anatomy.h"

#include <Eigen/Core>

#include <functional>
#include <string>

namespace pelvireg::reference_fe
{
/// Columns are nodes and cells. Nodes keep the numbering of the dataset's shell, if they come from one.
struct ShellBody
{
  std::string name;
  int order = 2;               ///< p: a cell has (p + 1)^2 nodes
  Eigen::Matrix3Xd midsurface; ///< 3 x n_nodes, mm
  Eigen::Matrix3Xd director;   ///< 3 x n_nodes, unit, outward
  Eigen::VectorXd thickness;   ///< n_nodes, mm
  Eigen::MatrixXi cells;       ///< (p + 1)^2 x n_cells, nodes in the order of deal.II's FE_Q(p)

  int n_nodes() const { return static_cast<int>(midsurface.cols()); }
  int n_cells() const { return static_cast<int>(cells.cols()); }
  ShellNode node(int index) const { return {midsurface.col(index), director.col(index), 0.5 * thickness[index]}; }
};

/// The nodes of a 9-node VTK_BIQUADRATIC_QUAD in the order of FE_Q(2): fe_q2_from_vtk[k] is the VTK position.
inline constexpr int fe_q2_from_vtk[9] = {0, 1, 3, 2, 7, 5, 4, 6, 8};

/// Order 2, nodes numbered as in `shell`. Throws InputError when sizes disagree, an index is out of range, a director
/// is not of unit length (1e-6), a thickness is not positive or a value is not finite.
ShellBody shell_body(const dataset::ReferenceShell &shell);

/// Unit normals of the order-p geometry, averaged over the cells that meet in a node.
Eigen::Matrix3Xd averaged_normals(const ShellBody &body);
} // namespace pelvireg::reference_fe
