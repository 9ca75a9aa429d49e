// Material points of the truth's surface at which the judge measures.
#pragma once

#include "synthetic/dataset/geometry.h"

#include <vector>

namespace pelvireg::metrics
{
/// A point fixed in the material: it moves with the nodes of its triangle.
struct SurfaceSample
{
  int triangle = 0;                                      ///< 0-based row of SurfaceMesh::triangles
  Eigen::Vector3d barycentric = Eigen::Vector3d::Zero(); ///< weights of the triangle's nodes, >= 0, sum 1
};

/// Even, deterministic samples of a surface: one per spacing^2 of area (the paper's "every 5 mm": one per 25 mm^2),
/// caps excluded (DESIGN 4), every other region included, the cervix patch too ("the complete surface", paper 6.2).
/// Eight times too many candidates, equal areas each, are thinned by removing the most crowded one again and again
/// (sample elimination, Yuksel 2015). Cost grows with the square of the count: made for some hundred samples.
/// Throws InputError for a spacing that is not positive and for a surface without area, an index out of range or a
/// position that is not finite.
std::vector<SurfaceSample> sample_surface(const dataset::SurfaceMesh &rest, double spacing);

/// Where the samples are when the nodes are at `points` (n x 3, mm). Throws InputError when they are not finite.
dataset::Points sample_positions(const std::vector<SurfaceSample> &samples, const dataset::Triangles &triangles,
                                 const dataset::Points &points);
} // namespace pelvireg::metrics
