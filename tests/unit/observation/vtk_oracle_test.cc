// vtkCutter and vtkStripper as an independent second method.
#include "synthetic/observation/plane_intersection.h"
#include "tests/unit/observation/surfaces.h"

#include <gtest/gtest.h>

#include <vtkCellArray.h>
#include <vtkCutter.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPlane.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStripper.h>

#include <algorithm>

namespace pelvireg::observation
{
namespace
{
using namespace test;
using dataset::Plane;

using Segment = std::pair<Vector3d, Vector3d>;

vtkNew<vtkPolyData> to_vtk(const dataset::SurfaceMesh &mesh)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (Eigen::Index i = 0; i < mesh.points.rows(); ++i)
    points->InsertNextPoint(mesh.points(i, 0), mesh.points(i, 1), mesh.points(i, 2));
  vtkNew<vtkCellArray> triangles;
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t)
    triangles->InsertNextCell({mesh.triangles(t, 0), mesh.triangles(t, 1), mesh.triangles(t, 2)});
  vtkNew<vtkPolyData> surface;
  surface->SetPoints(points);
  surface->SetPolys(triangles);
  return surface;
}

/// One line a cut triangle, or joined by vtkStripper.
std::vector<std::vector<Vector3d>> cut_by_vtk(const dataset::SurfaceMesh &mesh, const Plane &plane, bool joined)
{
  vtkNew<vtkPlane> vtk_plane;
  vtk_plane->SetOrigin(plane.origin.data());
  vtk_plane->SetNormal(plane.normal.data());
  vtkNew<vtkCutter> cutter;
  cutter->SetCutFunction(vtk_plane);
  cutter->SetInputData(to_vtk(mesh));
  cutter->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  vtkNew<vtkStripper> stripper;
  stripper->SetInputConnection(cutter->GetOutputPort());
  stripper->JoinContiguousSegmentsOn();
  stripper->SetMaximumLength(1000000);
  stripper->Update();

  vtkPolyData *output = joined ? stripper->GetOutput() : cutter->GetOutput();
  std::vector<std::vector<Vector3d>> lines;
  vtkNew<vtkIdList> ids;
  for (output->GetLines()->InitTraversal(); output->GetLines()->GetNextCell(ids);)
  {
    lines.emplace_back();
    for (vtkIdType i = 0; i < ids->GetNumberOfIds(); ++i)
      lines.back().emplace_back(output->GetPoint(ids->GetId(i)));
  }
  return lines;
}

std::vector<std::vector<Vector3d>> cut_by_us(const dataset::SurfaceMesh &mesh, const Plane &plane)
{
  std::vector<std::vector<Vector3d>> lines;
  for (const PlaneLoop &loop : intersect(mesh, plane, "surface"))
  {
    lines.emplace_back();
    for (Eigen::Index i = 0; i <= loop.contour.points.rows(); ++i)
      lines.back().emplace_back(loop.contour.points.row(i % loop.contour.points.rows()));
  }
  return lines;
}

struct Cut
{
  std::vector<Vector3d> end_points;
  double length = 0, signed_area = 0, area = 0; ///< area: sum of the absolute areas of the lines
};

/// Segments without length and pairs that run there and back (a touched edge) are no outline.
std::vector<Segment> outline_segments(const std::vector<std::vector<Vector3d>> &lines)
{
  std::vector<Segment> segments;
  for (const auto &line : lines)
    for (std::size_t i = 0; i + 1 < line.size(); ++i)
      if ((line[i + 1] - line[i]).norm() > merge_distance)
      {
        const auto back = std::find_if(segments.begin(), segments.end(),
                                       [&](const Segment &other) {
                                         return (other.first - line[i + 1]).norm() <= merge_distance &&
                                                (other.second - line[i]).norm() <= merge_distance;
                                       });
        if (back == segments.end())
          segments.emplace_back(line[i], line[i + 1]);
        else
          segments.erase(back);
      }
  return segments;
}

