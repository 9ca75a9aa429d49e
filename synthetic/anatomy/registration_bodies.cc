#include "synthetic/anatomy/registration_bodies.h"

#include "synthetic/anatomy/volume_mesh.h"
#include "synthetic/dataset/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

namespace pelvireg::anatomy
{
using dataset::Integers;
using dataset::RegistrationBody;
using dataset::SurfaceRegion;

namespace
{
constexpr double count_tolerance = 0.05; // node counts against Table 1 (issue A)

/// Flat strip over a rim (a convex loop): triangles over its nodes only.
std::vector<Eigen::RowVector3i> cap_over(const Integers &loop)
{
  // The cap runs against the boundary direction of the wall, so that it points outward too.
  std::vector<Eigen::RowVector3i> triangles;
  Eigen::Index low = 0, high = loop.size() - 1;
  for (bool from_low = true; high - low >= 2; from_low = !from_low)
  {
    if (from_low)
      triangles.push_back({loop[low], loop[high], loop[low + 1]}), ++low;
    else
      triangles.push_back({loop[low], loop[high], loop[high - 1]}), --high;
  }
  return triangles;
}

/// Surface, caps and fixed rims. The outer edge of an open end is held, as the reference holds it: the wall goes on
/// there into the perineum, the anal margin or the colon (anatomy notes, 3). It may turn about the edge, in both
/// models.
void set_outer_surface(const TriangleMesh &surface, RegistrationBody &body)
{
  std::vector<Eigen::RowVector3i> caps;
  std::vector<std::int32_t> rims;
  for (const Integers &loop : boundary_loops(surface.triangles))
  {
    rims.insert(rims.end(), loop.begin(), loop.end());
    for (const Eigen::RowVector3i &triangle : cap_over(loop))
      caps.push_back(triangle);
  }
  std::sort(rims.begin(), rims.end());
  body.fixed_nodes = Eigen::Map<const Integers>(rims.data(), static_cast<Eigen::Index>(rims.size()));
  const Eigen::Index n = surface.triangles.rows(), n_caps = static_cast<Eigen::Index>(caps.size());
  body.outer_triangles.resize(n + n_caps, 3);
  body.outer_triangles.topRows(n) = surface.triangles;
  body.outer_region.resize(n + n_caps);
  body.outer_region.head(n) = surface.region;
  for (Eigen::Index i = 0; i < n_caps; ++i)
  {
    body.outer_triangles.row(n + i) = caps[static_cast<std::size_t>(i)];
    body.outer_region[n + i] = static_cast<std::int32_t>(SurfaceRegion::cap);
  }
}

RegistrationBody hollow_body(const std::vector<Chart> &charts, double wall)
{
  const TriangleMesh surface = triangle_mesh(charts);
  VolumeMesh volume = extrude_wall(surface, wall);
  RegistrationBody body;
  body.points = std::move(volume.points);
  body.tets = std::move(volume.tets);
  set_outer_surface(surface, body);
  return body;
}

RegistrationBody full_body(const std::vector<Chart> &charts, double size)
{
  const TriangleMesh surface = triangle_mesh(charts);
  VolumeMesh volume = fill_volume(surface, size);
  RegistrationBody body;
  body.points = std::move(volume.points);
  body.tets = std::move(volume.tets);
  set_outer_surface(surface, body);
  return body;
}

/// The mesh size whose node count is nearest to the target: halving first, then, because counts jump, a walk through
/// the sizes nearby when halving ended on the wrong side of a jump.
double size_for_count(int target, const std::function<int(double)> &n_nodes)
{
  double best_size = 0;
  int best_count = 0;
  const auto try_size = [&](double size)
  {
    const int n = n_nodes(size);
    if (best_size == 0 || std::abs(n - target) < std::abs(best_count - target))
    {
      best_size = size;
      best_count = n;
    }
    return n;
  };
  const auto is_close = [&](double tolerance) { return std::abs(best_count - target) <= tolerance * target; };
  double fine = 1.5, coarse = 30;
  for (int i = 0; i < 10 && !is_close(count_tolerance / 5); ++i)
  {
    const double middle = std::sqrt(fine * coarse);
    (try_size(middle) > target ? fine : coarse) = middle;
  }
  const double centre = best_size;
  for (int i = -20; i <= 20 && !is_close(count_tolerance); ++i)
    try_size(centre * std::pow(0.985, i));
  return best_size;
}

RegistrationBody sized_body(const std::string &name, int target, const std::function<int(double)> &n_nodes,
                            const std::function<RegistrationBody(double)> &make)
{
  const double best_size = size_for_count(target, n_nodes);
  RegistrationBody body = make(best_size);
  if (!(std::abs(static_cast<double>(body.points.rows()) - target) <= count_tolerance * target))
    throw InputError(
        fmt::format("registration.nodes.{} is {}, but the nearest mesh has {} nodes (5 % are allowed); choose a "
                    "count near that.",
                    name, target, body.points.rows()));
  return body;
}
/// The vagina has few cells around, so its counts jump by more than the tolerance: its cells may be a little longer or
/// shorter than wide to come near the target.
double vagina_aspect(const Parameters &p)
{
  const int target = p.registration_nodes.at("vagina");
  double best_aspect = 1, least = 1;
  for (const double aspect : {1.0, 0.9, 1.1, 0.8, 1.2})
  {
    const auto n_nodes = [&](double size)
    { return 2 * static_cast<int>(triangle_mesh(vagina_charts(p.vagina, p.uterus, size, aspect)).points.rows()); };
    const double off = std::abs(n_nodes(size_for_count(target, n_nodes)) / static_cast<double>(target) - 1);
    if (off < least)
    {
      least = off;
      best_aspect = aspect;
    }
    if (off <= count_tolerance)
      break;
  }
  return best_aspect;
}
} // namespace

dataset::RegistrationModel make_registration(const Parameters &p)
{
  const auto hollow = [](const std::function<std::vector<Chart>(double)> &charts, double wall)
  {
    return std::pair{[=](double size) { return 2 * static_cast<int>(triangle_mesh(charts(size)).points.rows()); },
                     [=](double size) { return hollow_body(charts(size), wall); }};
  };
  const auto uterus = [&](double size) { return full_body(uterus_charts(p.uterus, p.vagina, size), size); };
  const auto bladder = hollow([&](double size) { return bladder_charts(p.bladder, size); }, p.bladder.wall);
  const double aspect = vagina_aspect(p);
  const auto vagina =
      hollow([&](double size) { return vagina_charts(p.vagina, p.uterus, size, aspect); }, p.vagina.wall);
  const auto rectum = hollow([&](double size) { return rectum_charts(p.rectum, size); }, p.rectum.wall);

  dataset::RegistrationModel model;
  const auto add = [&](const std::string &name, RegistrationBody body)
  {
    body.name = name;
    model.bodies.push_back(std::move(body));
  };
  add("bladder", sized_body("bladder", p.registration_nodes.at("bladder"), bladder.first, bladder.second));
  add("vagina", sized_body("vagina", p.registration_nodes.at("vagina"), vagina.first, vagina.second));
  add("uterus", sized_body(
                    "uterus", p.registration_nodes.at("uterus"),
                    [&](double size) { return static_cast<int>(uterus(size).points.rows()); }, uterus));
  add("rectum", sized_body("rectum", p.registration_nodes.at("rectum"), rectum.first, rectum.second));
  add_bands(p, model);
  for (RegistrationBody &body : model.bodies)
  {
    body.youngs_modulus = p.youngs_modulus.at(body.name);
    body.poisson_ratio = p.poisson_ratio;
    body.density = p.density;
  }

  std::set<std::int32_t> patch;
  const RegistrationBody &body = model.bodies[2];
  for (Eigen::Index t = 0; t < body.outer_triangles.rows(); ++t)
    if (body.outer_region[t] == static_cast<std::int32_t>(SurfaceRegion::cervix_patch))
      patch.insert({body.outer_triangles(t, 0), body.outer_triangles(t, 1), body.outer_triangles(t, 2)});
  const std::vector<std::int32_t> nodes(patch.begin(), patch.end());
  model.attachments.push_back({"uterus_vagina", "organ", "uterus",
                               Eigen::Map<const Integers>(nodes.data(), static_cast<Eigen::Index>(nodes.size())),
                               "vagina"});
  return model;
}
} // namespace pelvireg::anatomy
