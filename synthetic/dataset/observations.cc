#include "synthetic/dataset/observations.h"

#include "synthetic/dataset/error.h"
#include "synthetic/dataset/store.h"

#include <cmath>
#include <cstdio>

namespace pelvireg::dataset
{
namespace
{
constexpr const char *format = "pelvireg observations";
constexpr int n_regions = 4; // SurfaceRegion

/// The contours of one organ as joined arrays and the first point of each contour.
void write_outline(GroupWriter &group, const OrganOutline &outline)
{
  std::vector<std::int32_t> starts = {0};
  for (const Contour &contour : outline.contours)
    starts.push_back(starts.back() + static_cast<std::int32_t>(contour.points.rows()));
  Contour joined{Points(starts.back(), 3), Points(starts.back(), 3), Integers(starts.back())};
  for (std::size_t i = 0; i < outline.contours.size(); ++i)
  {
    const Contour &contour = outline.contours[i];
    const Eigen::Index size = contour.points.rows();
    if (contour.segment_normals.rows() != size || contour.segment_region.size() != size)
      throw ComputationError("cannot store a contour of '" + outline.organ + "': it has not one normal a segment");
    joined.points.middleRows(starts[i], size) = contour.points;
    joined.segment_normals.middleRows(starts[i], size) = contour.segment_normals;
    joined.segment_region.segment(starts[i], size) = contour.segment_region;
  }
  group.integers("contour_start", starts);
  group.array("points", joined.points);
  group.array("segment_normals", joined.segment_normals);
  group.array("segment_region", joined.segment_region);
}

OrganOutline read_outline(const GroupReader &group, const std::string &organ)
{
  const Points points = group.array<Points>("points");
  const Points normals = group.array<Points>("segment_normals", points.rows());
  const Integers region = group.indices<Integers>("segment_region", n_regions);
  const Integers starts = group.indices<Integers>("contour_start", points.rows() + 1);
  if (region.size() != points.rows())
    group.refuse("segment_region", "has not one entry a segment");
  if (starts.size() == 0 || starts[0] != 0 || starts[starts.size() - 1] != points.rows())
    group.refuse("contour_start", "does not cover the points");
  OrganOutline outline;
  outline.organ = organ;
  for (Eigen::Index i = 0; i + 1 < starts.size(); ++i)
  {
    const Eigen::Index first = starts[i], size = starts[i + 1] - starts[i];
    if (size < 0)
      group.refuse("contour_start", "is not ascending");
    outline.contours.push_back(
        {points.middleRows(first, size), normals.middleRows(first, size), region.segment(first, size)});
  }
  return outline;
}

std::vector<std::string> organs_of(const std::vector<OrganOutline> &outlines)
{
  std::vector<std::string> organs;
  for (const OrganOutline &outline : outlines)
    organs.push_back(outline.organ);
  return organs;
}

void write_frame(GroupWriter group, const DynamicFrame &frame)
{
  if (frame.control_points.size() != frame.outlines.size() ||
      frame.control_point_normals.size() != frame.outlines.size())
    throw ComputationError("cannot store increment " + std::to_string(frame.increment) +
                           ": it has not one set of control points an organ");
  group.integer("increment", frame.increment);
  group.texts("organs", organs_of(frame.outlines));
  for (std::size_t i = 0; i < frame.outlines.size(); ++i)
  {
    GroupWriter organ = group.group(frame.outlines[i].organ);
    write_outline(organ, frame.outlines[i]);
    organ.array("control_points", frame.control_points[i]);
    organ.array("control_point_normals", frame.control_point_normals[i]);
  }
}

DynamicFrame read_frame(const GroupReader &group)
{
  DynamicFrame frame;
  frame.increment = group.integer("increment");
  for (const std::string &name : group.texts("organs"))
  {
    const GroupReader organ = group.group(name);
    frame.outlines.push_back(read_outline(organ, name));
    frame.control_points.push_back(organ.array<Points>("control_points"));
    frame.control_point_normals.push_back(
        organ.array<Points>("control_point_normals", frame.control_points.back().rows()));
  }
  return frame;
}

void write_slice(GroupWriter group, const ValidationSlice &slice)
{
  group.integer("index", slice.index);
  group.texts("organs", organs_of(slice.outlines));
  write_plane(group, "plane", slice.plane);
  GroupWriter outlines = group.group("outlines");
  for (const OrganOutline &outline : slice.outlines)
  {
    GroupWriter organ = outlines.group(outline.organ);
    write_outline(organ, outline);
  }
}

ValidationSlice read_slice(const GroupReader &group)
{
  ValidationSlice slice;
  slice.index = group.integer("index");
  slice.plane = read_plane(group, "plane");
  const GroupReader outlines = group.group("outlines");
  for (const std::string &organ : group.texts("organs"))
    slice.outlines.push_back(read_outline(outlines.group(organ), organ));
  return slice;
}

/// Three digits, so that file viewers list the groups in order.
std::string numbered(std::size_t index)
{
  char name[24];
  std::snprintf(name, sizeof name, "%03zu", index);
  return name;
}
} // namespace

void save(const Observations &observations, const std::filesystem::path &file)
{
  StoreWriter writer(file, format);
  GroupWriter &root = writer.root();
  root.text("case_name", observations.case_name);
  root.integer("n_frames", static_cast<std::int32_t>(observations.frames.size()));
  root.integer("n_slices", static_cast<std::int32_t>(observations.slices.size()));
  write_plane(root, "dyn_plane", observations.dyn_plane);
  write_frame(root.group("rest"), observations.rest);
  GroupWriter frames = root.group("frames");
  for (std::size_t i = 0; i < observations.frames.size(); ++i)
    write_frame(frames.group(numbered(i)), observations.frames[i]);
  GroupWriter slices = root.group("slices");
  for (std::size_t i = 0; i < observations.slices.size(); ++i)
    write_slice(slices.group(numbered(i)), observations.slices[i]);
  writer.finish();
}

Observations load_observations(const std::filesystem::path &file)
{
  const StoreReader reader(file, format);
  const GroupReader &root = reader.root();
  Observations observations;
  observations.case_name = root.text("case_name");
  observations.dyn_plane = read_plane(root, "dyn_plane");
  observations.rest = read_frame(root.group("rest"));
  const GroupReader frames = root.group("frames");
  for (int i = 0; i < root.integer("n_frames"); ++i)
    observations.frames.push_back(read_frame(frames.group(numbered(static_cast<std::size_t>(i)))));
  const GroupReader slices = root.group("slices");
  for (int i = 0; i < root.integer("n_slices"); ++i)
    observations.slices.push_back(read_slice(slices.group(numbered(static_cast<std::size_t>(i)))));
  return observations;
}
} // namespace pelvireg::dataset
