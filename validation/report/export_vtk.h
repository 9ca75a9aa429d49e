// VTK XML files of a result, for ParaView and 3D Slicer.
#pragma once

#include "synthetic/dataset/anatomy.h"
#include "synthetic/dataset/estimate.h"
#include "synthetic/dataset/observations.h"
#include "synthetic/dataset/truth.h"

#include <filesystem>
#include <vector>

namespace pelvireg::report
{
/// Write into `folder` (made when missing); every file carries the field data units = "mm" and SPACE = "LPS":
///   truth/<part>_<increment>.vtp + truth.pvd     deformed outer surfaces: displacement (mm), region, organ;
///                                                bars as lines: group, stretch; increment 0 is rest
///   <condition>/<organ>_<step>.vtp + <condition>.pvd   sample 0: displacement (mm), region, organ, and error_mm
///                                                (distance to the closest triangle of the truth at that step)
///   contours/…_<increment>.vtp, slices/…_<k>.vtp + contours.pvd, slices.pvd
///   supports.vtu                                 hexahedral ligaments and fasciae of the registration at rest
/// The time of a .pvd is the increment for truth and contours, step / (steps per increment) for estimates and the
/// slice's index for slices. Same input, same bytes. Throws std::runtime_error when a file cannot be written.
void export_vtk(const dataset::Anatomy &anatomy, const dataset::Truth &truth, const dataset::Observations &observations,
                const std::vector<dataset::Estimate> &estimates, const std::filesystem::path &folder);
} // namespace pelvireg::report
