// A comparison as a page for the eye.
#pragma once

#include "validation/regression/compare.h"

#include <string>

namespace pelvireg::regression
{
/// One HTML file that needs nothing beside it: verdict, table, and of every family both curves with the runs' standard
/// deviation and the ratio with its simultaneous band. Families that pass are folded away. No script, no request; names
/// are escaped.
std::string comparison_page(const Comparison &comparison, const Rule &rule = {});
} // namespace pelvireg::regression
