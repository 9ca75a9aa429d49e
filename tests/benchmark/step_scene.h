// Scenes that other programs can run too: a folder with one legacy-VTK tetrahedral mesh a body (mm) and scene.json.
#pragma once

#include "registration/registration.h"

#include <string>

namespace pelvireg::bench
{
/// Bilateral rows only: every attached node is pulled to a point in space. 0.05 kg a body, spread by volume. Throws
/// std::runtime_error with one sentence for a file that is missing or is not what is expected.
registration::Model read_step_scene(const std::string &folder);

/// h = 0.02 s, exact rows, at most 100 sweeps to 1e-6 mm.
registration::Options step_scene_options();
} // namespace pelvireg::bench
