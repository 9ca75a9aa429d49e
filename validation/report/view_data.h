// What the 3-D view draws.
#pragma once

#include "validation/report/nominal_surfaces.h"
#include "validation/report/payload.h"

#include <nlohmann/json_fwd.hpp>

#include <vector>

namespace pelvireg::report
{
/// Description of the view: plane, control points at rest and at each increment, and by condition and organ the nodes
/// of the estimate that attachments hold. What is large goes into parts of the payload. Parts, by organ o and condition
/// c (their places in the lists):
///   truth/o, estimate/c/o         positions at rest and at each increment or step (pack_positions, `quantum_mm`)
///   truth/o/wall, truth/o/caps    triangles that are scored, and the others (pack_indices); estimate/c/o/… likewise
///   error/c/o                     distance of each node of the truth at step s to the estimate at step s (pack_values,
///                                 `error_quantum_mm`), one frame a step
///   error_back/c/o                distance of each node of the estimate to the truth, likewise
///   bars                          ends of the truth's bars at rest and at each increment (`bar_quantum_mm`)
nlohmann::ordered_json view_data(const ReportInputs &inputs, const std::vector<MovingSurface> &truth,
                                 const std::vector<ConditionSurfaces> &conditions, Payload &payload);
} // namespace pelvireg::report
