// Bars of the reference: supports spread over their patches, urethra, membrane of the hiatus.
#include "synthetic/anatomy/bar_ends.h"
#include "synthetic/anatomy/reference_parts.h"

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>
#include <set>

namespace pelvireg::anatomy
{
using dataset::Points;
using dataset::ReferenceModel;
using dataset::ReferenceTruss;
using Eigen::Vector3d;

namespace
{
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

/// The bladder lies on the pubic symphysis, a cushion of fat between: from each node that faces the bone five bars, one
/// straight and four that spread like a pyramid: a cushion that resists pressure and shear and cannot snap through.
void add_retropubic(const Parameters &p, const ReferenceModel &model, std::vector<ReferenceTruss> &bars)
{
  const std::size_t first = bars.size();
  const Vector3d left = Vector3d::UnitX(), up = p.retropubic_normal.cross(left).normalized();
  for (const dataset::ReferenceShell &shell : model.shells)
    for (Eigen::Index n = 0; shell.name == "bladder" && n < shell.midsurface.rows(); ++n)
    {
      const Vector3d node = shell.midsurface.row(n).transpose();
      const bool is_facing = shell.directors.row(n).dot(p.retropubic_normal) < -0.8;
      if (is_facing && std::abs(node.x()) < p.retropubic_half_width)
        for (const Vector3d &aside : {Vector3d(Vector3d::Zero()), left, up, Vector3d(-left), Vector3d(-up)})
          bars.push_back({"retropubic", "bladder", static_cast<std::int32_t>(n), "", -1,
                          node + p.retropubic_depth * (aside - p.retropubic_normal), 0,
                          p.material_of.at("retropubic")});
    }
  for (std::size_t b = first; b < bars.size(); ++b)
    bars[b].area = p.retropubic_area / static_cast<double>(bars.size() - first);
}

/// Length of a closed loop that falls to its node i, mm.
double tributary_length(const dataset::Integers &loop, Eigen::Index i, const Points &points)
{
  const Eigen::Index n = loop.size();
  const auto distance = [&](Eigen::Index j)
  { return (points.row(loop[(i + j + n) % n]) - points.row(loop[i])).norm(); };
  return 0.5 * (distance(-1) + distance(1));
}

/// From the rim of the hiatus to the closest points of vagina and anal canal within reach.
void add_hiatus(const Parameters &p, const ReferenceModel &model, std::vector<ReferenceTruss> &bars)
{
  const dataset::ReferenceShell *floor = nullptr;
  for (const dataset::ReferenceShell &shell : model.shells)
    if (shell.name == "pelvic_floor")
      floor = &shell;
  const std::set<std::int32_t> fixed(floor->fixed_nodes.data(), floor->fixed_nodes.data() + floor->fixed_nodes.size());
  for (const std::string organ : {"vagina", "rectum"})
  {
    const BarSurface surface(model, organ);
    for (const dataset::Integers &loop : boundary_loops(floor->cells))
      for (Eigen::Index i = 0; i < loop.size() && fixed.count(loop[0]) == 0; ++i)
      {
        const Vector3d from = floor->midsurface.row(loop[i]).transpose();
        const BarEnd end = surface.closest(from);
        if ((end.position - from).norm() > p.hiatus_reach)
          continue;
        const double area = p.hiatus_area_per_length * tributary_length(loop, i, floor->midsurface);
        for (const auto &[node, weight] : end.nodes)
          bars.push_back({"hiatus", "pelvic_floor", loop[i], organ, node, Vector3d::Zero(), weight * area,
                          p.material_of.at("hiatus")});
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
