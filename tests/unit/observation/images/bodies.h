// Bodies of simple shape and motion.
#pragma once

#include "synthetic/observation/images/tissue_bodies.h"
#include "tests/unit/observation/surfaces.h"

namespace pelvireg::observation::test
{
/// Square image in the plane x = centre.x: columns to the back, rows down.
inline dataset::ImageGeometry sagittal(int size, double pixel, const Vector3d &centre)
{
  dataset::ImageGeometry geometry;
  geometry.columns = geometry.rows = size;
  geometry.spacing = {pixel, pixel};
  geometry.origin = centre - 0.5 * (size - 1) * pixel * (geometry.column_direction + geometry.row_direction);
  return geometry;
}

inline TissueBody body_of(const std::string &name, Tissue tissue, const dataset::SurfaceMesh &rest)
{
  return {name, tissue, rest, {}, {dataset::Points::Zero(rest.points.rows(), 3)}};
}

/// Of muscle, at rest.
inline TissueBody solid_ball(double radius, const Vector3d &centre)
{
  dataset::SurfaceMesh mesh = sphere(radius, 5);
  mesh.points.rowwise() += centre.transpose();
  return body_of("ball", Tissue::floor, mesh);
}

inline TissueBody hollow_ball(Tissue tissue, double radius, double wall, const Vector3d &centre)
{
  TissueBody body = solid_ball(radius, centre);
  body.tissue = tissue;
  body.wall = Eigen::VectorXd::Constant(body.rest.points.rows(), wall);
  return body;
}

/// Of muscle: |x|, |z| < half; y from -half to slope x.
inline TissueBody slanted_block(double half, double slope)
{
  std::vector<Vector3d> points;
  for (const double z : {-half, half})
    for (const double x : {-half, half})
    {
      points.emplace_back(x, -2 * half, z);
      points.emplace_back(x, slope * x, z);
    }
  return body_of("block", Tissue::floor,
                 to_mesh(points, {{0, 1, 3},
                                  {0, 3, 2},
                                  {4, 7, 5},
                                  {4, 6, 7},
                                  {0, 5, 1},
                                  {0, 4, 5},
                                  {2, 3, 7},
                                  {2, 7, 6},
                                  {1, 5, 7},
                                  {1, 7, 3},
                                  {0, 2, 6},
                                  {0, 6, 4}}));
}

/// Adds an increment in which the body lies elsewhere.
inline void translate(TissueBody &body, const Vector3d &motion)
{
  dataset::Points moved(body.rest.points.rows(), 3);
  moved.rowwise() = motion.transpose();
  body.displacements.push_back(moved);
}
} // namespace pelvireg::observation::test
