// A second method for every figure of the judge, of other authors: VTK's cell locator and cutter.
#include "tests/unit/validation/fixtures/shapes.h"
#include "validation/metrics/contour_distance.h"
#include "validation/metrics/enclosed_volume.h"
#include "validation/metrics/inside_intervals.h"
#include "validation/metrics/surface_distance.h"
#include "validation/metrics/surface_samples.h"

#include <gtest/gtest.h>

#include <vtkCellArray.h>
#include <vtkCutter.h>
#include <vtkImplicitPolyDataDistance.h>
#include <vtkMassProperties.h>
#include <vtkNew.h>
#include <vtkPlane.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStaticCellLocator.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pelvireg::metrics
{
namespace
{
using dataset::Plane;
using dataset::Points;
using dataset::SurfaceMesh;

/// An ellipsoid with bumps that no symmetry explains.
SurfaceMesh bumpy_organ(double phase)
{
  SurfaceMesh mesh = test::ellipsoid({3, -5, 40}, {32, 24, 17}, 4);
  for (Eigen::Index i = 0; i < mesh.points.rows(); ++i)
  {
    const Eigen::RowVector3d p = mesh.points.row(i);
    mesh.points.row(i) += Eigen::RowVector3d(2 * std::sin(0.2 * p.y() + phase), 1.5 * std::sin(0.3 * p.z() - phase),
                                             2.5 * std::cos(0.15 * p.x() + 2 * phase));
  }
  return mesh;
}

vtkNew<vtkPolyData> to_vtk(const SurfaceMesh &mesh)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (Eigen::Index i = 0; i < mesh.points.rows(); ++i)
    points->InsertNextPoint(mesh.points(i, 0), mesh.points(i, 1), mesh.points(i, 2));
  vtkNew<vtkCellArray> cells;
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t)
  {
    const vtkIdType nodes[3] = {mesh.triangles(t, 0), mesh.triangles(t, 1), mesh.triangles(t, 2)};
    cells->InsertNextCell(3, nodes);
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(cells);
  return data;
}

double cell_locator_distance(vtkStaticCellLocator *locator, const Eigen::Vector3d &p)
{
  double closest[3], squared_distance = 0;
  vtkIdType cell = 0;
  int sub_cell = 0;
  locator->FindClosestPoint(p.data(), closest, cell, sub_cell, squared_distance);
  return std::sqrt(squared_distance);
}

TEST(SurfaceDistance, AgreesWithVtkCellLocatorAndImplicitDistance)
{
  const SurfaceMesh truth = bumpy_organ(0), estimate = bumpy_organ(0.4);
  const auto data = to_vtk(estimate);
  vtkNew<vtkStaticCellLocator> locator;
  locator->SetDataSet(data);
  locator->BuildLocator();
  vtkNew<vtkImplicitPolyDataDistance> implicit_distance;
  implicit_distance->SetInput(data);

  const Points samples = sample_positions(sample_surface(truth, 5), truth.triangles, truth.points);
  const auto distances = surface_distances(samples, estimate.points, estimate.triangles, estimate.region);
  ASSERT_GE(distances.size(), 250u);
  for (std::size_t i = 0; i < distances.size(); ++i)
  {
    Eigen::Vector3d p = samples.row(static_cast<Eigen::Index>(i)); // VTK takes no const
    EXPECT_NEAR(distances[i], cell_locator_distance(locator, p), 1e-9);
    EXPECT_NEAR(distances[i], std::abs(implicit_distance->EvaluateFunction(p.data())), 1e-9);
  }
}

TEST(EnclosedVolume, AgreesWithVtkMassProperties)
{
  for (const double phase : {0.0, 0.4, 2.0})
  {
    const SurfaceMesh organ = bumpy_organ(phase);
    vtkNew<vtkMassProperties> properties;
    properties->SetInputData(to_vtk(organ));
    properties->Update();
    EXPECT_NEAR(enclosed_volume(organ.points, organ.triangles) / properties->GetVolume(), 1, 1e-9);
    EXPECT_NEAR(InsideIntervals(organ.points, organ.triangles, 1).volume() / properties->GetVolume(), 1, 1e-3);
  }
}

/// Segments of vtkCutter: pairs of points.
std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> vtk_cut(const SurfaceMesh &mesh, const Plane &plane)
{
  vtkNew<vtkPlane> function;
  function->SetOrigin(plane.origin.data());
  function->SetNormal(plane.normal.data());
  vtkNew<vtkCutter> cutter;
  cutter->SetInputData(to_vtk(mesh));
  cutter->SetCutFunction(function);
  cutter->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  cutter->Update();
  std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> segments;
  vtkPolyData *output = cutter->GetOutput();
  vtkNew<vtkIdList> ids;
  for (output->GetLines()->InitTraversal(); output->GetLines()->GetNextCell(ids);)
  {
    Eigen::Vector3d a, b;
    output->GetPoint(ids->GetId(0), a.data());
    output->GetPoint(ids->GetId(1), b.data());
    segments.emplace_back(a, b);
  }
  return segments;
}

double distance_to_segments(const Eigen::Vector3d &p,
                            const std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> &segments)
{
  double best = std::numeric_limits<double>::infinity();
  for (const auto &[a, b] : segments)
  {
    // Written out here, so that the judge's own closest point is not its own witness.
    const double t = std::min(1.0, std::max(0.0, (p - a).dot(b - a) / (b - a).squaredNorm()));
    best = std::min(best, (p - a - t * (b - a)).norm());
  }
  return best;
}

TEST(PlaneCut, AgreesWithVtkCutterOnEverySlice)
{
  const SurfaceMesh truth = bumpy_organ(0), estimate = bumpy_organ(0.4);
  const Plane dyn{{3, 0, 0}, Eigen::Vector3d(1, 0.04, -0.03).normalized()};
  int n_slices = 0;
  for (int k = -5; k <= 5; ++k)
  {
    const Plane plane = slice_plane(dyn, k, 6);
    const auto ours = cut_surface(truth.points, truth.triangles, truth.region, plane);
    const auto theirs = vtk_cut(truth, plane);
    ASSERT_EQ(ours.size(), theirs.size()) << "slice " << k;
    double length = 0;
    for (const auto &[a, b] : theirs)
      length += (b - a).norm();
    EXPECT_NEAR(contour_length(ours), length, 1e-9);
    if (ours.empty())
      continue;
    ++n_slices;

    const auto estimate_cut = cut_surface(estimate.points, estimate.triangles, estimate.region, plane);
    const auto distances = contour_distances(ours, estimate_cut, 1.0);
    const Points samples = sample_contour(ours, 1.0);
    const auto estimate_by_vtk = vtk_cut(estimate, plane);
    for (Eigen::Index i = 0; i < samples.rows(); ++i)
    {
      EXPECT_LE(distance_to_segments(samples.row(i), theirs), 1e-9);
      EXPECT_NEAR(distances[static_cast<std::size_t>(i)], distance_to_segments(samples.row(i), estimate_by_vtk), 1e-9);
    }
  }
  EXPECT_GE(n_slices, 9);
}
} // namespace
} // namespace pelvireg::metrics
