#include "reference_fe/elements/shell_body.h"

#include "reference_fe/elements/shell_reference_cell.h"
#include "synthetic/dataset/error.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <cmath>

namespace pelvireg::reference_fe
{
namespace
{
void check(const dataset::ReferenceShell &shell)
{
  const Eigen::Index n = shell.midsurface.rows();
  if (shell.directors.rows() != n || shell.thickness.size() != n)
    throw InputError(fmt::format("shell '{}' has {} nodes but {} directors and {} thicknesses; give one of each a node",
                                 shell.name, n, shell.directors.rows(), shell.thickness.size()));
  for (Eigen::Index i = 0; i < n; ++i)
  {
    if (!shell.midsurface.row(i).allFinite() || !(std::abs(shell.directors.row(i).norm() - 1) <= 1e-6))
      throw InputError(fmt::format("node {} of shell '{}' has a position that is not finite or a director of length "
                                   "{:.6g}; directors must have unit length",
                                   i, shell.name, shell.directors.row(i).norm()));
    if (!(shell.thickness[i] > 0) || !std::isfinite(shell.thickness[i]))
      throw InputError(fmt::format("node {} of shell '{}' has the thickness {} mm; it must be positive", i, shell.name,
                                   shell.thickness[i]));
  }
  if (shell.cells.rows() == 0 || shell.cells.minCoeff() < 0 || shell.cells.maxCoeff() >= n)
    throw InputError(fmt::format("shell '{}' has {} cells with node indices outside 0 … {}; renumber its cells",
                                 shell.name, shell.cells.rows(), n - 1));
}
} // namespace

ShellBody shell_body(const dataset::ReferenceShell &shell)
{
  check(shell);
  ShellBody body;
  body.name = shell.name;
  body.order = 2;
  body.midsurface = shell.midsurface.transpose();
  body.director = shell.directors.transpose();
  body.thickness = shell.thickness;
  body.cells.resize(9, shell.cells.rows());
  for (Eigen::Index cell = 0; cell < shell.cells.rows(); ++cell)
    for (int k = 0; k < 9; ++k)
      body.cells(k, cell) = shell.cells(cell, fe_q2_from_vtk[k]);
  return body;
}

Eigen::Matrix3Xd averaged_normals(const ShellBody &body)
{
  const ShellReferenceCell reference(body.order);
  const ShapeTable &nodes = reference.samplings[3].shape;
  Eigen::Matrix3Xd normals = Eigen::Matrix3Xd::Zero(3, body.n_nodes());
  for (int cell = 0; cell < body.n_cells(); ++cell)
  {
    const Eigen::Matrix3Xd r = body.midsurface(Eigen::all, body.cells.col(cell));
    const Eigen::Matrix3Xd first = r * nodes.d1, second = r * nodes.d2;
    for (int k = 0; k < reference.n_nodes; ++k)
    {
      const Eigen::Vector3d normal = first.col(k).cross(second.col(k));
      normals.col(body.cells(k, cell)) += normal.normalized();
    }
  }
  normals.colwise().normalize();
  return normals;
}
} // namespace pelvireg::reference_fe
