// How exact the truth is, in the report.
#pragma once

#include "synthetic/dataset/truth.h"

#include <string>

namespace pelvireg::report
{
/// Error bar of the mesh, balances of energy and forces, penetration, fluids; what a truth does not know is said.
std::string truth_quality_html(const dataset::Truth &truth);
} // namespace pelvireg::report
