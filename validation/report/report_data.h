// Everything that the page's script shows, in one text.
#pragma once

#include "validation/report/nominal_surfaces.h"
#include "validation/report/slice_contours.h"
#include "validation/report/worst_places.h"

#include <string>
#include <vector>

namespace pelvireg::report
{
/// Base64 of the page's payload (payload.h): summary.json, curves_by_step.csv, curves_by_slice.csv byte by byte as they
/// lie in the result directory, further metrics by position, contours of the slices, the worst places, and the
/// surfaces of truth and nominal runs at every step with the distance of each node to the other surface.
std::string report_data(const ReportInputs &inputs, const std::vector<MovingSurface> &truth,
                        const std::vector<ConditionSurfaces> &conditions, const SliceDrawing &slices,
                        const std::vector<WorstPlace> &worst);
} // namespace pelvireg::report
