#include "reference_fe/pelvis_model.h"

#include "reference_fe/elements/quadratic_tetrahedron.h"
#include "reference_fe/elements/shell_term.h"
#include "reference_fe/materials/yeoh.h"
#include "synthetic/dataset/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>

namespace pelvireg::reference_fe
{
namespace
{
using dataset::ReferenceModel;
using dataset::SurfaceRegion;

/// Where each part's unknowns begin, and its nodes and faces as surface nodes and faces.
class Parts
{
public:
  Parts(const ReferenceModel &reference, PelvisModel &model)
  {
    EquilibriumSystem &system = model.system;
    for (const dataset::ReferenceShell &shell : reference.shells)
    {
      const int first = add_shell_unknowns(system, shell_body(shell));
      shells_[shell.name] = {&shell, first};
      hold(shell.name, shell.fixed_nodes, first, n_shell_unknowns, model);
    }
    for (const dataset::ReferenceSolid &solid : reference.solids)
    {
      const int first = system.add_unknowns(3 * static_cast<int>(solid.points.rows()), {solid.name});
      solids_[solid.name] = {&solid, first};
      hold(solid.name, solid.fixed_nodes, first, 3, model);
    }
  }

  int first_unknown(const std::string &part) const
  {
    const auto shell = shells_.find(part);
    return shell != shells_.end() ? shell->second.second : solids_.at(part).second;
  }

  /// Mid-surface of a shell's node, or node of a solid.
  SurfaceNode node(const std::string &part, int node) const
  {
    if (const auto shell = shells_.find(part); shell != shells_.end())
      return shell_node(*shell->second.first, shell->second.second, node, 0);
    const auto &[solid, first] = solids_.at(part);
    return solid_node(*solid, first, node);
  }

  /// Outer faces of one region, or of all.
  std::vector<SurfaceFace> outer_faces(const std::string &part, std::optional<SurfaceRegion> region = {}) const
  {
    const auto is_wanted = [&](std::int32_t code) { return !region || code == static_cast<std::int32_t>(*region); };
    std::vector<SurfaceFace> faces;
    if (const auto found = shells_.find(part); found != shells_.end())
    {
      const auto &[shell, first] = found->second;
      for (Eigen::Index c = 0; c < shell->cells.rows(); ++c)
        if (is_wanted(shell->region[c]))
          faces.push_back(shell_face(*shell, first, c, +1));
      return faces;
    }
    const auto &[solid, first] = solids_.at(part);
    for (Eigen::Index f = 0; f < solid->faces.rows(); ++f)
      if (is_wanted(solid->region[f]))
        faces.push_back(solid_face(*solid, first, f));
    return faces;
  }

  /// Outer faces that carry some abdominal pressure, with its shares at their nodes.
  void append_loaded_faces(const std::string &part, std::vector<SurfaceFace> &faces,
                           std::vector<Eigen::VectorXd> &shares) const
  {
    const auto append = [&](const Eigen::VectorXd &share, const SurfaceFace &face)
    {
      if (share.isZero(0))
        return;
      faces.push_back(face);
      shares.push_back(share);
    };
    if (const auto found = shells_.find(part); found != shells_.end())
    {
      const auto &[shell, first] = found->second;
      for (Eigen::Index c = 0; c < shell->cells.rows(); ++c)
        append(pressure_shares(*shell, c), shell_face(*shell, first, c, +1));
      return;
    }
    const auto &[solid, first] = solids_.at(part);
    for (Eigen::Index f = 0; f < solid->faces.rows(); ++f)
      append(pressure_shares(*solid, f), solid_face(*solid, first, f));
  }

private:
  static void hold(const std::string &part, const dataset::Integers &nodes, int first, int n_unknowns_a_node,
                   PelvisModel &model)
  {
    if (nodes.size() == 0)
      return;
    HeldNodes held{part, {}};
    for (const std::int32_t node : nodes)
    {
      held.first_unknowns.push_back(first + n_unknowns_a_node * node);
      for (int k = 0; k < 3; ++k)
        model.system.fix(held.first_unknowns.back() + k);
    }
    model.held_nodes.push_back(std::move(held));
  }

