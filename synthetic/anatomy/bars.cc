// Bars of the reference: supports spread over their patches, urethra, membrane of the hiatus.
#include "synthetic/anatomy/reference_parts.h"

#include "synthetic/dataset/error.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <cmath>
#include <limits>
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
/// Nodes of a part on its outer surface: all of a shell's, those of the boundary of the solid.
std::vector<std::int32_t> surface_nodes(const ReferenceModel &model, const std::string &part, Points &points)
{
  std::set<std::int32_t> nodes;
  for (const dataset::ReferenceShell &shell : model.shells)
    if (shell.name == part)
    {
      points = shell.midsurface;
      for (Eigen::Index i = 0; i < points.rows(); ++i)
        nodes.insert(static_cast<std::int32_t>(i));
    }
  for (const dataset::ReferenceSolid &solid : model.solids)
    if (solid.name == part)
    {
      points = solid.points;
      nodes.insert(solid.faces.data(), solid.faces.data() + solid.faces.size());
    }
  return {nodes.begin(), nodes.end()};
}

/// The nearest node that is not taken yet; -1 when all are.
std::int32_t nearest(const Points &points, const std::vector<std::int32_t> &nodes, const Vector3d &target,
                     const std::set<std::int32_t> &taken)
{
  std::int32_t best = -1;
  double least = std::numeric_limits<double>::infinity();
  for (const std::int32_t node : nodes)
  {
    const double distance = (points.row(node).transpose() - target).squaredNorm();
    if (distance < least && taken.count(node) == 0)
    {
      least = distance;
      best = node;
    }
  }
  return best;
}

void add_support(const Parameters &p, const Support &support, bool left, const ReferenceModel &model,
                 std::vector<ReferenceTruss> &bars)
{
  const SupportPatches patches = support_patches(support, left, p);
  Points points;
  const std::vector<std::int32_t> nodes = surface_nodes(model, support.organ, points);
  std::set<std::int32_t> taken;
  // A sheet of tissue resists shear, parallel bars do not: the bars of a fascia lean to either side by turns.
  const Vector3d along = patches.far_point - patches.organ_point;
  const Vector3d brace = 0.5 * along.norm() * along.cross(patches.organ_span).normalized();
  for (int i = 0; i < support.n_bars; ++i)
  {
    const double s = (i + 0.5) / support.n_bars - 0.5;
    ReferenceTruss bar;
    bar.group = support.name + (left ? "_left" : "_right");
    bar.part_a = support.organ;
    bar.node_a = nearest(points, nodes, patches.organ_point + s * patches.organ_span, taken);
    if (bar.node_a < 0)
      throw InputError(
          fmt::format("Support {}: {} bars need as many nodes, but {} has {}; lower n_bars or refine the mesh.",
                      support.name, support.n_bars, support.organ, nodes.size()));
    taken.insert(bar.node_a);
    bar.fixed_point = patches.far_point + s * patches.far_span;
    if (support.kind == "fascia" || support.material == "fascia")
      bar.fixed_point += (i % 2 == 0 ? brace : -brace);
    bar.area = patches.area / support.n_bars;
    bar.material = support.material;
    bar.tension_only = support.tension_only;
    bars.push_back(bar);
  }
}

/// The bladder neck hangs on the urethra: parallel bars on a ring around its axis.
void add_urethra(const Parameters &p, const ReferenceModel &model, std::vector<ReferenceTruss> &bars)
{
  Points points;
  const std::vector<std::int32_t> nodes = surface_nodes(model, "bladder", points);
  // The neck is the point of the bladder farthest along the drawn-out direction.
  const Vector3d neck_direction = p.bladder.neck_direction.normalized();
  const Vector3d neck =
      p.bladder.centre + p.bladder.semi_axes.cwiseProduct(neck_direction) + p.bladder.neck_length * neck_direction;
  const Vector3d axis = (neck - p.urethra_far).normalized(), u = Vector3d::UnitX().cross(axis).normalized(),
                 v = axis.cross(u);
  std::set<std::int32_t> taken;
  for (int i = 0; i < p.urethra_bars; ++i)
  {
    const double angle = 2 * std::numbers::pi * i / p.urethra_bars;
    const Vector3d ring = p.urethra_radius * (std::cos(angle) * u + std::sin(angle) * v);
    ReferenceTruss bar;
    bar.group = "urethra";
    bar.part_a = "bladder";
    bar.node_a = nearest(points, nodes, neck + ring, taken);
    taken.insert(bar.node_a);
    // Twisted by turns, so that the bars brace each other as the wall of a tube does.
    const double far_angle = angle + (i % 2 == 0 ? 1 : -1) * std::numbers::pi / 3;
    bar.fixed_point = p.urethra_far + p.urethra_radius * (std::cos(far_angle) * u + std::sin(far_angle) * v);
    bar.area = p.urethra_area / p.urethra_bars;
    bar.material = p.material_of.at("urethra");
    bars.push_back(bar);
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

/// From every node of the hiatus to the nearest node of vagina and anal canal within reach.
void add_hiatus(const Parameters &p, const ReferenceModel &model, std::vector<ReferenceTruss> &bars)
{
  const dataset::ReferenceShell *floor = nullptr;
  for (const dataset::ReferenceShell &shell : model.shells)
    if (shell.name == "pelvic_floor")
      floor = &shell;
  const std::set<std::int32_t> fixed(floor->fixed_nodes.data(), floor->fixed_nodes.data() + floor->fixed_nodes.size());
  for (const dataset::Integers &loop : boundary_loops(floor->cells))
  {
    if (fixed.count(loop[0]) > 0)
      continue;
    for (Eigen::Index i = 0; i < loop.size(); ++i)
      for (const std::string organ : {"vagina", "rectum"})
      {
        Points points;
        const std::vector<std::int32_t> nodes = surface_nodes(model, organ, points);
        const Vector3d from = floor->midsurface.row(loop[i]).transpose();
        const std::int32_t node = nearest(points, nodes, from, {});
        if ((points.row(node).transpose() - from).norm() > p.hiatus_reach)
          continue;
        bars.push_back({"hiatus", "pelvic_floor", loop[i], organ, node, Vector3d::Zero(), p.hiatus_area,
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
