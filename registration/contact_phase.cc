#include "registration/constraints/contact_rows.h"
#include "registration/implementation.h"

#include <algorithm>
#include <numeric>
#include <set>

namespace pelvireg::registration
{
namespace
{
/// What an image shows, as a list of numbers.
void list_image(const Observation &observation, std::vector<double> &image)
{
  const auto append = [&image](const auto &values)
  { image.insert(image.end(), values.data(), values.data() + values.size()); };
  image.clear();
  append(observation.plane_origin);
  append(observation.plane_normal);
  for (const OutlineObservation &outline : observation.outlines)
  {
    image.push_back(outline.body);
    image.push_back(static_cast<double>(outline.points.rows()));
    append(outline.points);
    append(outline.normals);
  }
}

/// Flags of the triangles of `body` that may touch `other`: walls without a node that is attached to `other` or that
/// carries an attachment of it, and without a neighbour of such a node.
std::vector<char> touching_triangles(const Model &model, int body, int other,
                                     const std::vector<AttachedNode> &attached_nodes)
{
  std::set<int> attached;
  for (const AttachedNode &node : attached_nodes)
  {
    if (node.body_a == body && node.body_b == other)
      attached.insert(node.node_a);
    if (node.body_b == body && node.body_a == other)
      attached.insert(node.nodes_b.begin(), node.nodes_b.end());
  }
  const Triangles &triangles = model.bodies[body].outer_triangles;
  const auto touches = [&](const std::set<int> &nodes, Eigen::Index t)
  { return nodes.contains(triangles(t, 0)) || nodes.contains(triangles(t, 1)) || nodes.contains(triangles(t, 2)); };
  std::set<int> near = attached;
  for (Eigen::Index t = 0; t < triangles.rows(); ++t)
    if (touches(attached, t))
      near.insert({triangles(t, 0), triangles(t, 1), triangles(t, 2)});
  std::vector<char> may_touch = model.bodies[body].is_wall;
  for (Eigen::Index t = 0; t < triangles.rows(); ++t)
    if (touches(near, t))
      may_touch[t] = 0;
  return may_touch;
}
} // namespace

void Registration::Implementation::add_pair(const Model &model, const ContactPair &pair)
{
  const auto n_nodes = [&](int body) { return static_cast<int>(model.bodies[body].rest_positions.rows()); };
  pairs.push_back({{pair.body_a, pair.body_b},
                   {touching_triangles(model, pair.body_a, pair.body_b, attached_nodes),
                    touching_triangles(model, pair.body_b, pair.body_a, attached_nodes)},
                   VolumeContact(n_nodes(pair.body_a), n_nodes(pair.body_b))});
  pair_order.push_back(static_cast<int>(pair_order.size()));
  penetrations.push_back({pair.body_a, pair.body_b, Eigen::Vector3d::Zero(), 0, 0, 0, 0});
}

ContactSurface Registration::Implementation::contact_surface(const TouchingPair &pair, int side) const
{
  const int body = pair.bodies[side];
  return {&outer_surfaces[body], &bodies[body].positions(), &pair.may_touch[side], &trees[body]};
}

void Registration::Implementation::detect_contacts()
{
  for (const TouchingPair &pair : pairs)
    for (const int body : pair.bodies)
      trees[body].refit(bodies[body].positions());
  threads.run(pair_order,
              [&](int k)
              {
                TouchingPair &pair = pairs[k];
                pair.contact.detect(contact_surface(pair, 0), contact_surface(pair, 1), contact_grid());
                penetrations[k].depth = pair.contact.deepest_overlap();
                penetrations[k].volume = pair.contact.overlap_volume();
                penetrations[k].n_contacts = static_cast<int>(pair.contact.contacts().size());
                penetrations[k].n_open_rays = pair.contact.n_open_rays();
              });
}

void Registration::Implementation::add_contacts(StepSummary &summary)
{
  const auto side = [this](int body) { return ContactBody{body, &bodies[body].positions(), &slip_origins[body]}; };
  for (const TouchingPair &pair : pairs)
  {
    const std::array<ContactBody, 2> sides{side(pair.bodies[0]), side(pair.bodies[1])};
    for (const Contact &contact : pair.contact.contacts())
    {
      add_normal_row(contact, pair.contact.shares(), sides, options.max_recovery, options.contact_compliance, rows);
      if (has_friction())
        add_friction_rows(contact, pair.contact.shares(), sides, options.contact_compliance, rows);
      ++summary.n_contacts;
    }
  }
}

void Registration::Implementation::follow_image(const Observation &observation)
{
  list_image(observation, image);
  if (!has_moved_points && image == last_image)
    return;
  image.swap(last_image);
  has_moved_points = false;
  for (std::size_t body = 0; body < bodies.size(); ++body)
    slip_origins[body] = bodies[body].positions();
}

void Registration::Implementation::guess_contact_forces()
{
  int row = n_bilateral_rows;
  for (std::size_t k = 0; k < pairs.size(); ++k)
    for (const Contact &contact : pairs[k].contact.contacts())
    {
      const Eigen::Vector3d force = contact_memory.recall(static_cast<int>(k), contact.cell);
      constraint_solver.guess(row++, force.dot(contact.normal));
      if (has_friction())
        for (const Eigen::Vector3d &tangent : tangents(contact.normal))
          constraint_solver.guess(row++, force.dot(tangent));
    }
}

void Registration::Implementation::remember_contact_forces(StepSummary &summary)
{
  contact_memory.clear();
  int row = n_bilateral_rows;
  for (std::size_t k = 0; k < pairs.size(); ++k)
  {
    penetrations[k].force.setZero();
    for (const Contact &contact : pairs[k].contact.contacts())
    {
      summary.contact_force += constraint_solver.multipliers()[row];
      Eigen::Vector3d force = constraint_solver.multipliers()[row++] * contact.normal;
      if (has_friction())
        for (const Eigen::Vector3d &tangent : tangents(contact.normal))
          force += constraint_solver.multipliers()[row++] * tangent;
      contact_memory.remember(static_cast<int>(k), contact.cell, force);
      penetrations[k].force += force;
    }
  }
}
} // namespace pelvireg::registration