  std::map<std::string, std::pair<const dataset::ReferenceShell *, int>> shells_;
  std::map<std::string, std::pair<const dataset::ReferenceSolid *, int>> solids_;
};

std::shared_ptr<const HyperelasticLaw> yeoh(const dataset::YeohMaterial &m)
{
  return std::make_shared<Yeoh>(m.c10, m.c20, m.c30, m.kappa);
}

std::vector<std::string> part_names(const ReferenceModel &reference)
{
  std::vector<std::string> names;
  for (const dataset::ReferenceShell &shell : reference.shells)
    names.push_back(shell.name);
  for (const dataset::ReferenceSolid &solid : reference.solids)
    names.push_back(solid.name);
  return names;
}

void add_elements(const ReferenceModel &reference, const Parts &parts, PelvisModel &model)
{
  for (const dataset::ReferenceShell &shell : reference.shells)
  {
    model.shells.push_back(std::make_shared<ShellTerm>(shell_body(shell), yeoh(reference.materials.at(shell.material)),
                                                       parts.first_unknown(shell.name), true));
    model.system.add_term(model.shells.back());
  }
  for (const dataset::ReferenceSolid &solid : reference.solids)
    model.system.add_term(std::make_shared<QuadraticTetrahedra>(solid, reference.materials.at(solid.material),
                                                                parts.first_unknown(solid.name)));
  for (const dataset::ReferenceTruss &truss : reference.trusses)
  {
    Bar bar;
    bar.group = truss.group;
    bar.nodes.push_back(parts.node(truss.part_a, truss.node_a));
    if (truss.part_b.empty())
      bar.fixed_end = truss.fixed_point;
    else
    {
      bar.nodes.push_back(parts.node(truss.part_b, truss.node_b));
      bar.nodes.back().rest += truss.offset_b;
    }
    bar.area = truss.area;
    bar.material = reference.materials.at(truss.material);
    bar.tension_only = truss.tension_only;
    model.bars.push_back(bar);
  }
  model.system.add_term(std::make_shared<Trusses>(model.bars));
  model.n_strain_terms = static_cast<int>(model.system.terms().size());
}

void add_cavities(const ReferenceModel &reference, const Parts &parts, PelvisModel &model)
{
  for (const dataset::ReferenceShell &shell : reference.shells)
  {
    if (!shell.has_cavity)
      continue;
    const int first = parts.first_unknown(shell.name);
    std::vector<SurfaceFace> faces;
    for (Eigen::Index c = 0; c < shell.cells.rows(); ++c)
      faces.push_back(shell_face(shell, first, c, -1));
    for (const dataset::Integers &rim : shell.rims)
    {
      std::vector<SurfaceNode> loop;
      for (const int node : oriented_rim(shell, rim))
        loop.push_back(shell_node(shell, first, node, -1));
      const std::vector<SurfaceFace> caps = rim_caps(loop);
      faces.insert(faces.end(), caps.begin(), caps.end());
    }
    // A row of the volume is compared with 1 N as 1e-6 of 1000 mm^3: 1e-3 mm^3 at the tolerance of 1e-6 N.
    const int pressure = model.system.add_unknowns(1, {"pressure of " + shell.name, 1e3});
    model.cavities.push_back(std::make_shared<Cavity>(shell.name, std::move(faces), pressure));
    model.system.add_term(model.cavities.back());
    if (shell.cavity.mode == dataset::CavityMode::leak)
      model.cavities.back()->leak(shell.cavity.leak_rate);
    if (shell.cavity.mode == dataset::CavityMode::pressure)
      model.cavities.back()->prescribe_pressure(shell.cavity.pressure / reference.n_increments);
  }
}

void add_ties(const ReferenceModel &reference, const Parts &parts, PelvisModel &model)
{
  for (const auto &[a, b] : reference.ties)
  {
    // The patch of b on whatever part of a it lies: on a coarse mesh a's own patch of whole cells is another area.
    const auto patch = parts.outer_faces(b, SurfaceRegion::cervix_patch);
    if (patch.empty())
      throw InputError(
          fmt::format("tie {}–{}: part '{}' has no cell of region cervix_patch; mark the shared patch", a, b, b));
    model.ties.push_back(std::make_shared<Tie>("tie " + a + "–" + b, patch, parts.outer_faces(a)));
    model.system.add_term(model.ties.back());
  }
}

/// Walls and peritoneal faces, up to their fixed edges.
ContactFaces contact_faces(const Parts &parts, const std::string &part)
{
  ContactFaces contact{part, {}};
  for (const SurfaceRegion region : {SurfaceRegion::wall, SurfaceRegion::peritoneal})
    for (SurfaceFace &face : parts.outer_faces(part, region))
      contact.faces.push_back(std::move(face));
  return contact;
}

void add_contact(const ReferenceModel &reference, const Parts &parts, PelvisModel &model)
{
  if (reference.contact_pairs.empty())
    return;
  std::vector<ContactFaces> surfaces;
  std::map<std::string, int> index;
  for (const std::string &part : part_names(reference))
  {
    index[part] = static_cast<int>(surfaces.size());
    surfaces.push_back(contact_faces(parts, part));
  }
  std::vector<std::pair<int, int>> pairs;
  for (const auto &[a, b] : reference.contact_pairs)
    pairs.emplace_back(index.at(a), index.at(b));
  // A wide onset spreads the traction over the coarse nodes of a soft wall: 0.12 MPa when the surfaces just meet.
  ContactOptions options;
  options.penalty = 0.8;
  options.onset = 0.6;
  options.stiffening = 150; // 1.4 MPa at a depth of 0.1 mm
  model.contact = std::make_shared<PenaltyContact>(std::move(surfaces), pairs, options);
  model.system.add_term(model.contact);
}

void add_load(const dataset::Anatomy &anatomy, const Parts &parts, PelvisModel &model)
{
  // A length of 1 mm is compared as 1 N.
  model.pressure_unknown = model.system.add_unknowns(1, {"abdominal pressure"});
  std::vector<SurfaceFace> loaded;
  std::vector<Eigen::VectorXd> shares;
  for (const std::string &name : part_names(anatomy.reference))
    parts.append_loaded_faces(name, loaded, shares);
  if (loaded.empty())
    throw InputError("no part has a cell of region peritoneal, so nothing carries the abdominal pressure; mark the "
                     "peritoneal surfaces in the anatomy");
  model.load = std::make_shared<FollowerPressure>(std::move(loaded), model.pressure_unknown, std::move(shares));
  model.system.add_term(model.load);
  for (const OuterSurface &surface : model.surfaces)
    if (surface.part == "vagina")
      model.probe = std::make_shared<DisplacementProbe>(
          probe_points(surface.vertices, surface.triangles, surface.region, anatomy.dyn_plane),
          anatomy.dyn_plane.normal, model.pressure_unknown);
  if (!model.probe)
    throw InputError("no part is called 'vagina', whose displacement controls the load; name one so");
  model.system.add_term(model.probe);

  std::vector<SurfaceNode> points;
  for (const OuterSurface &surface : model.surfaces)
    for (SurfaceNode vertex : surface.vertices)
    {
      vertex.side = 0;
      points.push_back(vertex);
    }
  model.path = std::make_shared<PathControl>(std::move(points), model.pressure_unknown);
  model.system.add_term(model.path);
}
} // namespace

PelvisModel build_pelvis_model(const dataset::Anatomy &anatomy, int n_threads)
{
  PelvisModel model(n_threads);
  const ReferenceModel &reference = anatomy.reference;
  const Parts parts(reference, model);
  for (const dataset::ReferenceShell &shell : reference.shells)
    model.surfaces.push_back(outer_surface(shell, parts.first_unknown(shell.name)));
  for (const dataset::ReferenceSolid &solid : reference.solids)
    model.surfaces.push_back(outer_surface(solid, parts.first_unknown(solid.name)));

  add_elements(reference, parts, model);
  add_cavities(reference, parts, model);
  add_ties(reference, parts, model);
  add_contact(reference, parts, model);
  add_load(anatomy, parts, model);
  return model;
}
} // namespace pelvireg::reference_fe