Cut measure(const std::vector<std::vector<Vector3d>> &lines, const Plane &plane)
{
  Cut cut;
  for (const auto &line : lines)
  {
    double area = 0;
    for (std::size_t i = 0; i + 1 < line.size(); ++i)
      area += 0.5 * (line[i] - plane.origin).cross(line[i + 1] - plane.origin).dot(plane.normal);
    cut.area += std::abs(area);
  }
  for (const auto &[p, q] : outline_segments(lines))
  {
    cut.length += (q - p).norm();
    cut.signed_area += 0.5 * (p - plane.origin).cross(q - plane.origin).dot(plane.normal);
    cut.end_points.insert(cut.end_points.end(), {p, q});
  }
  return cut;
}

/// Every point of `a` has one of `b` within `tolerance`.
bool covered(const std::vector<Vector3d> &a, const std::vector<Vector3d> &b, double tolerance)
{
  return std::all_of(
      a.begin(), a.end(),
      [&](const Vector3d &p)
      { return std::any_of(b.begin(), b.end(), [&](const Vector3d &q) { return (p - q).norm() <= tolerance; }); });
}

void expect_equal(const dataset::SurfaceMesh &mesh, const Plane &plane, bool joined)
{
  const Cut vtk = measure(cut_by_vtk(mesh, plane, joined), plane), ours = measure(cut_by_us(mesh, plane), plane);
  EXPECT_NEAR(ours.length, vtk.length, 1e-9 * vtk.length);
  if (joined)
  {
    EXPECT_NEAR(ours.area, vtk.area, 1e-9 * vtk.area);
  }
  else
  {
    EXPECT_NEAR(std::abs(ours.signed_area), std::abs(vtk.signed_area), 1e-9 * std::abs(vtk.signed_area) + 1e-9);
  }
  EXPECT_TRUE(covered(ours.end_points, vtk.end_points, 1e-8));
  EXPECT_TRUE(covered(vtk.end_points, ours.end_points, 1e-8));
}

TEST(VtkOracle, random_planes_through_random_deformed_surfaces_give_the_same_outline)
{
  std::mt19937 random(20260101);
  int n_cut = 0;
  for (int trial = 0; trial < 150; ++trial)
  {
    auto mesh = trial % 2 ? torus(30, 11, 48, 20) : sphere(30, 4);
    deform(mesh, random);
    const Plane plane = random_plane(random, 35);
    expect_equal(mesh, plane, true);
    n_cut += !intersect(mesh, plane, "surface").empty();
  }
  EXPECT_GT(n_cut, 100);
}

/// Coordinates rounded to a coarse grid and planes along it: distances are exact, so that vertices, edges and whole
/// triangles lie in the plane to the last bit.
void snap(dataset::SurfaceMesh &mesh, double grid)
{
  mesh.points = (mesh.points / grid).array().round().matrix() * grid;
}

TEST(VtkOracle, planes_through_vertices_edges_and_triangles_give_the_same_outline)
{
  std::mt19937 random(11);
  int n_vertices = 0, n_edges = 0;
  for (int trial = 0; trial < 90; ++trial)
  {
    auto mesh = trial % 2 ? torus(30, 11, 24, 12) : sphere(30, 3);
    deform(mesh, random);
    snap(mesh, trial % 3 == 0 ? 2.0 : 0.25);
    const int axis = trial % 3;
    std::uniform_int_distribution<Eigen::Index> any(0, mesh.points.rows() - 1);
    Plane plane{mesh.points.row(any(random)), Vector3d::Unit(axis)};
    expect_equal(mesh, plane, false);
    for (Eigen::Index i = 0; i < mesh.points.rows(); ++i)
      n_vertices += mesh.points(i, axis) == plane.origin[axis];
    for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t)
      n_edges += mesh.points(mesh.triangles(t, 0), axis) == plane.origin[axis] &&
                 mesh.points(mesh.triangles(t, 1), axis) == plane.origin[axis];
  }
  EXPECT_GT(n_vertices, 200);
  EXPECT_GT(n_edges, 20);
}
} // namespace
} // namespace pelvireg::observation
