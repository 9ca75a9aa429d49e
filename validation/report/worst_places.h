// Where on the organs the nominal runs are farthest from the truth.
#pragma once

#include "validation/report/nominal_surfaces.h"

#include <string>
#include <vector>

namespace pelvireg::report
{
/// A surface sample of the judge at the last step.
struct WorstPlace
{
  std::string condition, organ;
  double error = 0;                                   ///< mm, to the closest triangle of the estimate
  Eigen::Vector3d position = Eigen::Vector3d::Zero(); ///< mm, in the truth at the last increment
  double offset = 0;                                  ///< mm from the DYN plane, positive to the left
};

/// Of each condition the five worst samples over all organs that are at least 10 mm apart from each other, worst first.
/// The first of an organ is the max_mm of errors_by_step.csv at the last step of sample 0.
std::vector<WorstPlace> worst_places(const ReportInputs &inputs, const std::vector<MovingSurface> &truth,
                                     const std::vector<ConditionSurfaces> &conditions);
} // namespace pelvireg::report
