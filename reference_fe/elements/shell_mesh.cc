#include "reference_fe/elements/shell_mesh.h"

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/mapping_q.h>

#include <vector>

namespace pelvireg::reference_fe
{
ShellBody shell_body(const dealii::Triangulation<2, 3> &triangulation, const std::string &name, int order,
                     double thickness, const std::function<Eigen::Vector3d(const Eigen::Vector3d &)> &map)
{
  const dealii::FE_Q<2, 3> element(order);
  const dealii::MappingQ<2, 3> mapping(order);
  dealii::DoFHandler<2, 3> dof_handler(triangulation);
  dof_handler.distribute_dofs(element);
  std::vector<dealii::Point<3>> support(dof_handler.n_dofs());
  dealii::DoFTools::map_dofs_to_support_points(mapping, dof_handler, support);

  ShellBody body;
  body.name = name;
  body.order = order;
  body.midsurface.resize(3, support.size());
  for (std::size_t node = 0; node < support.size(); ++node)
  {
    const Eigen::Vector3d point(support[node][0], support[node][1], support[node][2]);
    body.midsurface.col(node) = map ? map(point) : point;
  }
  body.thickness = Eigen::VectorXd::Constant(support.size(), thickness);

  body.cells.resize(element.n_dofs_per_cell(), triangulation.n_active_cells());
  std::vector<dealii::types::global_dof_index> dofs(element.n_dofs_per_cell());
  int index = 0;
  for (const auto &cell : dof_handler.active_cell_iterators())
  {
    cell->get_dof_indices(dofs);
    for (std::size_t k = 0; k < dofs.size(); ++k)
      body.cells(k, index) = static_cast<int>(dofs[k]);
    ++index;
  }
  body.director = averaged_normals(body);
  return body;
}
} // namespace pelvireg::reference_fe
