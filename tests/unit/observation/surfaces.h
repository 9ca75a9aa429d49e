// Closed test surfaces, outward oriented.
#pragma once

#include "synthetic/dataset/geometry.h"

#include <Eigen/Geometry>

#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <vector>

namespace pelvireg::observation::test
{
using Eigen::Vector3d;

inline dataset::SurfaceMesh to_mesh(const std::vector<Vector3d> &points, const std::vector<Eigen::Vector3i> &triangles)
{
  dataset::SurfaceMesh mesh;
  mesh.points.resize(static_cast<Eigen::Index>(points.size()), 3);
  mesh.triangles.resize(static_cast<Eigen::Index>(triangles.size()), 3);
  for (std::size_t i = 0; i < points.size(); ++i)
    mesh.points.row(static_cast<Eigen::Index>(i)) = points[i];
  for (std::size_t i = 0; i < triangles.size(); ++i)
    mesh.triangles.row(static_cast<Eigen::Index>(i)) = triangles[i];
  mesh.region = dataset::Integers::Zero(mesh.triangles.rows());
  return mesh;
}

/// +-x, +-y, +-z at `radius`: every coordinate plane goes through vertices and edges.
inline dataset::SurfaceMesh octahedron(double radius)
{
  const std::vector<Vector3d> points = {{radius, 0, 0},  {-radius, 0, 0}, {0, radius, 0},
                                        {0, -radius, 0}, {0, 0, radius},  {0, 0, -radius}};
  return to_mesh(points, {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}});
}

/// Octahedron divided `level` times into four, projected onto the sphere.
inline dataset::SurfaceMesh sphere(double radius, int level)
{
  dataset::SurfaceMesh mesh = octahedron(radius);
  for (int l = 0; l < level; ++l)
  {
    std::vector<Vector3d> points;
    for (Eigen::Index i = 0; i < mesh.points.rows(); ++i)
      points.push_back(mesh.points.row(i));
    std::map<std::pair<int, int>, int> middle;
    const auto middle_of = [&](int a, int b)
    {
      const auto [place, is_new] = middle.emplace(std::minmax(a, b), static_cast<int>(points.size()));
      if (is_new)
        points.push_back(radius * (points[a] + points[b]).normalized());
      return place->second;
    };
    std::vector<Eigen::Vector3i> triangles;
    for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t)
    {
      const int a = mesh.triangles(t, 0), b = mesh.triangles(t, 1), c = mesh.triangles(t, 2);
      const int ab = middle_of(a, b), bc = middle_of(b, c), ca = middle_of(c, a);
      triangles.insert(triangles.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    mesh = to_mesh(points, triangles);
  }
  return mesh;
}

/// Axis z, radius of the centre line `major`, of the tube `minor`.
inline dataset::SurfaceMesh torus(double major, double minor, int n_around, int n_tube)
{
  std::vector<Vector3d> points;
  std::vector<Eigen::Vector3i> triangles;
  for (int i = 0; i < n_around; ++i)
    for (int j = 0; j < n_tube; ++j)
    {
      const double u = 2 * std::numbers::pi * i / n_around, v = 2 * std::numbers::pi * j / n_tube;
      const double r = major + minor * std::cos(v);
      points.push_back({r * std::cos(u), r * std::sin(u), minor * std::sin(v)});
      const int i2 = (i + 1) % n_around, j2 = (j + 1) % n_tube;
      const int a = i * n_tube + j, b = i2 * n_tube + j, c = i2 * n_tube + j2, d = i * n_tube + j2;
      triangles.insert(triangles.end(), {{a, b, c}, {a, c, d}});
    }
  return to_mesh(points, triangles);
}

/// Tube along z from 0 to `height`, ends closed by fans of region cap: a rectum in miniature.
inline dataset::SurfaceMesh capped_tube(double radius, double height, int n_around, int n_along)
{
  std::vector<Vector3d> points;
  std::vector<Eigen::Vector3i> triangles;
  std::vector<int> region;
  for (int k = 0; k <= n_along; ++k)
    for (int i = 0; i < n_around; ++i)
    {
      const double u = 2 * std::numbers::pi * i / n_around;
      points.push_back({radius * std::cos(u), radius * std::sin(u), height * k / n_along});
      const int a = k * n_around + i, b = k * n_around + (i + 1) % n_around;
      if (k < n_along)
        triangles.insert(triangles.end(), {{a, b, b + n_around}, {a, b + n_around, a + n_around}});
    }
  region.assign(triangles.size(), 0);
  const int bottom = static_cast<int>(points.size()), top = bottom + 1, last = n_along * n_around;
  points.push_back({0, 0, 0});
  points.push_back({0, 0, height});
  for (int i = 0; i < n_around; ++i)
  {
    const int j = (i + 1) % n_around;
    triangles.insert(triangles.end(), {{bottom, j, i}, {top, last + i, last + j}});
    region.insert(region.end(), 2, static_cast<int>(dataset::SurfaceRegion::cap));
  }
  dataset::SurfaceMesh mesh = to_mesh(points, triangles);
  for (std::size_t t = 0; t < region.size(); ++t)
    mesh.region[static_cast<Eigen::Index>(t)] = region[t];
  return mesh;
}

/// A smooth deformation that keeps the surface embedded: affine part and low waves, both random.
inline void deform(dataset::SurfaceMesh &mesh, std::mt19937 &random)
{
  std::uniform_real_distribution<double> uniform(-1, 1);
  Eigen::Matrix3d affine = Eigen::Matrix3d::Identity();
  for (int i = 0; i < 9; ++i)
    affine(i / 3, i % 3) += 0.25 * uniform(random);
  const Vector3d wave(uniform(random), uniform(random), uniform(random));
  const Vector3d amplitude = 3 * Vector3d(uniform(random), uniform(random), uniform(random));
  for (Eigen::Index i = 0; i < mesh.points.rows(); ++i)
  {
    const Vector3d p = mesh.points.row(i);
    mesh.points.row(i) = affine * p + std::sin(0.1 * wave.dot(p)) * amplitude;
  }
}

inline dataset::Plane random_plane(std::mt19937 &random, double extent)
{
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(-extent, extent);
  dataset::Plane plane;
  plane.normal = Vector3d(normal(random), normal(random), normal(random)).normalized();
  plane.origin = uniform(random) * plane.normal;
  return plane;
}
} // namespace pelvireg::observation::test
