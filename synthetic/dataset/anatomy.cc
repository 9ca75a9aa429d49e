#include "synthetic/dataset/anatomy_groups.h"

namespace pelvireg::dataset
{
namespace
{
constexpr const char *format = "pelvireg anatomy";
constexpr int n_regions = 4; // SurfaceRegion

void write_body(GroupWriter group, const RegistrationBody &body)
{
  group.number("youngs_modulus_MPa", body.youngs_modulus);
  group.number("poisson_ratio", body.poisson_ratio);
  group.number("density_t_per_mm3", body.density);
  group.array("points", body.points);
  group.array("tets", body.tets);
  group.array("hexes", body.hexes);
  group.array("fixed_nodes", body.fixed_nodes);
  group.array("outer_triangles", body.outer_triangles);
  group.array("outer_region", body.outer_region);
}

RegistrationBody read_body(const GroupReader &group, const std::string &name)
{
  RegistrationBody body;
  body.name = name;
  body.youngs_modulus = group.number("youngs_modulus_MPa");
  body.poisson_ratio = group.number("poisson_ratio");
  body.density = group.number("density_t_per_mm3");
  body.points = group.array<Points>("points");
  const Eigen::Index n_nodes = body.points.rows();
  body.tets = group.indices<Tets>("tets", n_nodes);
  body.hexes = group.indices<Hexes>("hexes", n_nodes);
  body.fixed_nodes = group.indices<Integers>("fixed_nodes", n_nodes);
  body.outer_triangles = group.indices<Triangles>("outer_triangles", n_nodes);
  body.outer_region = group.indices<Integers>("outer_region", n_regions);
  if (body.outer_region.size() != body.outer_triangles.rows())
    group.refuse("outer_region", "has not one entry a triangle");
  return body;
}

Eigen::Index n_nodes_of(const RegistrationModel &model, const std::string &name)
{
  for (const RegistrationBody &body : model.bodies)
    if (body.name == name)
      return body.points.rows();
  return 0;
}

void write_attachment(GroupWriter group, const RegistrationAttachment &attachment)
{
  group.text("kind", attachment.kind);
  group.text("body_a", attachment.body_a);
  group.text("body_b", attachment.body_b);
  group.array("nodes_a", attachment.nodes_a);
}

RegistrationAttachment read_attachment(const GroupReader &group, const std::string &name,
                                       const RegistrationModel &model)
{
  RegistrationAttachment attachment;
  attachment.name = name;
  attachment.kind = group.text("kind");
  attachment.body_a = group.text("body_a");
  attachment.body_b = group.text("body_b");
  if (n_nodes_of(model, attachment.body_b) == 0)
    group.refuse("body_b", "names the body '" + attachment.body_b + "', which does not exist");
  attachment.nodes_a = group.indices<Integers>("nodes_a", n_nodes_of(model, attachment.body_a));
  return attachment;
}

void write_registration(GroupWriter group, const RegistrationModel &model)
{
  GroupWriter bodies = group.group("bodies");
  bodies.texts("names", names_of(model.bodies));
  for (const RegistrationBody &body : model.bodies)
    write_body(bodies.group(body.name), body);
  GroupWriter attachments = group.group("attachments");
  attachments.texts("names", names_of(model.attachments));
  for (const RegistrationAttachment &attachment : model.attachments)
    write_attachment(attachments.group(attachment.name), attachment);
}

RegistrationModel read_registration(const GroupReader &group)
{
  RegistrationModel model;
  const GroupReader bodies = group.group("bodies");
  for (const std::string &name : bodies.texts("names"))
    model.bodies.push_back(read_body(bodies.group(name), name));
  const GroupReader attachments = group.group("attachments");
  for (const std::string &name : attachments.texts("names"))
    model.attachments.push_back(read_attachment(attachments.group(name), name, model));
  return model;
}
} // namespace

void save(const Anatomy &anatomy, const std::filesystem::path &file)
{
  StoreWriter writer(file, format);
  GroupWriter &root = writer.root();
  root.text("case_name", anatomy.case_name);
  root.integer("n_control_points", anatomy.n_control_points);
  root.number("control_point_spacing_mm", anatomy.control_point_spacing);
  root.number("slice_pitch_mm", anatomy.slice_pitch);
  root.integer("n_slices_each_side", anatomy.n_slices_each_side);
  root.integer("registration_steps_per_increment", anatomy.registration_steps_per_increment);
  root.number("registration_time_step_s", anatomy.registration_time_step);
  root.number("registration_friction", anatomy.registration_friction);
  write_plane(root, "dyn_plane", anatomy.dyn_plane);
  write_reference(root.group("reference"), anatomy.reference);
  write_registration(root.group("registration"), anatomy.registration);
  writer.finish();
}

Anatomy load_anatomy(const std::filesystem::path &file)
{
  const StoreReader reader(file, format);
  const GroupReader &root = reader.root();
  Anatomy anatomy;
  anatomy.case_name = root.text("case_name");
  anatomy.n_control_points = root.integer("n_control_points");
  anatomy.control_point_spacing = root.number("control_point_spacing_mm");
  anatomy.slice_pitch = root.number("slice_pitch_mm");
  anatomy.n_slices_each_side = root.integer("n_slices_each_side");
  anatomy.registration_steps_per_increment = root.integer("registration_steps_per_increment");
  anatomy.registration_time_step = root.number("registration_time_step_s");
  anatomy.registration_friction = root.number("registration_friction");
  anatomy.dyn_plane = read_plane(root, "dyn_plane");
  anatomy.reference = read_reference(root.group("reference"));
  anatomy.registration = read_registration(root.group("registration"));
  return anatomy;
}
} // namespace pelvireg::dataset
