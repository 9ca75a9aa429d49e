#include "validation/report/vtk_data.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace pelvireg::report
{
namespace
{
void add_region(vtkDataSet *data, const std::vector<std::int32_t> &region)
{
  vtkNew<vtkIntArray> array;
  array->SetName("region");
  for (const std::int32_t code : region)
    array->InsertNextValue(code);
  data->GetCellData()->AddArray(array);
}

template <class Part> const Part *find_part(const std::vector<Part> &parts, const std::string &name)
{
  const auto found = std::find_if(parts.begin(), parts.end(), [&](const Part &part) { return part.name == name; });
  return found == parts.end() ? nullptr : &*found;
}

Eigen::Vector3d node_of(const dataset::ReferenceModel &model, const std::string &part, std::int32_t node)
{
  if (const auto *shell = find_part(model.shells, part))
    return shell->midsurface.row(node);
  if (const auto *solid = find_part(model.solids, part))
    return solid->points.row(node);
  throw std::runtime_error("A bar of the anatomy hangs on part " + part + ", which does not exist.");
}
} // namespace

vtkSmartPointer<vtkPoints> to_vtk(const dataset::Points &points)
{
  auto result = vtkSmartPointer<vtkPoints>::New();
  result->SetDataTypeToDouble();
  for (Eigen::Index i = 0; i < points.rows(); ++i)
    result->InsertNextPoint(points(i, 0), points(i, 1), points(i, 2));
  return result;
}

vtkSmartPointer<vtkPolyData> to_vtk(const dataset::Points &positions, const dataset::Triangles &triangles,
                                    const dataset::Integers &region)
{
  vtkNew<vtkCellArray> cells;
  for (Eigen::Index t = 0; t < triangles.rows(); ++t)
    cells->InsertNextCell({triangles(t, 0), triangles(t, 1), triangles(t, 2)});
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(to_vtk(positions));
  data->SetPolys(cells);
  if (region.size() == triangles.rows())
    add_region(data, {region.begin(), region.end()});
  return data;
}

vtkSmartPointer<vtkPolyData> to_vtk(const std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> &bars)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> cells;
  for (const auto &[a, b] : bars)
  {
    const vtkIdType first = points->InsertNextPoint(a.data());
    cells->InsertNextCell({first, points->InsertNextPoint(b.data())});
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetLines(cells);
  return data;
}

vtkSmartPointer<vtkPolyData> to_vtk(const std::vector<dataset::Contour> &contours)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> cells;
  std::vector<std::int32_t> region;
  for (const dataset::Contour &contour : contours)
  {
    const vtkIdType first = points->GetNumberOfPoints(), n = contour.points.rows();
    for (vtkIdType i = 0; i < n; ++i)
    {
      points->InsertNextPoint(contour.points(i, 0), contour.points(i, 1), contour.points(i, 2));
      cells->InsertNextCell({first + i, first + (i + 1) % n});
      region.push_back(contour.segment_region[i]);
    }
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetLines(cells);
  add_region(data, region);
  return data;
}

void add_point_array(vtkDataSet *data, const std::string &name, const Eigen::MatrixXd &values)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name.c_str());
  array->SetNumberOfComponents(static_cast<int>(values.cols()));
  array->SetNumberOfTuples(values.rows());
  for (Eigen::Index i = 0; i < values.rows(); ++i)
    for (Eigen::Index j = 0; j < values.cols(); ++j)
      array->SetComponent(i, static_cast<int>(j), values(i, j));
  data->GetPointData()->AddArray(array);
}

dataset::SurfaceMesh outer_surface(const dataset::ReferenceShell &shell)
{
  // a fan round the centre node over the ring of corners and mid-sides
  constexpr std::array<int, 9> ring = {0, 4, 1, 5, 2, 6, 3, 7, 0};
  dataset::SurfaceMesh surface;
  surface.points = shell.midsurface + 0.5 * shell.thickness.asDiagonal() * shell.directors;
  surface.triangles.resize(8 * shell.cells.rows(), 3);
  surface.region.resize(8 * shell.cells.rows());
  for (Eigen::Index c = 0; c < shell.cells.rows(); ++c)
    for (int k = 0; k < 8; ++k)
    {
      surface.triangles.row(8 * c + k) << shell.cells(c, ring[k]), shell.cells(c, ring[k + 1]), shell.cells(c, 8);
      surface.region[8 * c + k] = shell.region.size() > c ? shell.region[c] : 0;
    }
  return surface;
}

std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> bars_at_rest(const dataset::ReferenceModel &model)
{
  std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> bars;
  for (const dataset::ReferenceTruss &truss : model.trusses)
    bars.emplace_back(node_of(model, truss.part_a, truss.node_a),
                      truss.part_b.empty()
                          ? truss.fixed_point
                          : Eigen::Vector3d(node_of(model, truss.part_b, truss.node_b) + truss.offset_b));
  return bars;
}
} // namespace pelvireg::report
