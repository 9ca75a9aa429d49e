#include "registration/implementation.h"

namespace pelvireg::registration
{
namespace
{
constexpr std::size_t nodes_of_a_match = 3;       ///< a control point's triangle
constexpr std::size_t nodes_of_an_attachment = 4; ///< a node and the triangle that holds it
} // namespace

// Everything whose size depends on an image, for as many control points and contacts as the options say.
void Registration::Implementation::reserve_memory()
{
  const std::size_t n_points = options.reserved_control_points;
  const std::size_t n_contacts = pairs.empty() ? 0 : options.reserved_contacts;
  const std::size_t rows_per_contact = has_friction() ? 3 : 1;
  std::vector<std::size_t> n_rows(bodies.size(), 0), n_nodes(bodies.size(), 0);
  const auto add_rows = [&](int body, std::size_t rows_there, std::size_t nodes_a_row)
  {
    n_rows[body] += rows_there;
    n_nodes[body] += rows_there * nodes_a_row;
  };
  for (const AttachedNode &node : attached_nodes)
  {
    add_rows(node.body_a, 3, 1);
    add_rows(node.body_b, 3, nodes_of_an_attachment - 1);
  }
  std::size_t n_attachment_rows = 3 * attached_nodes.size();
  for (const std::vector<HeldNode> &nodes : held_nodes)
    for (const HeldNode &node : nodes)
    {
      add_rows(node.body, 3, 1);
      n_attachment_rows += 3;
    }
  std::vector<char> may_touch(bodies.size(), 0);
  for (const TouchingPair &pair : pairs)
    for (const int body : pair.bodies)
      may_touch[body] = 1;
  for (std::size_t body = 0; body < bodies.size(); ++body)
  {
    if (trees[body].triangles().rows() > 0)
      add_rows(static_cast<int>(body), n_points, nodes_of_a_match);
    if (may_touch[body])
      add_rows(static_cast<int>(body), n_contacts * rows_per_contact, VolumeContact::reserved_shares);
    bodies[body].reserve_rows(static_cast<int>(n_rows[body]), n_nodes[body]);
  }
  const std::size_t n_bilateral = n_points + n_attachment_rows, n_contact_rows = n_contacts * rows_per_contact;
  rows.reserve(n_bilateral + n_contact_rows, n_points * nodes_of_a_match + n_attachment_rows * nodes_of_an_attachment +
                                                 n_contact_rows * VolumeContact::reserved_shares);
  remaining_gaps.reserve(n_bilateral + n_contact_rows);
  constraint_solver.reserve(static_cast<int>(n_bilateral), static_cast<int>(n_contact_rows));
  contact_memory.reserve(n_contacts);
  matches.reserve(n_points);
  const std::size_t numbers_of_an_image = 6 + 2 * bodies.size() + 6 * n_points;
  image.reserve(numbers_of_an_image);
  last_image.reserve(numbers_of_an_image);
  for (TouchingPair &pair : pairs)
  {
    const auto surface = [&](int side) { return contact_surface(pair, side); };
    pair.contact.reserve(surface(0), surface(1), contact_grid(), n_contacts);
  }
}
} // namespace pelvireg::registration
