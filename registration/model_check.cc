#include "registration/model_check.h"

#include "registration/elements/hexahedron.h"
#include "registration/elements/tetrahedron.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <sstream>
#include <stdexcept>

namespace pelvireg::registration
{
namespace
{
template <class... Parts> void require(bool condition, const Parts &...parts)
{
  if (condition)
    return;
  std::ostringstream sentence;
  sentence.precision(6);
  (sentence << ... << parts);
  throw std::invalid_argument(sentence.str());
}

void check_values(const Body &body, const std::string &where)
{
  require(body.youngs_modulus > 0 && std::isfinite(body.youngs_modulus), where, ": Young's modulus is ",
          body.youngs_modulus, " MPa, must be positive and finite; correct the case's material");
  require(body.poisson_ratio > -1 && body.poisson_ratio < 0.5, where, ": Poisson's ratio is ", body.poisson_ratio,
          ", must lie in (-1, 0.5); the paper's models use 0.45");
  require(body.density > 0 && std::isfinite(body.density), where, ": density is ", body.density,
          " t/mm^3, must be positive and finite; soft tissue has about 1.05e-9");
  require(body.tets.rows() == 0 || body.hexes.rows() == 0, where,
          ": has both tetrahedra and hexahedra, must have one kind; split it into two bodies");
  require(body.tets.rows() + body.hexes.rows() > 0, where, ": has no element; give it tetrahedra or hexahedra");
  for (Eigen::Index node = 0; node < body.rest_positions.rows(); ++node)
    require(body.rest_positions.row(node).allFinite(), where, ": the rest position of node ", node,
            " is not finite; correct the mesh");
}

template <class Indices> void check_indices(const Indices &indices, Eigen::Index n, const std::string &what)
{
  for (const auto index : indices.reshaped())
    require(index >= 0 && index < n, what, ": index ", index, " is out of range, must lie in [0, ", n,
            "); correct the mesh");
}

void check_list(const std::vector<int> &indices, Eigen::Index n, const std::string &what)
{
  check_indices(Eigen::Map<const Eigen::VectorXi>(indices.data(), static_cast<Eigen::Index>(indices.size())), n, what);
}

template <class Element, class Connectivity>
typename Element::NodalVectors gather(const Body &body, const Connectivity &cells, Eigen::Index cell)
{
  typename Element::NodalVectors rest;
  for (int a = 0; a < Element::n_nodes; ++a)
    rest.col(a) = body.rest_positions.row(cells(cell, a)).transpose();
  return rest;
}

void check_orientation(const Body &body, const std::string &where)
{
  for (Eigen::Index cell = 0; cell < body.tets.rows(); ++cell)
  {
    const auto rest = gather<Tetrahedron>(body, body.tets, cell);
    const double volume =
        (rest.col(1) - rest.col(0)).cross(rest.col(2) - rest.col(0)).dot(rest.col(3) - rest.col(0)) / 6;
    require(volume > 0, where, ": tetrahedron ", cell, " has volume ", volume,
            " mm^3, must be positive; reorder its nodes or repair the mesh");
  }
  for (Eigen::Index cell = 0; cell < body.hexes.rows(); ++cell)
  {
    const double least = Hexahedron::least_jacobian(gather<Hexahedron>(body, body.hexes, cell));
    require(least > 0, where, ": hexahedron ", cell, " has the Jacobian ", least,
            " mm^3 at a corner, must be positive; order its nodes as VTK does or repair the mesh");
  }
}

/// Label of the connected component of every node; -1 for a node in no element.
template <class Connectivity> std::vector<int> components(Eigen::Index n_nodes, const Connectivity &cells)
{
  std::vector<int> parent(n_nodes, -1);
  const auto root = [&](int node)
  {
    while (parent[node] != node)
      node = parent[node] = parent[parent[node]];
    return node;
  };
  for (Eigen::Index cell = 0; cell < cells.rows(); ++cell)
    for (int a = 0; a < cells.cols(); ++a)
    {
      int &own = parent[cells(cell, a)];
      if (own < 0)
        own = cells(cell, a);
      parent[root(cells(cell, a))] = root(cells(cell, 0));
    }
  for (int node = 0; node < static_cast<int>(n_nodes); ++node)
    if (parent[node] >= 0)
      parent[node] = root(node);
  return parent;
}

void check_connectivity(const Body &body, const std::string &where)
{
  const std::vector<int> component = body.tets.rows() > 0 ? components(body.rest_positions.rows(), body.tets)
                                                          : components(body.rest_positions.rows(), body.hexes);
  const auto orphan = std::find(component.begin(), component.end(), -1);
  require(orphan == component.end(), where, ": node ", orphan - component.begin(),
          " belongs to no element; remove it from the mesh");
  if (!is_organ(body))
    return; // the bands of several ligaments may share one body
  const std::set<int> distinct(component.begin(), component.end());
  require(distinct.size() == 1, where, ": the mesh falls into ", distinct.size(),
          " parts that share no node, must be one; join them or split the body");
}

void check_outer_surface(const Body &body, const std::string &where)
{
  const Triangles &triangles = body.outer_triangles;
  require(body.is_wall.size() == static_cast<std::size_t>(triangles.rows()), where, ": is_wall has ",
          body.is_wall.size(), " flags for ", triangles.rows(), " outer triangles, must have one each");
  std::map<std::pair<int, int>, int> directed;
  double volume = 0;
  for (Eigen::Index t = 0; t < triangles.rows(); ++t)
  {
    Eigen::Vector3d corner[3];
    for (int i = 0; i < 3; ++i)
    {
      corner[i] = body.rest_positions.row(triangles(t, i)).transpose();
      const auto edge = std::pair(triangles(t, i), triangles(t, (i + 1) % 3));
      require(++directed[edge] == 1, where, ": edge ", edge.first, "-", edge.second,
              " of the outer surface is used twice in one direction, must be a manifold; repair the surface");
    }
    volume += corner[0].dot(corner[1].cross(corner[2])) / 6;
  }
  for (const auto &[edge, count] : directed)
    require(directed.contains({edge.second, edge.first}), where, ": the outer surface is open at edge ", edge.first,
            "-", edge.second, ", must be closed; cap its open ends");
  require(volume > 0, where, ": the outer surface encloses ", volume,
          " mm^3, must be positive; turn its triangles outward");
}

bool has_wall(const Body &body)
{
  return std::any_of(body.is_wall.begin(), body.is_wall.end(), [](char flag) { return flag != 0; });
}

void check_attachment(const Model &model, const Attachment &attachment)
{
  const std::string where = "attachment '" + attachment.name + "'";
  const int n_bodies = static_cast<int>(model.bodies.size());
  for (const int body : {attachment.body_a, attachment.body_b})
    require(body >= 0 && body < n_bodies, where, ": body ", body, " does not exist, must lie in [0, ", n_bodies, ")");
  require(attachment.body_a != attachment.body_b, where, ": joins body ", attachment.body_a,
          " to itself; name two different bodies");
  check_list(attachment.nodes_a, model.bodies[attachment.body_a].rest_positions.rows(), where + ", nodes");
  require(attachment.compliance >= 0 && std::isfinite(attachment.compliance), where, ": compliance is ",
          attachment.compliance, " mm/N, must be finite and not negative");
  require(has_wall(model.bodies[attachment.body_b]), where, ": body '", model.bodies[attachment.body_b].name,
          "' has no wall triangle to hold on; mark some of its outer triangles as wall");
}

void check_point_attachment(const Model &model, const PointAttachment &attachment)
{
  const std::string where = "point attachment '" + attachment.name + "'";
  const int n_bodies = static_cast<int>(model.bodies.size());
  require(attachment.body >= 0 && attachment.body < n_bodies, where, ": body ", attachment.body,
          " does not exist, must lie in [0, ", n_bodies, ")");
  check_list(attachment.nodes, model.bodies[attachment.body].rest_positions.rows(), where + ", nodes");
  check_points(where, attachment.nodes.size(), attachment.points);
  require(attachment.compliance >= 0 && std::isfinite(attachment.compliance), where, ": compliance is ",
          attachment.compliance, " mm/N, must be finite and not negative");
}

void check_contact_pairs(const Model &model)
{
  const int n_bodies = static_cast<int>(model.bodies.size());
  std::set<std::pair<int, int>> seen;
  for (const ContactPair &pair : model.contact_pairs)
  {
    const std::string where = "contact pair " + std::to_string(seen.size());
    for (const int body : {pair.body_a, pair.body_b})
    {
      require(body >= 0 && body < n_bodies, where, ": body ", body, " does not exist, must lie in [0, ", n_bodies, ")");
      require(is_organ(model.bodies[body]), where, ": body '", model.bodies[body].name,
              "' has no outer triangles, so nothing can touch it; name two organs");
    }
    require(pair.body_a != pair.body_b, where, ": joins body ", pair.body_a, " to itself; name two different bodies");
    require(seen.insert(std::minmax(pair.body_a, pair.body_b)).second, where, ": bodies ", pair.body_a, " and ",
            pair.body_b, " are paired twice; name every pair once");
  }
}

void check_body(const Body &body)
{
  const std::string where = "body '" + body.name + "'";
  const Eigen::Index n_nodes = body.rest_positions.rows();
  check_values(body, where);
  check_indices(body.tets, n_nodes, where + ", tetrahedra");
  check_indices(body.hexes, n_nodes, where + ", hexahedra");
  check_indices(body.outer_triangles, n_nodes, where + ", outer triangles");
  check_list(body.fixed_nodes, n_nodes, where + ", fixed nodes");
  check_orientation(body, where);
  check_connectivity(body, where);
  if (is_organ(body))
    check_outer_surface(body, where);
}
} // namespace

void check_points(const std::string &where, std::size_t n, const Points &points)
{
  require(points.rows() == static_cast<Eigen::Index>(n), where, ": has ", points.rows(), " points for ", n,
          " nodes, must have one each");
  require(points.allFinite(), where, ": a point is not finite; give coordinates in mm");
}

void check_model(const Model &model)
{
  require(!model.bodies.empty(), "the model has no body; give it at least one");
  for (const Body &body : model.bodies)
    check_body(body);
  for (const Attachment &attachment : model.attachments)
    check_attachment(model, attachment);
  for (const PointAttachment &attachment : model.point_attachments)
    check_point_attachment(model, attachment);
  check_contact_pairs(model);
}
} // namespace pelvireg::registration
