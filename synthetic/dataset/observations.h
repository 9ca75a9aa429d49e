// observations.h5: what a clinic would have seen of the truth.
#pragma once

#include "synthetic/dataset/geometry.h"

#include <filesystem>
#include <string>
#include <vector>

namespace pelvireg::dataset
{
/// One organ in one plane at one instant.
struct OrganOutline
{
  std::string organ;
  std::vector<Contour> contours; ///< exact intersection; empty where the plane misses the organ
};

/// The organs in the DYN plane at one increment.
struct DynamicFrame
{
  int increment = 0; ///< 1-based; 0 is the rest state
  std::vector<OrganOutline> outlines;        ///< organ_names in order
  std::vector<Points> control_points;        ///< per organ: k x 3, mm, in the plane
  std::vector<Points> control_point_normals; ///< per organ: k x 3, unit, in the plane, outward
};

/// One validation slice at the last increment (never scored: the judge cuts its own).
struct ValidationSlice
{
  int index = 0; ///< -7 … 7
  Plane plane;
  std::vector<OrganOutline> outlines; ///< organ_names in order
};

/// Content of observations.h5.
struct Observations
{
  std::string case_name;
  Plane dyn_plane;
  DynamicFrame rest;                ///< increment 0
  std::vector<DynamicFrame> frames; ///< one an increment
  std::vector<ValidationSlice> slices;
};

void save(const Observations &observations, const std::filesystem::path &file);
Observations load_observations(const std::filesystem::path &file);
} // namespace pelvireg::dataset
