#include "tests/judge/faults.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <set>
#include <stdexcept>

namespace pelvireg::test
{
namespace
{
void scale(CurvePoint &point, double factor)
{
  point.mean *= factor;
  point.sd *= factor;
  point.p95 *= factor;
  point.max *= factor;
}

std::uint64_t mixed(std::uint64_t z)
{
  z += 0x9E3779B97F4A7C15u;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
  return z ^ (z >> 31);
}

/// A standard normal number (Box and Muller) of a key.
double normal(std::uint64_t key)
{
  const auto unit = [](std::uint64_t word) { return (static_cast<double>(word >> 11) + 0.5) * 0x1.0p-53; };
  return std::sqrt(-2 * std::log(unit(mixed(key)))) *
         std::cos(2 * std::numbers::pi * unit(mixed(key ^ 0x5851F42D4C957F2Du)));
}
} // namespace

std::vector<FamilyName> registered_families(const ErrorResult &result)
{
  std::vector<FamilyName> names;
  for (const auto &[name, family] : result.curves)
    if (name.condition != "unregistered")
      names.push_back(name);
  return names;
}

ErrorResult scaled(ErrorResult result, double factor, const std::function<bool(const FamilyName &)> &takes)
{
  for (auto &[name, family] : result.curves)
    if (name.condition != "unregistered" && takes(name))
      for (auto &[sample, curve] : family)
        for (CurvePoint &point : curve)
          scale(point, factor);
  return result;
}

ErrorResult with_bump(ErrorResult result, const FamilyName &family, std::size_t first, double factor)
{
  // A slice that grazes an organ is missing in some runs: the same place is the same abscissa, not the same position.
  std::set<int> places;
  const Curve nominal = result.curves.at(family).at(0);
  const std::size_t length = std::max<std::size_t>(1, nominal.size() / 10);
  for (std::size_t i = first; i < std::min(first + length, nominal.size()); ++i)
    places.insert(nominal[i].abscissa);
  for (auto &[sample, curve] : result.curves.at(family))
    for (CurvePoint &point : curve)
      if (places.contains(point.abscissa))
        scale(point, factor);
  return result;
}

ErrorResult with_longer_tail(ErrorResult result, const FamilyName &family, double factor)
{
  for (auto &[sample, curve] : result.curves.at(family))
    for (CurvePoint &point : curve)
    {
      point.p95 *= factor;
      point.max *= factor;
    }
  return result;
}

ErrorResult with_nan(ErrorResult result, const FamilyName &family, std::size_t place, double CurvePoint::*figure)
{
  Curve &curve = result.curves.at(family).rbegin()->second;
  curve[place % curve.size()].*figure = std::numeric_limits<double>::quiet_NaN();
  return result;
}

ErrorResult without_organ(ErrorResult result, const std::string &organ)
{
  std::erase_if(result.curves, [&](const auto &entry) { return entry.first.organ == organ; });
  return result;
}

ErrorResult shifted_by_one_step(ErrorResult result, const std::string &organ, bool early)
{
  for (auto &[name, family] : result.curves)
    if (name.condition == "full" && name.axis == regression::Axis::step && name.organ == organ)
      for (auto &[sample, curve] : family)
      {
        const Curve right = curve;
        for (std::size_t i = 1; i < curve.size(); ++i)
        {
          CurvePoint &point = early ? curve[i - 1] : curve[i];
          const int abscissa = point.abscissa;
          point = early ? right[i] : right[i - 1];
          point.abscissa = abscissa;
        }
      }
  return result;
}

ErrorResult with_noise(ErrorResult result, double sd, std::uint64_t seed)
{
  std::uint64_t family_key = mixed(seed);
  for (auto &[name, family] : result.curves)
  {
    family_key = mixed(family_key);
    if (name.condition != "unregistered")
      for (auto &[sample, curve] : family)
      {
        const std::uint64_t key = mixed(family_key ^ mixed(static_cast<std::uint64_t>(sample)));
        for (CurvePoint &point : curve)
          scale(point, std::exp(sd * std::sqrt(0.5) *
                                (normal(key) + normal(key + static_cast<std::uint64_t>(point.abscissa + 1000)))));
      }
  }
  return result;
}

ErrorResult resampled(const ErrorResult &result, const std::vector<int> &chosen)
{
  ErrorResult picked;
  picked.label = result.label;
  picked.case_name = result.case_name;
  picked.case_text = result.case_text;
  picked.surface_spacing = result.surface_spacing;
  picked.contour_spacing = result.contour_spacing;
  for (const auto &[name, all] : result.curves)
  {
    regression::Family &family = picked.curves[name];
    family[0] = all.at(0);
    for (std::size_t i = 0; all.size() > 1 && i < chosen.size(); ++i)
      family[static_cast<int>(i) + 1] = all.at(chosen[i]);
    for (const auto &[sample, curve] : family)
      if (name.condition != "unregistered")
        picked.runs[{name.condition, sample}] =
            result.runs.at({name.condition, sample == 0 ? 0 : chosen[static_cast<std::size_t>(sample) - 1]});
  }
  return picked;
}

ErrorResult first_samples(const ErrorResult &result, int last)
{
  std::vector<int> chosen;
  for (int sample = 1; sample <= last; ++sample)
    chosen.push_back(sample);
  return resampled(result, chosen);
}

regression::Comparison gate(const ErrorResult &baseline, const ErrorResult &current)
{
  return regression::compare({baseline, std::nullopt}, current);
}

const regression::FamilyComparison &family_of(const regression::Comparison &comparison, const FamilyName &name)
{
  for (const regression::FamilyComparison &family : comparison.families)
    if (family.name == name && !family.is_steps)
      return family;
  throw std::out_of_range("the comparison has no family " + name.condition + ", " + name.organ);
}
} // namespace pelvireg::test
