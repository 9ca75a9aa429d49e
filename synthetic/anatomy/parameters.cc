#include "synthetic/anatomy/parameters.h"

#include "synthetic/anatomy/table_reader.h"
#include "synthetic/dataset/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

namespace pelvireg::anatomy
{
namespace
{
const std::vector<std::string> reference_parts = {"bladder", "vagina", "uterus", "rectum", "pelvic_floor"};
const std::vector<std::string> registration_bodies = {"bladder",       "vagina",        "uterus",   "rectum",
                                                      "fascia_pelvis", "fascia_sacrum", "ligaments"};
// Thicker walls than this fold when they are extruded inward (DESIGN 5.1).
constexpr double max_wall_over_radius = 0.8;

void check_wall(TableReader &table, double wall, double radius, const std::string &radius_key)
{
  if (!(wall <= max_wall_over_radius * radius))
    table.fail("wall",
               fmt::format("is {} mm, but at most {} times the smallest outer radius ({} = {} mm) keeps the wall "
                           "from folding; make the wall thinner or the organ thicker.",
                           wall, max_wall_over_radius, radius_key, radius));
}

std::vector<double> fillets(TableReader &table, const std::vector<Eigen::Vector3d> &axis)
{
  return table.numbers("fillet_radii", positive, axis.size() - 2, axis.size() - 2);
}

BladderShape read_bladder(TableReader table)
{
  BladderShape shape;
  shape.centre = table.point("centre");
  shape.semi_axes = table.point("semi_axes", positive);
  shape.dome_flattening = table.number("dome_flattening", {0, 0.5, false});
  shape.neck_direction = table.point("neck_direction");
  shape.neck_length = table.number("neck_length", {0, 20, false});
  shape.neck_width = table.number("neck_width", {0.2, 2, false});
  shape.impression_direction = table.point("impression_direction");
  shape.impression_depth = table.number("impression_depth", {0, 20, false});
  shape.impression_width = table.number("impression_width", {0.2, 2, false});
  shape.wall = table.number("wall", positive);
  shape.peritoneal_above = table.number("peritoneal_above", any_number);
  shape.peritoneal_fade = table.number("peritoneal_fade", positive);
  check_wall(table, shape.wall, shape.semi_axes.minCoeff(), "semi_axes");
  if (shape.neck_direction.norm() == 0 || shape.impression_direction.norm() == 0)
    table.fail("neck_direction", "or impression_direction is zero; give a direction from the centre.");
  table.finish();
  return shape;
}

VaginaShape read_vagina(TableReader table)
{
  VaginaShape shape;
  shape.axis = table.points("axis", 3);
  shape.fillet_radii = fillets(table, shape.axis);
  shape.half_depth = table.number("half_depth", positive);
  shape.widths = table.numbers("widths", positive, 2);
  shape.width_stations = table.stations("width_stations", shape.widths.size(), "widths");
  shape.wall = table.number("wall", positive);
  check_wall(table, shape.wall, shape.half_depth, "half_depth");
  for (const double width : shape.widths)
    if (!(width > 2 * shape.half_depth))
      table.fail("widths", fmt::format("contains {} mm, but more than twice half_depth ({} mm) is needed; widen it.",
                                       width, 2 * shape.half_depth));
  for (std::size_t i = 0; i < shape.axis.size(); ++i)
    if (shape.axis[i][0] != shape.axis[0][0])
      table.fail("axis", "leaves the sagittal plane; give all its points the same x.");
  table.finish();
  return shape;
}

UterusShape read_uterus(TableReader table)
{
  UterusShape shape;
  shape.patch_distance = table.number("patch_distance", positive);
  shape.internal_os = table.point("internal_os");
  shape.fundus = table.point("fundus");
  shape.fillet_radius = table.number("fillet_radius", positive);
  shape.deviation = table.number("deviation", {-30, 30, false});
  shape.cervix_sleeve = table.number("cervix_sleeve", positive);
  shape.half_widths = table.numbers("half_widths", positive, 2);
  shape.half_depths = table.numbers("half_depths", positive, shape.half_widths.size(), shape.half_widths.size());
  shape.stations = table.stations("stations", shape.half_widths.size(), "half_widths");
  shape.fundus_length = table.number("fundus_length", positive);
  shape.peritoneal_from = table.number("peritoneal_from", any_number);
  shape.peritoneal_fade = table.number("peritoneal_fade", positive);
  if (shape.half_widths.front() != shape.half_depths.front())
    table.fail("half_depths[0]", "differs from half_widths[0], but the cervix is round at the patch; make them equal.");
  table.finish();
  return shape;
}

RectumShape read_rectum(TableReader table)
{
  RectumShape shape;
  shape.axis = table.points("axis", 3);
  shape.fillet_radii = fillets(table, shape.axis);
  shape.radii = table.numbers("radii", positive, 2);
  shape.radius_stations = table.stations("radius_stations", shape.radii.size(), "radii");
  shape.wall = table.number("wall", positive);
  shape.peritoneal_above = table.number("peritoneal_above", any_number);
  shape.peritoneal_fade = table.number("peritoneal_fade", positive);
  check_wall(table, shape.wall, *std::min_element(shape.radii.begin(), shape.radii.end()), "radii");
  table.finish();
  return shape;
}

FloorShape read_floor(TableReader table)
{
  FloorShape shape;
  shape.hiatus = table.points("hiatus", 4);
  shape.edge = table.points("edge", 4);
  if (shape.hiatus.size() != shape.edge.size())
    table.fail("edge",
               fmt::format("has {} points, but hiatus has {}; give as many.", shape.edge.size(), shape.hiatus.size()));
  shape.sag = table.number("sag", {-20, 30, false});
  shape.thickness = table.number("thickness", positive);
  shape.edge_radius = table.number("edge_radius", {0, 30, false});
  table.finish();
  return shape;
}

Support read_support(TableReader table, const Parameters &parameters)
{
  Support support;
  support.name = table.text("name");
  support.body = table.text("body");
  support.kind = table.text("kind");
  support.organ = table.text("organ");
  support.material = table.text("material");
  support.organ_point = table.point("organ_point");
  support.organ_span = table.point("organ_span");
  support.far_point = table.point("far_point");
  support.far_span = table.point("far_span");
  support.area_left = table.number("area_left", positive);
  support.area_right = table.number("area_right", positive);
  support.n_bars = table.integer("n_bars", 8, 500);
  support.tension_only = table.flag("tension_only", false);
  support.band_cells = table.integers("band_cells", 1, 50, 3);
  const auto refuse_unless =
      [&](const std::string &key, const std::string &value, const std::vector<std::string> &allowed)
  {
    if (std::find(allowed.begin(), allowed.end(), value) == allowed.end())
      table.fail(key, fmt::format("is '{}', but one of {} is needed; choose one.", value, fmt::join(allowed, ", ")));
  };
  refuse_unless("body", support.body, {"fascia_pelvis", "fascia_sacrum", "ligaments"});
  refuse_unless("kind", support.kind, {"ligament", "fascia"});
  refuse_unless("organ", support.organ, dataset::organ_names);
  std::vector<std::string> materials;
  for (const auto &[name, material] : parameters.materials)
    materials.push_back(name);
  refuse_unless("material", support.material, materials);
  if (support.organ_span.norm() == 0 || support.far_span.norm() == 0)
    table.fail("organ_span", "or far_span is zero; give the side of the patch along which the bars spread.");
  table.finish();
  return support;
}

/// Units of the case file: kPa, and mm^3 per kPa and increment.
CavityFilling read_cavity(TableReader table)
{
  constexpr double kPa = 1e-3; // MPa
  CavityFilling filling;
  const std::string mode = table.text("mode");
  filling.is_open = mode == "open";
  if (mode == "leak")
    filling.control = {dataset::CavityMode::leak, table.number("rate", positive) / kPa, 0};
  else if (mode == "pressure")
    filling.control = {dataset::CavityMode::pressure, 0, table.number("pressure", {-100, 100, false}) * kPa};
  else if (mode != "closed" && mode != "open")
    table.fail("mode", fmt::format("is '{}', but one of closed, leak, pressure, open is needed; choose one.", mode));
  table.finish();
  return filling;
}

void read_cavities(TableReader table, Parameters &parameters)
{
  for (const std::string organ : {"bladder", "vagina", "rectum"})
    if (table.has(organ))
      parameters.cavities[organ] = read_cavity(table.table(organ));
  for (const std::string &organ : table.keys())
    if (!parameters.cavities.contains(organ))
      table.fail(organ, "encloses no fluid; only bladder, vagina and rectum do: remove it or correct its name.");
}

void read_materials(TableReader table, Parameters &parameters)
{
  const double ratio = table.number("kappa_over_2c10", {10, 1e5, false});
  for (const std::string &name : table.keys())
  {
    if (name == "kappa_over_2c10")
      continue;
    TableReader material = table.table(name);
    dataset::YeohMaterial &yeoh = parameters.materials[name];
    yeoh.c10 = material.number("c10", positive);
    yeoh.c20 = material.number("c20", not_negative);
    yeoh.kappa = 2 * ratio * yeoh.c10;
    material.finish();
  }
  table.finish();
}

void read_reference(TableReader table, Parameters &parameters)
{
  TableReader sizes = table.table("cell_size");
  for (const std::string part : {"bladder", "vagina", "uterus", "rectum", "pelvic_floor"})
    parameters.cell_size[part] = sizes.number(part, {2, 30, false});
  sizes.finish();
  TableReader materials = table.table("material_of");
  for (const std::string part :
       {"bladder", "vagina", "uterus", "rectum", "pelvic_floor", "urethra", "retropubic", "hiatus"})
  {
    const std::string material = materials.text(part);
    if (parameters.materials.count(material) == 0)
      materials.fail(
          part, fmt::format("is '{}', which [materials] does not define; define it or correct the name.", material));
    parameters.material_of[part] = material;
  }
  materials.finish();
  table.finish();
}

void read_registration(TableReader table, Parameters &parameters)
{
  parameters.poisson_ratio = table.number("poisson_ratio", {0, 0.499, false});
  parameters.density = table.number("density", {0, 1e-6, true});
  parameters.time_step = table.number("time_step", {0, 10, true});
  parameters.friction_coefficient = table.number("friction_coefficient", {0, 10, false});
  parameters.steps_per_increment = table.integer("steps_per_increment", 1, 100);
  parameters.n_control_points = table.integer("n_control_points", 10, 1000);
  if (table.has("insertion_shift"))
    parameters.insertion_shift = table.point("insertion_shift", {-20, 20, false});
  TableReader nodes = table.table("nodes"), moduli = table.table("youngs_modulus");
  for (const std::string &body : registration_bodies)
  {
    parameters.youngs_modulus[body] = moduli.number(body, positive);
    if (body != "fascia_pelvis" && body != "fascia_sacrum" && body != "ligaments")
      parameters.registration_nodes[body] = nodes.integer(body, 50, 20000);
  }
  nodes.finish();
  moduli.finish();
  table.finish();
}

void read_plane_and_load(TableReader plane, TableReader load, Parameters &parameters)
{
  parameters.plane_offset = plane.number("offset", {-30, 30, false});
  parameters.plane_tilt = plane.number("tilt", {-30, 30, false});
  parameters.plane_centre = plane.point("centre");
  parameters.slice_pitch = plane.number("slice_pitch", positive);
  parameters.n_slices_each_side = plane.integer("n_slices_each_side", 1, 50);
  plane.finish();
  parameters.target_displacement = load.number("target_displacement", {0, 100, true});
  parameters.n_increments = load.integer("n_increments", 1, 1000);
  load.finish();
}

void read_retropubic(TableReader table, Parameters &parameters)
{
  parameters.retropubic_normal = table.point("normal").normalized();
  if (!(parameters.retropubic_normal.norm() > 0))
    table.fail("normal", "is zero, but a direction from the bone towards the bladder is needed; give one.");
  parameters.retropubic_depth = table.number("depth", positive);
  parameters.retropubic_area = table.number("area", positive);
  parameters.retropubic_half_width = table.number("half_width", positive);
  table.finish();
}

void read_urethra_and_hiatus(TableReader urethra, TableReader membrane, Parameters &parameters)
{
  parameters.urethra_far = urethra.point("far_point");
  parameters.urethra_area = urethra.number("area", positive);
  parameters.urethra_radius = urethra.number("radius", positive);
  parameters.urethra_far_radius = urethra.number("far_radius", positive);
  parameters.urethra_bars = urethra.integer("n_bars", 8, 200);
  urethra.finish();
  parameters.hiatus_reach = membrane.number("reach", positive);
  parameters.hiatus_area_per_length = membrane.number("area_per_length", positive);
  membrane.finish();
}
} // namespace

Parameters read_parameters(const std::string &text, const std::string &case_name)
{
  toml::table document;
  try
  {
    document = toml::parse(text);
  }
  catch (const toml::parse_error &error)
  {
    throw InputError(fmt::format("Case '{}' is not valid TOML at line {}: {}; correct that line.", case_name,
                                 error.source().begin.line, error.description()));
  }
  TableReader root(document, "", case_name);
  Parameters parameters;
  parameters.name = root.text("name");
  parameters.description = root.text("description");
  if (root.has("self_generated_from"))
    root.text("self_generated_from"); // for whoever makes the truth: the pelvis does not depend on it
  read_plane_and_load(root.table("plane"), root.table("load"), parameters);
  read_materials(root.table("materials"), parameters);
  read_reference(root.table("reference"), parameters);
  read_registration(root.table("registration"), parameters);
  parameters.bladder = read_bladder(root.table("bladder"));
  parameters.vagina = read_vagina(root.table("vagina"));
  parameters.uterus = read_uterus(root.table("uterus"));
  parameters.rectum = read_rectum(root.table("rectum"));
  parameters.pelvic_floor = read_floor(root.table("pelvic_floor"));
  read_urethra_and_hiatus(root.table("urethra"), root.table("hiatus_membrane"), parameters);
  read_retropubic(root.table("retropubic"), parameters);
  for (TableReader &support : root.tables("support"))
    parameters.supports.push_back(read_support(support, parameters));
  if (root.has("cavity"))
    read_cavities(root.table("cavity"), parameters);
  root.finish();
  return parameters;
}
} // namespace pelvireg::anatomy
