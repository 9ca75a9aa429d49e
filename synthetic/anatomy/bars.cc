// Bars of the reference: supports spread over their patches, urethra, membrane of the hiatus.
#include "synthetic/anatomy/bar_ends.h"
#include "synthetic/anatomy/organs.h"
#include "synthetic/anatomy/outer_surface.h"
#include "synthetic/anatomy/reference_parts.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

namespace pelvireg::anatomy
{
using dataset::ReferenceModel;
using dataset::ReferenceTruss;
using Eigen::Vector3d;

namespace
{
// A border that passed from node to node would be another support on every mesh: sections fade out over these widths.
constexpr double retropubic_facing = 0.8, retropubic_facing_fade = 0.2; // cosine between wall and bone
constexpr double retropubic_fade = 12;                                  // mm
constexpr double hiatus_fade = 4;                                       // mm
constexpr double least_area = 1e-3;                                     // mm^2, of a bar

/// Share a bar out over the nodes around its end: parallel bars whose sections add up to its own.
void append(const ReferenceTruss &bar, const BarEnd &end, const BarSurface &surface, std::vector<ReferenceTruss> &bars)
{
  for (const auto &[node, weight] : end.nodes)
  {
    bars.push_back(bar);
    bars.back().node_a = node;
    bars.back().fixed_point += surface.node(node) - end.position;
    bars.back().area *= weight;
  }
}

void add_support(const Parameters &p, const Support &support, bool left, const ReferenceModel &model,
                 std::vector<ReferenceTruss> &bars)
{
  const SupportPatches patches = support_patches(support, left, p);
  const BarSurface surface(model, support.organ);
  // A sheet of tissue resists shear, parallel bars do not: the bars of a fascia lean to either side by turns.
  const Vector3d along = patches.far_point - patches.organ_point;
  const Vector3d brace = 0.5 * along.norm() * along.cross(patches.organ_span).normalized();
  for (int i = 0; i < support.n_bars; ++i)
  {
    const double s = (i + 0.5) / support.n_bars - 0.5;
    ReferenceTruss bar;
    bar.group = support.name + (left ? "_left" : "_right");
    bar.part_a = support.organ;
    bar.fixed_point = patches.far_point + s * patches.far_span;
    if (support.kind == "fascia" || support.material == "fascia")
      bar.fixed_point += (i % 2 == 0 ? brace : -brace);
    bar.area = patches.area / support.n_bars;
    bar.material = support.material;
    bar.tension_only = support.tension_only;
    append(bar, surface.closest(patches.organ_point + s * patches.organ_span), surface, bars);
  }
}

/// The bladder neck hangs on the urethra: parallel bars on a ring around its axis.
void add_urethra(const Parameters &p, const ReferenceModel &model, std::vector<ReferenceTruss> &bars)
{
  const BarSurface surface(model, "bladder");
  // The neck is the point of the bladder farthest along the drawn-out direction.
  const Vector3d neck_direction = p.bladder.neck_direction.normalized();
  const Vector3d neck =
      p.bladder.centre + p.bladder.semi_axes.cwiseProduct(neck_direction) + p.bladder.neck_length * neck_direction;
  const Vector3d axis = (neck - p.urethra_far).normalized(), u = Vector3d::UnitX().cross(axis).normalized(),
                 v = axis.cross(u);
  for (int i = 0; i < p.urethra_bars; ++i)
  {
    const double angle = 2 * std::numbers::pi * i / p.urethra_bars;
    const Vector3d ring = p.urethra_radius * (std::cos(angle) * u + std::sin(angle) * v);
    ReferenceTruss bar;
    bar.group = "urethra";
    bar.part_a = "bladder";
    // Twisted by turns, so that the bars brace each other as the wall of a tube does.
    const double far_angle = angle + (i % 2 == 0 ? 1 : -1) * std::numbers::pi / 3;
    bar.fixed_point = p.urethra_far + p.urethra_far_radius * (std::cos(far_angle) * u + std::sin(far_angle) * v);
    bar.area = p.urethra_area / p.urethra_bars;
    bar.material = p.material_of.at("urethra");
    append(bar, surface.closest(neck + ring), surface, bars);
  }
}

/// Area of the mid-surface that falls to each node, int N_i dA by Simpson's rule, mm^2: all positive.
Eigen::VectorXd nodal_areas(const dataset::ReferenceShell &shell)
{
  // Place of node k of a VTK_BIQUADRATIC_QUAD in a 3 x 3 grid, and derivatives of quadratics at -1, 0, 1.
  constexpr int column[9] = {0, 2, 2, 0, 1, 2, 1, 0, 1}, row[9] = {0, 0, 2, 2, 0, 1, 2, 1, 1};
  constexpr double slope[3][3] = {{-1.5, 2, -0.5}, {-0.5, 0, 0.5}, {0.5, -2, 1.5}},
                   weight[3] = {1. / 3, 4. / 3, 1. / 3};
  Eigen::VectorXd areas = Eigen::VectorXd::Zero(shell.midsurface.rows());
  for (Eigen::Index c = 0; c < shell.cells.rows(); ++c)
    for (int at = 0; at < 9; ++at)
    {
      Vector3d along = Vector3d::Zero(), across = Vector3d::Zero();
      for (int k = 0; k < 9; ++k)
      {
        const Vector3d x = shell.midsurface.row(shell.cells(c, k)).transpose();
        if (row[k] == row[at])
          along += slope[column[at]][column[k]] * x;
        if (column[k] == column[at])
          across += slope[row[at]][row[k]] * x;
      }
      areas[shell.cells(c, at)] += weight[column[at]] * weight[row[at]] * along.cross(across).norm();
    }
  return areas;
}

/// The bladder lies on the pubic symphysis, a cushion of fat between: from each node that faces the bone five bars, one
/// straight and four that spread like a pyramid: a cushion that resists pressure and shear and cannot snap through.
/// Sections follow the area that falls to a node, and fade out at the cushion's border.
void add_retropubic(const Parameters &p, const ReferenceModel &model, std::vector<ReferenceTruss> &bars)
{
  const std::size_t first = bars.size();
  const Vector3d left = Vector3d::UnitX(), up = p.retropubic_normal.cross(left).normalized();
  double total = 0;
  for (const dataset::ReferenceShell &shell : model.shells)
  {
    if (shell.name != "bladder")
      continue;
    const Eigen::VectorXd areas = nodal_areas(shell);
    for (Eigen::Index n = 0; n < shell.midsurface.rows(); ++n)
    {
      const Vector3d node = shell.midsurface.row(n).transpose();
      const double facing = -shell.directors.row(n).dot(p.retropubic_normal);
      const double area = areas[n] * fade_in(facing, retropubic_facing, retropubic_facing_fade) *
                          fade_in(-std::abs(node.x()), -p.retropubic_half_width, retropubic_fade);
      if (area < least_area)
        continue;
      ReferenceTruss bar;
      bar.group = "retropubic";
      bar.part_a = "bladder";
      bar.node_a = static_cast<std::int32_t>(n);
      bar.area = area;
      bar.material = p.material_of.at("retropubic");
      for (const Vector3d &aside : {Vector3d(Vector3d::Zero()), left, up, Vector3d(-left), Vector3d(-up)})
      {
        bars.push_back(bar);
        bars.back().fixed_point = node + p.retropubic_depth * (aside - p.retropubic_normal);
        total += area;
      }
    }
  }
  for (std::size_t b = first; b < bars.size(); ++b)
    bars[b].area *= p.retropubic_area / total;
}

/// A bar between points of two parts: parallel ones between the nodes that carry its ends.
void append_between(const ReferenceTruss &bar, const BarEnd &a, const BarSurface &surface_a, const BarEnd &b,
                    const BarSurface &surface_b, std::vector<ReferenceTruss> &bars)
{
  for (const auto &[node_a, weight_a] : a.nodes)
    for (const auto &[node_b, weight_b] : b.nodes)
    {
      bars.push_back(bar);
      bars.back().node_a = node_a;
      bars.back().node_b = node_b;
      bars.back().offset_b = b.position - a.position + surface_a.node(node_a) - surface_b.node(node_b);
      bars.back().area *= weight_a * weight_b;
    }
}

/// From the rim of the hiatus to the closest points of vagina and anal canal within reach.
void add_hiatus(const Parameters &p, const ReferenceModel &model, std::vector<ReferenceTruss> &bars)
{
  const auto floor = std::find_if(model.shells.begin(), model.shells.end(),
                                  [](const dataset::ReferenceShell &shell) { return shell.name == "pelvic_floor"; });
  const std::set<std::int32_t> fixed(floor->fixed_nodes.begin(), floor->fixed_nodes.end());
  const std::vector<dataset::Integers> loops = boundary_loops(floor->cells);
  const auto rim = std::find_if(loops.begin(), loops.end(),
                                [&](const dataset::Integers &loop) { return fixed.count(loop[0]) == 0; });
  const BarSurface floor_surface(model, floor->name);
  const std::vector<LoopPart> parts = equal_parts(floor->midsurface, *rim);
  for (const std::string organ : {"vagina", "rectum"})
  {
    const BarSurface surface(model, organ);
    for (const LoopPart &part : parts)
    {
      const BarEnd end = surface.closest(part.middle.position);
      const double reach = (end.position - part.middle.position).norm();
      ReferenceTruss bar;
      bar.group = "hiatus";
      bar.part_a = "pelvic_floor";
      bar.part_b = organ;
      bar.area = p.hiatus_area_per_length * part.length * fade_in(-reach, -p.hiatus_reach, hiatus_fade);
      bar.material = p.material_of.at("hiatus");
      if (bar.area > least_area)
        append_between(bar, part.middle, floor_surface, end, surface, bars);
    }
  }
}
} // namespace

std::vector<ReferenceTruss> make_bars(const Parameters &p, const ReferenceModel &model)
{
  std::vector<ReferenceTruss> bars;
  for (const Support &support : p.supports)
    for (const bool left : {true, false})
      add_support(p, support, left, model, bars);
  add_urethra(p, model, bars);
  add_retropubic(p, model, bars);
  add_hiatus(p, model, bars);
  return bars;
}
} // namespace pelvireg::anatomy
