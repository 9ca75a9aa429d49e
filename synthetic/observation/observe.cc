#include "synthetic/observation/observe.h"

#include "synthetic/dataset/error.h"
#include "synthetic/observation/control_points.h"
#include "synthetic/observation/plane_intersection.h"

#include <algorithm>

namespace pelvireg::observation
{
namespace
{
using namespace dataset;

const TruthSurface &organ_surface(const Truth &truth, const std::string &organ)
{
  const auto found = std::find_if(truth.surfaces.begin(), truth.surfaces.end(),
                                  [&](const TruthSurface &surface) { return surface.name == organ; });
  if (found == truth.surfaces.end())
    throw InputError("The truth of case " + truth.case_name + " has no surface " + organ +
                     ", but bladder, vagina, uterus and rectum are observed; run `pelvireg reference` again.");
  if (found->displacements.size() != truth.increments.size())
    throw InputError("The truth's surface " + organ + " has " + std::to_string(found->displacements.size()) +
                     " displacement fields for " + std::to_string(truth.increments.size()) +
                     " increments; run `pelvireg reference` again.");
  return *found;
}

void check(const Anatomy &anatomy, const Truth &truth)
{
  if (anatomy.case_name != truth.case_name)
    throw InputError("The anatomy is of case " + anatomy.case_name + " and the truth of case " + truth.case_name +
                     ": they must be of one case; run `pelvireg reference` in this directory again.");
  if (anatomy.control_point_spacing <= 0 && anatomy.n_control_points < 1)
    throw InputError("The anatomy wants " + std::to_string(anatomy.n_control_points) +
                     " control points, but at least 1 is needed; set n_control_points in the case.");
}

/// increment 0 is the rest shape.
OrganSection section_of(const TruthSurface &surface, std::size_t increment, const Plane &plane)
{
  OrganSection section{surface.rest, {}};
  if (increment > 0)
    section.surface.points += surface.displacements[increment - 1];
  section.loops = intersect(section.surface, plane, surface.name);
  return section;
}

std::vector<OrganSection> sections_of(const Truth &truth, std::size_t increment, const Plane &plane)
{
  std::vector<OrganSection> sections;
  for (const std::string &organ : organ_names)
    sections.push_back(section_of(organ_surface(truth, organ), increment, plane));
  return sections;
}

std::vector<OrganOutline> outlines_of(const std::vector<OrganSection> &sections)
{
  std::vector<OrganOutline> outlines;
  for (std::size_t i = 0; i < sections.size(); ++i)
  {
    outlines.push_back({organ_names[i], {}});
    for (const PlaneLoop &loop : sections[i].loops)
      outlines.back().contours.push_back(loop.contour);
  }
  return outlines;
}

DynamicFrame frame_of(const std::vector<OrganSection> &sections, const ControlPointLayout &layout,
                      std::size_t increment)
{
  DynamicFrame frame;
  frame.increment = static_cast<int>(increment);
  frame.outlines = outlines_of(sections);
  for (std::size_t organ = 0; organ < sections.size(); ++organ)
  {
    const ControlPoints placed = layout.place(organ, sections[organ]);
    frame.control_points.push_back(placed.points);
    frame.control_point_normals.push_back(placed.normals);
  }
  return frame;
}

Plane slice_plane(const Anatomy &anatomy, int k)
{
  Plane plane = anatomy.dyn_plane;
  plane.origin += k * anatomy.slice_pitch * plane.normal;
  return plane;
}
} // namespace

Observations observe(const Anatomy &anatomy, const Truth &truth)
{
  check(anatomy, truth);
  Observations observations;
  observations.case_name = anatomy.case_name;
  observations.dyn_plane = anatomy.dyn_plane;

  const auto rest = sections_of(truth, 0, anatomy.dyn_plane);
  const ControlPointLayout layout(rest, anatomy.n_control_points, anatomy.control_point_spacing);
  observations.rest = frame_of(rest, layout, 0);

  const std::size_t n_increments = truth.increments.size();
  for (std::size_t k = 1; k <= n_increments; ++k)
    observations.frames.push_back(frame_of(sections_of(truth, k, anatomy.dyn_plane), layout, k));

  for (int k = -anatomy.n_slices_each_side; k <= anatomy.n_slices_each_side; ++k)
  {
    const Plane plane = slice_plane(anatomy, k);
    observations.slices.push_back({k, plane, outlines_of(sections_of(truth, n_increments, plane))});
  }
  return observations;
}
} // namespace pelvireg::observation
