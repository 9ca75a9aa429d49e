// The final state as glTF, for viewers and slides.
#pragma once

#include "synthetic/dataset/anatomy.h"
#include "synthetic/dataset/estimate.h"
#include "synthetic/dataset/truth.h"

#include <filesystem>
#include <vector>

namespace pelvireg::report
{
/// Write into `folder` (made when missing), each with one mesh an organ, called by its name, and the mesh
/// `image_plane`:
///   LABEL.glb  for every estimate: its first run's organs at the last step, coloured by the distance of each point to
///              the truth's surface (viridis, 0 … error_scale), which is the attribute `_ERROR_MM` too; caps grey
///   truth.glb  the truth's organs and pelvic floor at the last increment
/// Frame and unit as glb() says. Same input, same bytes. An estimate without runs is left out. Throws
/// std::runtime_error when a file cannot be written.
void export_gltf(const dataset::Anatomy &anatomy, const dataset::Truth &truth,
                 const std::vector<dataset::Estimate> &estimates, const std::filesystem::path &folder);
} // namespace pelvireg::report
