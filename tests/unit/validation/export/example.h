// A small result: four octahedra that move, a floor, a bar, one hexahedral support, one estimate off by a known shift.
#pragma once

#include "synthetic/dataset/anatomy.h"
#include "synthetic/dataset/estimate.h"
#include "synthetic/dataset/observations.h"
#include "synthetic/dataset/truth.h"

#include <Eigen/Geometry>

#include <filesystem>
#include <string>

namespace pelvireg::report::test
{
using namespace dataset;

/// Octahedron of radius 20 about (0, 50 i, 0).
inline SurfaceMesh octahedron(int i)
{
  SurfaceMesh mesh;
  mesh.points.resize(6, 3);
  mesh.points << 20, 0, 0, -20, 0, 0, 0, 20, 0, 0, -20, 0, 0, 0, 20, 0, 0, -20;
  mesh.points.col(1).array() += 50.0 * i;
  mesh.triangles.resize(8, 3);
  mesh.triangles << 0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5;
  mesh.region = Integers::Zero(8);
  return mesh;
}

inline Anatomy example_anatomy()
{
  Anatomy anatomy;
  anatomy.case_name = "example";
  for (int i = 0; i < 4; ++i)
  {
    const SurfaceMesh mesh = octahedron(i);
    RegistrationBody body;
    body.name = organ_names[static_cast<std::size_t>(i)];
    body.points = mesh.points;
    body.outer_triangles = mesh.triangles;
    body.outer_region = mesh.region;
    anatomy.registration.bodies.push_back(body);
  }
  RegistrationBody band;
  band.name = "ligaments";
  band.points.resize(8, 3);
  band.points << 0, 0, 0, 10, 0, 0, 10, 10, 0, 0, 10, 0, 0, 0, 10, 10, 0, 10, 10, 10, 10, 0, 10, 10;
  band.hexes.resize(1, 8);
  band.hexes << 0, 1, 2, 3, 4, 5, 6, 7;
  band.fixed_nodes.resize(2);
  band.fixed_nodes << 4, 7;
  anatomy.registration.bodies.push_back(band);
  return anatomy;
}

/// Two increments; the displacement of every organ is (0, 1, -3) mm an increment, the bar is stretched by 1.5 at last.
inline Truth example_truth()
{
  Truth truth;
  truth.case_name = "example";
  truth.increments.resize(2);
  for (int i = 0; i < 5; ++i)
  {
    TruthSurface surface{i < 4 ? organ_names[static_cast<std::size_t>(i)] : "pelvic_floor", octahedron(i), {}};
    for (int k = 1; k <= 2; ++k)
      surface.displacements.push_back(Eigen::RowVector3d(0, k, -3 * k).replicate(6, 1));
    truth.surfaces.push_back(surface);
  }
  TruthTruss truss;
  truss.group = "cardinal_left";
  truss.rest.resize(2, 3);
  truss.rest << 0, 0, 0, 40, 0, 0;
  truss.positions = {truss.rest, truss.rest};
  truss.positions[1](1, 0) = 60;
  truth.trusses.push_back(truss);
  return truth;
}

/// Six steps (three an increment); the last step is the truth shifted by 2 mm along x.
inline Estimate example_estimate()
{
  const Truth truth = example_truth();
  Estimate estimate;
  estimate.case_name = "example";
  estimate.condition = "full";
  estimate.samples.resize(1);
  for (std::size_t i = 0; i < 4; ++i)
  {
    EstimateSurface surface{organ_names[i], truth.surfaces[i].rest, {}};
    for (int step = 1; step <= 6; ++step)
      surface.positions.push_back(surface.rest.points + truth.surfaces[i].displacements[(step - 1) / 3]);
    surface.positions.back().col(0).array() += 2;
    estimate.samples[0].surfaces.push_back(surface);
  }
  return estimate;
}

inline Observations example_observations()
{
  Contour square;
  square.points.resize(4, 3);
  square.points << 0, 20, 0, 0, 0, 20, 0, -20, 0, 0, 0, -20;
  square.segment_normals = Eigen::RowVector3d(0, 0, 1).replicate(4, 1);
  square.segment_region = Integers::Zero(4);
  Observations observations;
  observations.case_name = "example";
  const auto frame_of = [&](int increment)
  {
    DynamicFrame frame;
    frame.increment = increment;
    for (const std::string &organ : organ_names)
    {
      frame.outlines.push_back({organ, {square}});
      frame.control_points.push_back(square.points);
      frame.control_point_normals.push_back(square.segment_normals);
    }
    return frame;
  };
  observations.rest = frame_of(0);
  observations.frames = {frame_of(1), frame_of(2)};
  for (int k = -1; k <= 1; ++k)
    observations.slices.push_back({k, {}, observations.rest.outlines});
  return observations;
}

/// A folder of its own for each test, empty.
inline std::filesystem::path fresh_folder(const std::string &name)
{
  const auto folder = std::filesystem::temp_directory_path() / ("pelvireg_test_" + name);
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}
} // namespace pelvireg::report::test
