// Our types as VTK data sets. Only for the files that draw or export.
#pragma once

#include "synthetic/dataset/anatomy.h"

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <string>
#include <utility>
#include <vector>

namespace pelvireg::report
{
/// Points in double precision.
vtkSmartPointer<vtkPoints> to_vtk(const dataset::Points &points);

/// Triangles at `positions` (n x 3, mm), with the cell array "region".
vtkSmartPointer<vtkPolyData> to_vtk(const dataset::Points &positions, const dataset::Triangles &triangles,
                                    const dataset::Integers &region);

/// Bars from a to b, mm.
vtkSmartPointer<vtkPolyData> to_vtk(const std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> &bars);

/// Closed polylines, with the cell array "region" by segment: one line cell a segment.
vtkSmartPointer<vtkPolyData> to_vtk(const std::vector<dataset::Contour> &contours);

/// Point array `name` of 1 or 3 components (columns of `values`), double.
void add_point_array(vtkDataSet *data, const std::string &name, const Eigen::MatrixXd &values);

/// The outer surface of a reference shell (mid-surface + half the thickness along the director), eight triangles a
/// cell, not closed at the rims.
dataset::SurfaceMesh outer_surface(const dataset::ReferenceShell &shell);

/// The reference's bars at rest, in the order of the model, with their groups.
std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> bars_at_rest(const dataset::ReferenceModel &model);
} // namespace pelvireg::report
