#include "synthetic/dataset/anatomy_groups.h"

#include <algorithm>

namespace pelvireg::dataset
{
namespace
{
constexpr int n_regions = 4; // SurfaceRegion

void write_materials(GroupWriter &reference, const std::map<std::string, YeohMaterial> &materials)
{
  GroupWriter group = reference.group("materials");
  for (const auto &[name, material] : materials)
  {
    GroupWriter entry = group.group(name);
    entry.number("c10_MPa", material.c10);
    entry.number("c20_MPa", material.c20);
    entry.number("c30_MPa", material.c30);
    entry.number("kappa_MPa", material.kappa);
  }
  std::vector<std::string> names;
  for (const auto &[name, material] : materials)
    names.push_back(name);
  group.texts("names", names);
}

std::map<std::string, YeohMaterial> read_materials(const GroupReader &reference)
{
  const GroupReader group = reference.group("materials");
  std::map<std::string, YeohMaterial> materials;
  for (const std::string &name : group.texts("names"))
  {
    const GroupReader entry = group.group(name);
    materials[name] = {.c10 = entry.number("c10_MPa"),
                       .c20 = entry.number("c20_MPa"),
                       .c30 = entry.number("c30_MPa"),
                       .kappa = entry.number("kappa_MPa")};
  }
  return materials;
}

const std::vector<std::string> cavity_modes = {"closed", "leak", "pressure"}; // in the order of CavityMode

void write_cavity(GroupWriter group, const CavityControl &cavity)
{
  group.text("mode", cavity_modes.at(static_cast<std::size_t>(cavity.mode)));
  group.number("leak_rate_mm3_per_MPa_and_increment", cavity.leak_rate);
  group.number("pressure_MPa", cavity.pressure);
}

CavityControl read_cavity(const GroupReader &group)
{
  const auto mode = std::find(cavity_modes.begin(), cavity_modes.end(), group.text("mode"));
  if (mode == cavity_modes.end())
    group.refuse("mode", "is none of closed, leak, pressure");
  return {static_cast<CavityMode>(mode - cavity_modes.begin()), group.number("leak_rate_mm3_per_MPa_and_increment"),
          group.number("pressure_MPa")};
}

/// Loops of different length as one array and the start of each.
void write_rims(GroupWriter &group, const std::vector<Integers> &rims)
{
  std::vector<std::int32_t> nodes, starts = {0};
  for (const Integers &rim : rims)
  {
    nodes.insert(nodes.end(), rim.data(), rim.data() + rim.size());
    starts.push_back(static_cast<std::int32_t>(nodes.size()));
  }
  group.integers("rim_nodes", nodes);
  group.integers("rim_start", starts);
}

std::vector<Integers> read_rims(const GroupReader &group, std::int64_t n_nodes)
{
  const Integers nodes = group.indices<Integers>("rim_nodes", n_nodes);
  const Integers starts = group.indices<Integers>("rim_start", nodes.size() + 1);
  if (starts.size() == 0 || starts[0] != 0 || starts[starts.size() - 1] != nodes.size())
    group.refuse("rim_start", "does not cover the rim nodes");
  std::vector<Integers> rims;
  for (Eigen::Index i = 0; i + 1 < starts.size(); ++i)
  {
    if (starts[i + 1] < starts[i])
      group.refuse("rim_start", "is not ascending");
    rims.emplace_back(nodes.segment(starts[i], starts[i + 1] - starts[i]));
  }
  return rims;
}

/// Optional: absent where whole faces of region peritoneal carry the pressure.
void write_pressure_share(GroupWriter &group, const Eigen::VectorXd &share)
{
  if (share.size() > 0)
    group.array("pressure_share", share);
}

Eigen::VectorXd read_pressure_share(const GroupReader &group, Eigen::Index n_nodes)
{
  if (!group.has("pressure_share"))
    return {};
  Eigen::VectorXd share = group.array<Eigen::VectorXd>("pressure_share", n_nodes);
  if (!(share.array() >= 0).all() || !(share.array() <= 1).all())
    group.refuse("pressure_share", "leaves 0 to 1");
  return share;
}

void write_shell(GroupWriter group, const ReferenceShell &shell)
{
  group.text("material", shell.material);
  group.integer("has_cavity", shell.has_cavity);
  write_cavity(group.group("cavity"), shell.cavity);
  group.array("midsurface", shell.midsurface);
  group.array("directors", shell.directors);
  group.array("thickness", shell.thickness);
  group.array("cells", shell.cells);
  group.array("region", shell.region);
  write_pressure_share(group, shell.pressure_share);
  group.array("fixed_nodes", shell.fixed_nodes);
  write_rims(group, shell.rims);
}

ReferenceShell read_shell(const GroupReader &group, const std::string &name)
{
  ReferenceShell shell;
  shell.name = name;
  shell.material = group.text("material");
  shell.has_cavity = group.integer("has_cavity") != 0;
  shell.cavity = read_cavity(group.group("cavity"));
  shell.midsurface = group.array<Points>("midsurface");
  const Eigen::Index n_nodes = shell.midsurface.rows();
  shell.directors = group.array<Points>("directors", n_nodes);
  shell.thickness = group.array<Eigen::VectorXd>("thickness", n_nodes);
  shell.cells = group.indices<Quads9>("cells", n_nodes);
  shell.region = group.indices<Integers>("region", n_regions);
  if (shell.region.size() != shell.cells.rows())
    group.refuse("region", "has not one entry a cell");
  shell.pressure_share = read_pressure_share(group, n_nodes);
  shell.fixed_nodes = group.indices<Integers>("fixed_nodes", n_nodes);
  shell.rims = read_rims(group, n_nodes);
  return shell;
}

void write_solid(GroupWriter group, const ReferenceSolid &solid)
{
  group.text("material", solid.material);
  group.array("points", solid.points);
  group.array("cells", solid.cells);
  group.array("faces", solid.faces);
  group.array("region", solid.region);
  write_pressure_share(group, solid.pressure_share);
  group.array("fixed_nodes", solid.fixed_nodes);
}

ReferenceSolid read_solid(const GroupReader &group, const std::string &name)
{
  ReferenceSolid solid;
  solid.name = name;
  solid.material = group.text("material");
  solid.points = group.array<Points>("points");
  const Eigen::Index n_nodes = solid.points.rows();
  solid.cells = group.indices<Tets10>("cells", n_nodes);
  solid.faces = group.indices<Triangles6>("faces", n_nodes);
  solid.region = group.indices<Integers>("region", n_regions);
  if (solid.region.size() != solid.faces.rows())
    group.refuse("region", "has not one entry a face");
  solid.pressure_share = read_pressure_share(group, n_nodes);
  solid.fixed_nodes = group.indices<Integers>("fixed_nodes", n_nodes);
  return solid;
}

void write_trusses(GroupWriter group, const std::vector<ReferenceTruss> &trusses)
{
  std::vector<std::string> groups, parts_a, parts_b, materials;
  std::vector<std::int32_t> nodes_a, nodes_b, tension_only;
  std::vector<double> areas;
  Points fixed_points(static_cast<Eigen::Index>(trusses.size()), 3), offsets(fixed_points.rows(), 3);
  for (const ReferenceTruss &truss : trusses)
  {
    fixed_points.row(static_cast<Eigen::Index>(areas.size())) = truss.fixed_point;
    offsets.row(static_cast<Eigen::Index>(areas.size())) = truss.offset_b;
    groups.push_back(truss.group);
    parts_a.push_back(truss.part_a);
    parts_b.push_back(truss.part_b);
    materials.push_back(truss.material);
    nodes_a.push_back(truss.node_a);
    nodes_b.push_back(truss.node_b);
    areas.push_back(truss.area);
    tension_only.push_back(truss.tension_only ? 1 : 0);
  }
  group.texts("group", groups);
  group.texts("part_a", parts_a);
  group.integers("node_a", nodes_a);
  group.texts("part_b", parts_b);
  group.integers("node_b", nodes_b);
  group.array("fixed_point", fixed_points);
  group.array("offset_b", offsets);
  group.numbers("area", areas);
  group.texts("material", materials);
  group.integers("tension_only", tension_only);
}

std::vector<ReferenceTruss> read_trusses(const GroupReader &group)
{
  const std::vector<std::string> groups = group.texts("group");
  const std::int64_t count = static_cast<std::int64_t>(groups.size());
  const auto column = [&](const char *name)
  {
    std::vector<std::string> values = group.texts(name);
    if (static_cast<std::int64_t>(values.size()) != count)
      group.refuse(name, "has not one entry a truss");
    return values;
  };
  const std::vector<std::string> parts_a = column("part_a"), parts_b = column("part_b"), materials = column("material");
  const std::vector<std::int32_t> nodes_a = group.integers("node_a", count), nodes_b = group.integers("node_b", count);
  const std::vector<std::int32_t> tension_only = group.integers("tension_only", count);
  const std::vector<double> areas = group.numbers("area", count);
  const Points fixed_points = group.array<Points>("fixed_point", count);
  const Points offsets =
      group.has("offset_b") ? group.array<Points>("offset_b", count) : Points(Points::Zero(count, 3));
  std::vector<ReferenceTruss> trusses;
  for (std::size_t i = 0; i < groups.size(); ++i)
    trusses.push_back({.group = groups[i],
                       .part_a = parts_a[i],
                       .node_a = nodes_a[i],
                       .part_b = parts_b[i],
                       .node_b = nodes_b[i],
                       .fixed_point = fixed_points.row(static_cast<Eigen::Index>(i)),
                       .area = areas[i],
                       .material = materials[i],
                       .tension_only = tension_only[i] != 0,
                       .offset_b = offsets.row(static_cast<Eigen::Index>(i))});
  return trusses;
}

using Pairs = std::vector<std::pair<std::string, std::string>>;

void write_pairs(GroupWriter &reference, const std::string &name, const Pairs &pairs)
{
  std::vector<std::string> first, second;
  for (const auto &[a, b] : pairs)
  {
    first.push_back(a);
    second.push_back(b);
  }
  GroupWriter group = reference.group(name);
  group.texts("part_a", first);
  group.texts("part_b", second);
}

Pairs read_pairs(const GroupReader &reference, const std::string &name)
{
  const GroupReader group = reference.group(name);
  const std::vector<std::string> first = group.texts("part_a"), second = group.texts("part_b");
  if (first.size() != second.size())
    group.refuse("part_b", "has not one entry a pair");
  Pairs pairs;
  for (std::size_t i = 0; i < first.size(); ++i)
    pairs.emplace_back(first[i], second[i]);
  return pairs;
}

/// Number of nodes of a part, or 0 when no part has this name.
Eigen::Index n_nodes_of(const ReferenceModel &model, const std::string &part)
{
  for (const ReferenceShell &shell : model.shells)
    if (shell.name == part)
      return shell.midsurface.rows();
  for (const ReferenceSolid &solid : model.solids)
    if (solid.name == part)
      return solid.points.rows();
  return 0;
}

void check_references(const ReferenceModel &model, const GroupReader &group)
{
  const auto require_material = [&](const std::string &name)
  {
    if (!model.materials.contains(name))
      group.refuse("materials", "lacks the material '" + name + "'");
  };
  const auto require_node = [&](const std::string &part, std::int32_t node)
  {
    if (node < 0 || node >= n_nodes_of(model, part))
      group.refuse("trusses", "ends at node " + std::to_string(node) + " of '" + part + "', which does not exist");
  };
  for (const ReferenceShell &shell : model.shells)
    require_material(shell.material);
  for (const ReferenceSolid &solid : model.solids)
    require_material(solid.material);
  for (const ReferenceTruss &truss : model.trusses)
  {
    require_material(truss.material);
    require_node(truss.part_a, truss.node_a);
    if (!truss.part_b.empty())
      require_node(truss.part_b, truss.node_b);
  }
  for (const Pairs &pairs : {model.contact_pairs, model.ties})
    for (const auto &[a, b] : pairs)
      if (n_nodes_of(model, a) == 0 || n_nodes_of(model, b) == 0)
        group.refuse("", "pairs '" + a + "' with '" + b + "', of which one does not exist");
}
} // namespace

void write_reference(GroupWriter group, const ReferenceModel &model)
{
  group.number("target_displacement_mm", model.target_displacement);
  group.integer("n_increments", model.n_increments);
  group.number("contact_friction", model.contact_friction);
  write_materials(group, model.materials);
  GroupWriter shells = group.group("shells");
  shells.texts("names", names_of(model.shells));
  for (const ReferenceShell &shell : model.shells)
    write_shell(shells.group(shell.name), shell);
  GroupWriter solids = group.group("solids");
  solids.texts("names", names_of(model.solids));
  for (const ReferenceSolid &solid : model.solids)
    write_solid(solids.group(solid.name), solid);
  write_trusses(group.group("trusses"), model.trusses);
  write_pairs(group, "contact_pairs", model.contact_pairs);
  write_pairs(group, "ties", model.ties);
}

ReferenceModel read_reference(const GroupReader &group)
{
  ReferenceModel model;
  model.target_displacement = group.number("target_displacement_mm");
  model.n_increments = group.integer("n_increments");
  model.contact_friction = group.number("contact_friction");
  model.materials = read_materials(group);
  const GroupReader shells = group.group("shells");
  for (const std::string &name : shells.texts("names"))
    model.shells.push_back(read_shell(shells.group(name), name));
  const GroupReader solids = group.group("solids");
  for (const std::string &name : solids.texts("names"))
    model.solids.push_back(read_solid(solids.group(name), name));
  model.trusses = read_trusses(group.group("trusses"));
  model.contact_pairs = read_pairs(group, "contact_pairs");
  model.ties = read_pairs(group, "ties");
  check_references(model, group);
  return model;
}
} // namespace pelvireg::dataset
