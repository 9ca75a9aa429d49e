#include "registration/constraints/volume_contact.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace pelvireg::registration
{
namespace
{
/// A cell whose surface elements push against each other has no normal to speak of: least ratio of the resulting area
/// to the sum of the areas' magnitudes. A flat patch has at least 1 / sqrt(3).
constexpr double least_coherence = 0.1;

Eigen::AlignedBox3d box_of(const ContactSurface &surface)
{
  Eigen::AlignedBox3d box;
  for (const int node : surface.triangles->reshaped())
    box.extend(surface.positions->row(node).transpose());
  return box;
}

double area_of(const ContactSurface &surface)
{
  double area = 0;
  for (Eigen::Index t = 0; t < surface.triangles->rows(); ++t)
  {
    const auto corner = [&](int i) -> Eigen::Vector3d
    { return surface.positions->row((*surface.triangles)(t, i)).transpose(); };
    area += 0.5 * (corner(1) - corner(0)).cross(corner(2) - corner(0)).norm();
  }
  return area;
}

Eigen::Vector3d unit_normal(const ContactSurface &surface, int triangle)
{
  const auto corner = [&](int i) -> Eigen::Vector3d
  { return surface.positions->row((*surface.triangles)(triangle, i)).transpose(); };
  return (corner(1) - corner(0)).cross(corner(2) - corner(0)).stableNormalized();
}

Eigen::Vector3d point_on_ray(const LayeredDepthImage &image, const Eigen::Vector2d &centre, double depth)
{
  Eigen::Vector3d point;
  point[image.u_axis()] = centre[0];
  point[image.v_axis()] = centre[1];
  point[image.axis()] = depth;
  return point;
}

/// Twenty-one bits an axis: cells within a million cells of the origin have different names.
std::int64_t cell_name(const Eigen::Vector3d &point, double edge)
{
  std::int64_t name = 0;
  for (int axis = 2; axis >= 0; --axis)
    name = (name << 21) | ((static_cast<std::int64_t>(std::floor(point[axis] / edge)) + (1 << 20)) & 0x1FFFFF);
  return name;
}
} // namespace

VolumeContact::VolumeContact(int n_nodes_a, int n_nodes_b)
    : share_of_{std::vector<int>(n_nodes_a, -1), std::vector<int>(n_nodes_b, -1)}
{
}

void VolumeContact::reserve(const ContactSurface &a, const ContactSurface &b, const ContactGrid &grid,
                            std::size_t n_contacts)
{
  constexpr double growth = 1.5;
  constexpr std::size_t many_spans = 64;
  const double area = growth * growth * (area_of(a) + area_of(b)); // at least the area seen along any axis
  // The boxes' overlap is no larger than either, however both turn.
  const double extent = growth * std::min(box_of(a).diagonal().norm(), box_of(b).diagonal().norm()) + 2 * grid.margin;
  const double rays_across = extent / grid.pixel + 2;
  const auto n_rays = static_cast<std::size_t>(rays_across * rays_across);
  const auto n_fragments = static_cast<std::size_t>(area / (grid.pixel * grid.pixel));
  for (LayeredDepthImage &image : images_)
    image.reserve(n_rays, n_fragments);
  spans_.reserve(many_spans);
  columns_.reserve(n_fragments);
  order_.reserve(n_fragments);
  nested_.reserve(n_fragments);
  contacts_.reserve(n_contacts);
  shares_.reserve(n_contacts * reserved_shares);
}

void VolumeContact::detect(const ContactSurface &a, const ContactSurface &b, const ContactGrid &grid)
{
  const std::array<ContactSurface, 2> surfaces{a, b};
  columns_.clear();
  nested_.clear();
  contacts_.clear();
  shares_.clear();
  overlap_volume_ = deepest_overlap_ = 0;
  n_open_rays_ = 0;
  cast_rays(surfaces, grid);
  push_out_nested(surfaces, grid);
  gather_cells(surfaces);
}

void VolumeContact::cast_rays(const std::array<ContactSurface, 2> &surfaces, const ContactGrid &grid)
{
  Eigen::AlignedBox3d box_a = box_of(surfaces[0]), box_b = box_of(surfaces[1]);
  const double quantum = raster_quantum(box_a.merged(box_b));
  for (Eigen::AlignedBox3d *box : {&box_a, &box_b})
  {
    box->min().array() -= grid.margin;
    box->max().array() += grid.margin;
  }
  const Eigen::AlignedBox3d overlap = box_a.intersection(box_b);
  if (overlap.isEmpty())
    return;
  for (int axis = 0; axis < 3; ++axis)
  {
    LayeredDepthImage &image = images_[axis];
    image.aim(axis, grid.pixel, overlap);
    for (int side = 0; side < 2; ++side)
      image.rasterise(side, *surfaces[side].triangles, *surfaces[side].positions, quantum);
    for (int ray = 0; ray < image.n_rays(); ++ray)
    {
      const std::vector<const Fragment *> &crossings = image.crossings(ray);
      if (crossings.size() < 2)
        continue;
      n_open_rays_ += !find_spans(crossings, spans_);
      for (const ContactSpan &span : spans_)
        add_column(span, surfaces, grid, image, image.centre(ray), false);
    }
  }
}

void VolumeContact::add_column(const ContactSpan &span, const std::array<ContactSurface, 2> &surfaces,
                               const ContactGrid &grid, const LayeredDepthImage &image, const Eigen::Vector2d &centre,
                               bool is_pushed_out)
{
  for (const Fragment *end : {span.entry, span.exit})
    if (!(*surfaces[end->side].may_touch)[end->triangle])
      return;
  double weight = 1;
  if (span.is_between_bodies())
  {
    const auto normal = [&](const Fragment &end) { return unit_normal(surfaces[end.side], end.triangle); };
    const Eigen::Vector3d at_exit = normal(*span.exit), at_entry = normal(*span.entry);
    const double gap = -span.length * std::abs((at_exit - at_entry).stableNormalized()[image.axis()]);
    if (gap > 0)
      weight = grid.margin > 0 ? 1 - gap / grid.margin : 0;
  }
  if (!(weight > 0))
    return;
  if (span.length > 0 && !is_pushed_out)
    measure_depth(span, surfaces, image, centre);
  if (!span.is_between_bodies() && span.outer_entry && span.outer_exit)
    nested_.push_back({span, image.axis(), centre});
  const Eigen::Vector3d middle = point_on_ray(image, centre, 0.5 * (span.entry->depth + span.exit->depth));
  columns_.push_back(
      {cell_name(middle, grid.cell), image.axis(), span.entry, span.exit, span.length, weight * image.pixel_area()});
}

void VolumeContact::measure_depth(const ContactSpan &span, const std::array<ContactSurface, 2> &surfaces,
                                  const LayeredDepthImage &image, const Eigen::Vector2d &centre)
{
  // The other end of an overlap between two bodies lies on the other surface, so no end is deeper than the length.
  if (span.is_between_bodies() && span.length <= deepest_overlap_)
    return;
  for (const Fragment *end : {span.entry, span.exit})
  {
    const ContactSurface &other = surfaces[1 - end->side];
    const NearestTriangle nearest =
        other.walls->nearest(point_on_ray(image, centre, end->depth), std::numeric_limits<double>::infinity(),
                             *other.positions, [](int) { return true; });
    if (nearest.triangle >= 0)
      deepest_overlap_ = std::max(deepest_overlap_, std::sqrt(nearest.point.squared_distance));
  }
}

void VolumeContact::push_out_nested(const std::array<ContactSurface, 2> &surfaces, const ContactGrid &grid)
{
  const auto joins_bodies = [](const Column &column)
  { return column.length > 0 && column.entry->side != column.exit->side; };
  if (nested_.empty() || std::any_of(columns_.begin(), columns_.end(), joins_bodies))
    return;
  // The longest way out over the rays of an axis, down and up.
  std::array<std::array<double, 2>, 3> ways{};
  for (const Nested &nested : nested_)
  {
    std::array<double, 2> &way = ways[nested.axis];
    way[0] = std::max(way[0], nested.span.exit->depth - nested.span.outer_entry->depth);
    way[1] = std::max(way[1], nested.span.outer_exit->depth - nested.span.entry->depth);
  }
  int axis = -1, direction = 0;
  for (int d = 0; d < 3; ++d)
    for (int k = 0; k < 2; ++k)
      if (ways[d][k] > 0 && (axis < 0 || ways[d][k] < ways[axis][direction]))
      {
        axis = d;
        direction = k;
      }
  columns_.clear();
  for (const Nested &nested : nested_)
    if (nested.axis == axis)
    {
      ContactSpan span = nested.span;
      (direction == 0 ? span.entry : span.exit) = direction == 0 ? span.outer_entry : span.outer_exit;
      span.length = span.exit->depth - span.entry->depth;
      add_column(span, surfaces, grid, images_[axis], nested.centre, true);
    }
}

void VolumeContact::gather_cells(const std::array<ContactSurface, 2> &surfaces)
{
  order_.resize(columns_.size());
  std::iota(order_.begin(), order_.end(), 0);
  std::sort(order_.begin(), order_.end(),
            [this](int a, int b) { return std::pair(columns_[a].cell, a) < std::pair(columns_[b].cell, b); });
  for (std::size_t first = 0, end = 0; first < order_.size(); first = end)
  {
    while (end < order_.size() && columns_[order_[end]].cell == columns_[order_[first]].cell)
      ++end;
    gather_cell(first, end, surfaces);
  }
}

void VolumeContact::gather_cell(std::size_t first, std::size_t end, const std::array<ContactSurface, 2> &surfaces)
{
  Eigen::Vector3d area = Eigen::Vector3d::Zero(), volume = Eigen::Vector3d::Zero(), overlap = Eigen::Vector3d::Zero();
  double sum_of_areas = 0, pixel_area = 0;
  for (std::size_t k = first; k < end; ++k)
  {
    const Column &column = columns_[order_[k]];
    volume[column.axis] += column.length * column.weighted_area;
    overlap[column.axis] += std::max(0.0, column.length) * column.weighted_area;
    pixel_area = images_[column.axis].pixel_area();
    if (column.entry->side == column.exit->side)
      continue;
    area[column.axis] += column.entry->side == 0 ? column.weighted_area : -column.weighted_area;
    sum_of_areas += column.weighted_area;
  }
  const double size = area.norm();
  if (!(size >= least_coherence * sum_of_areas) || !(size >= pixel_area))
  {
    overlap_volume_ += overlap.mean();
    return;
  }
  Contact contact;
  contact.cell = columns_[order_[first]].cell;
  contact.normal = area / size;
  contact.area = size;
  contact.depth = contact.normal.cwiseAbs2().dot(volume) / size;
  overlap_volume_ += contact.normal.cwiseAbs2().dot(overlap);
  contact.first_share = static_cast<int>(shares_.size());
  for (std::size_t k = first; k < end; ++k)
  {
    const Column &column = columns_[order_[k]];
    share_out(column, *column.entry, *surfaces[column.entry->side].triangles, 1, contact);
    share_out(column, *column.exit, *surfaces[column.exit->side].triangles, -1, contact);
  }
  contact.end_share = static_cast<int>(shares_.size());
  std::array<double, 2> total{0, 0};
  for (int s = contact.first_share; s < contact.end_share; ++s)
    total[shares_[s].side] += shares_[s].weight;
  for (int s = contact.first_share; s < contact.end_share; ++s)
  {
    shares_[s].weight /= total[shares_[s].side];
    share_of_[shares_[s].side][shares_[s].node] = -1;
  }
  contacts_.push_back(contact);
}

void VolumeContact::share_out(const Column &column, const Fragment &fragment, const Triangles &triangles, double sign,
                              const Contact &contact)
{
  for (int i = 0; i < 3; ++i)
  {
    const int node = triangles(fragment.triangle, i);
    int &share = share_of_[fragment.side][node];
    if (share < 0)
    {
      share = static_cast<int>(shares_.size());
      shares_.push_back({fragment.side, node, Eigen::Vector3d::Zero(), 0});
    }
    const double area = column.weighted_area * fragment.weights[i];
    shares_[share].normal_jacobian[column.axis] += sign * area / contact.area;
    if (column.entry->side != column.exit->side)
      shares_[share].weight += std::abs(contact.normal[column.axis]) * area;
  }
}
} // namespace pelvireg::registration
