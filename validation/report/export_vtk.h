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
/// Write into `folder` (made when missing). Every file carries the field data units = "mm" and SPACE = "LPS"; surfaces
/// and outlines the cell arrays `region` (SurfaceRegion) and `organ` (index in organ_names, 4: pelvic floor).
///   truth.pvd        deformed outer surfaces with `displacement` (mm); bars with `stretch` and `group`; time =
///   increment,
///                    0 is rest
///   <condition>.pvd  registered outer surfaces of sample 0 with `displacement` and `error_mm` (distance of the point
///   to
///                    the truth's surface at the increment of that step); time = step / (steps per increment)
///   contours.pvd     outlines in the DYN plane, control points with `normal`; time = increment
///   slices.pvd       outlines in the validation slices at the last increment; time = slice index
///   supports/*.vtu   hexahedra of ligaments and fasciae at rest, `fixed` = 1 at their far ends
/// Same input, same bytes. Throws std::runtime_error when a file cannot be written.
void export_vtk(const dataset::Anatomy &anatomy, const dataset::Truth &truth, const dataset::Observations &observations,
                const std::vector<dataset::Estimate> &estimates, const std::filesystem::path &folder);
} // namespace pelvireg::report
