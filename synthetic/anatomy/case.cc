#include "synthetic/anatomy/case.h"

#include "synthetic/anatomy/built_in_cases.h"
#include "synthetic/anatomy/parameters.h"
#include "synthetic/anatomy/reference_parts.h"
#include "synthetic/anatomy/registration_bodies.h"
#include "synthetic/anatomy/separation.h"
#include "synthetic/dataset/error.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>

namespace pelvireg::anatomy
{
namespace
{
/// Tilted about the cranio-caudal axis, `offset` mm to the left of the midline at the centre.
dataset::Plane dyn_plane(const Parameters &p)
{
  const double tilt = p.plane_tilt * std::numbers::pi / 180;
  dataset::Plane plane;
  plane.normal = {std::cos(tilt), std::sin(tilt), 0};
  plane.origin = p.plane_centre + Eigen::Vector3d(p.plane_offset, 0, 0);
  return plane;
}
} // namespace

std::vector<CaseSummary> built_in_cases()
{
  std::vector<CaseSummary> cases;
  for (const BuiltInCase &built_in : built_in_case_texts())
    cases.push_back(
        {built_in.name, read_parameters(with_base(built_in.text, built_in.name), built_in.name).description});
  return cases;
}

std::string case_text(const std::string &name_or_path)
{
  std::string names;
  for (const BuiltInCase &built_in : built_in_case_texts())
  {
    if (built_in.name == name_or_path)
      return with_base(built_in.text, built_in.name);
    names += (names.empty() ? "" : ", ") + std::string(built_in.name);
  }
  if (!name_or_path.ends_with(".toml"))
    throw InputError(
        fmt::format("There is no case '{}'; give one of {} or a path to a .toml file.", name_or_path, names));
  std::ifstream file(name_or_path, std::ios::binary);
  std::ostringstream text;
  if (!std::filesystem::is_regular_file(name_or_path) || !(text << file.rdbuf()))
    throw InputError(
        fmt::format("The case file '{}' cannot be read; check that it exists and may be read, or give one of {}.",
                    name_or_path, names));
  return with_base(text.str(), name_or_path);
}

dataset::Anatomy build_anatomy(const std::string &text, const std::string &case_name)
{
  const Parameters p = read_parameters(text, case_name);
  check_separation(p);
  dataset::Anatomy anatomy;
  anatomy.case_name = p.name;
  anatomy.dyn_plane = dyn_plane(p);
  anatomy.n_control_points = p.n_control_points;
  anatomy.slice_pitch = p.slice_pitch;
  anatomy.n_slices_each_side = p.n_slices_each_side;
  anatomy.registration_steps_per_increment = p.steps_per_increment;
  anatomy.registration_time_step = p.time_step;
  anatomy.registration_friction = p.friction_coefficient;
  anatomy.reference = make_reference(p);
  anatomy.registration = make_registration(p);
  return anatomy;
}
} // namespace pelvireg::anatomy
