// Error curves as errors_by_step.csv and errors_by_slice.csv hold them (DESIGN 4).
#pragma once

#include <compare>
#include <map>
#include <string>
#include <vector>

namespace pelvireg::regression
{
enum class Axis
{
  step,
  slice
};

/// "step", "slice"
std::string to_string(Axis axis);

/// Errors at one step or in one slice of one run; mm.
struct CurvePoint
{
  int abscissa = 0;  ///< step, 1-based, or slice index
  double offset = 0; ///< mm, of a slice from the DYN plane; 0 of a step
  int n_points = 0;
  double mean = 0, sd = 0, p95 = 0, max = 0;
};

/// Of one run; abscissae ascend.
using Curve = std::vector<CurvePoint>;

/// The runs of one condition, organ and axis are one family of curves.
struct FamilyName
{
  std::string condition, organ;
  Axis axis = Axis::step;
  auto operator<=>(const FamilyName &) const = default;
};

using Family = std::map<int, Curve>; ///< by sample; 0 is the nominal run
using Curves = std::map<FamilyName, Family>;

/// Read one of the two files. `name` is said in messages. Throws InputError, one sentence with the line, for another
/// header, a row with other fields, a number that is not finite, negative or not a number, no points, a mean or 95th
/// percentile above the maximum, a repeated row, a step left out, and for a file without rows.
Curves read_curves(const std::string &text, Axis axis, const std::string &name);
} // namespace pelvireg::regression
