#include "registration/constraints/layered_depth_image.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace pelvireg::registration
{
namespace
{
using Integer = std::int64_t;

/// A corner in the image: snapped coordinates.
struct Corner
{
  Integer u = 0, v = 0;
};

/// Twice the area of (a, b, p), positive when p lies to the left of a -> b.
Integer edge_function(const Corner &a, const Corner &b, const Corner &p)
{
  return (b.u - a.u) * (p.v - a.v) - (b.v - a.v) * (p.u - a.u);
}

/// A point on the edge counts as left of it: as if every point were moved by an infinitesimal towards -u, and by a yet
/// smaller one towards +v. Of two triangles that share the edge exactly one then owns it.
bool owns_its_points(const Corner &a, const Corner &b)
{
  return b.v > a.v || (b.v == a.v && b.u > a.u);
}

Integer snap(double x, double quantum)
{
  return std::llround(x / quantum);
}
} // namespace

double raster_quantum(const Eigen::AlignedBox3d &box)
{
  // Differences of 2^30 quanta multiply to 2^60, and twice that still fits.
  const double extent = std::max({box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff(), 1.0});
  return std::exp2(std::ceil(std::log2(extent)) - 29);
}

void LayeredDepthImage::reserve(std::size_t n_rays, std::size_t n_fragments)
{
  constexpr std::size_t many_crossings = 64;
  heads_.reserve(n_rays);
  fragments_.reserve(n_fragments);
  next_.reserve(n_fragments);
  sorted_.reserve(many_crossings);
}

void LayeredDepthImage::aim(int axis, double pixel, const Eigen::AlignedBox3d &box)
{
  axis_ = axis;
  pixel_ = pixel;
  const auto range = [&](int along, int &first, int &n)
  {
    first = static_cast<int>(std::ceil(box.min()[along] / pixel - 0.5));
    n = box.isEmpty() ? 0 : std::max(0, static_cast<int>(std::floor(box.max()[along] / pixel - 0.5)) - first + 1);
  };
  range(u_axis(), first_u_, n_u_);
  range(v_axis(), first_v_, n_v_);
  fragments_.clear();
  next_.clear();
  heads_.assign(static_cast<std::size_t>(n_u_) * static_cast<std::size_t>(n_v_), -1);
}

Eigen::Vector2d LayeredDepthImage::centre(int ray) const
{
  return {(first_u_ + ray % n_u_ + 0.5) * pixel_, (first_v_ + ray / n_u_ + 0.5) * pixel_};
}

void LayeredDepthImage::rasterise(int side, const Triangles &triangles, const Points &positions, double quantum)
{
  if (n_rays() == 0)
    return;
  const int u = u_axis(), v = v_axis();
  const double low_u = (first_u_ + 0.5) * pixel_, low_v = (first_v_ + 0.5) * pixel_;
  for (int t = 0; t < triangles.rows(); ++t)
  {
    const auto at = [&](int i, int along) { return positions(triangles(t, i), along); };
    const auto pixels = [&](int along, double low, int n)
    {
      const auto [least, most] = std::minmax({at(0, along), at(1, along), at(2, along)});
      return std::pair(
          std::max(0, static_cast<int>(std::max(-1.0, std::ceil((least - quantum - low) / pixel_)))),
          std::min(n - 1, static_cast<int>(std::min<double>(n, std::floor((most + quantum - low) / pixel_)))));
    };
    const auto [from_u, to_u] = pixels(u, low_u, n_u_);
    const auto [from_v, to_v] = pixels(v, low_v, n_v_);
    if (from_u > to_u || from_v > to_v)
      continue;

    std::array<int, 3> order{0, 1, 2};
    std::array<Corner, 3> corner;
    for (int i = 0; i < 3; ++i)
      corner[i] = {snap(at(i, u), quantum), snap(at(i, v), quantum)};
    const Integer area = edge_function(corner[0], corner[1], corner[2]);
    if (area == 0)
      continue;
    if (area < 0)
    {
      std::swap(corner[1], corner[2]);
      std::swap(order[1], order[2]);
    }
    std::array<Integer, 3> least; // of the edge function opposite to each corner
    for (int i = 0; i < 3; ++i)
      least[i] = owns_its_points(corner[(i + 1) % 3], corner[(i + 2) % 3]) ? 0 : 1;
    for (int j = from_v; j <= to_v; ++j)
      for (int i = from_u; i <= to_u; ++i)
      {
        const int ray = j * n_u_ + i;
        if (side == 1 && heads_[ray] < 0)
          continue;
        const Corner p = {snap((first_u_ + i + 0.5) * pixel_, quantum), snap((first_v_ + j + 0.5) * pixel_, quantum)};
        std::array<Integer, 3> opposite;
        bool is_inside = true;
        for (int k = 0; k < 3 && is_inside; ++k)
        {
          opposite[k] = edge_function(corner[(k + 1) % 3], corner[(k + 2) % 3], p);
          is_inside = opposite[k] >= least[k];
        }
        if (!is_inside)
          continue;
        Fragment fragment;
        for (int k = 0; k < 3; ++k)
        {
          fragment.weights[order[k]] = static_cast<double>(opposite[k]) / static_cast<double>(std::abs(area));
          fragment.depth += fragment.weights[order[k]] * at(order[k], axis_);
        }
        fragment.triangle = t;
        fragment.side = static_cast<std::int8_t>(side);
        fragment.leaves = area > 0;
        next_.push_back(heads_[ray]);
        heads_[ray] = static_cast<int>(fragments_.size());
        fragments_.push_back(fragment);
      }
  }
}

const std::vector<const Fragment *> &LayeredDepthImage::crossings(int ray) const
{
  sorted_.clear();
  for (int f = heads_[ray]; f >= 0; f = next_[f])
    sorted_.push_back(&fragments_[f]);
  std::sort(sorted_.begin(), sorted_.end(),
            [](const Fragment *a, const Fragment *b) {
              return std::tie(a->depth, a->side, a->leaves, a->triangle) <
                     std::tie(b->depth, b->side, b->leaves, b->triangle);
            });
  return sorted_;
}
} // namespace pelvireg::registration
