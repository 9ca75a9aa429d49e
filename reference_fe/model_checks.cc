#include "reference_fe/model_checks.h"

#include "reference_fe/elements/surface_face.h"
#include "synthetic/dataset/error.h"

#include <Eigen/LU>
#include <fmt/format.h>

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace pelvireg::reference_fe
{
namespace
{
using dataset::ReferenceModel;
using dataset::ReferenceShell;
using dataset::ReferenceSolid;

void check_material(const ReferenceModel &model, const std::string &key, const std::string &user)
{
  const auto found = model.materials.find(key);
  if (found == model.materials.end())
    throw InputError(fmt::format("{}: material '{}' is not defined; add it to the materials of the case", user, key));
  const dataset::YeohMaterial &m = found->second;
  if (!(m.c10 > 0) || !(m.c20 >= 0) || !(m.c30 >= 0) || !(m.kappa > 0))
    throw InputError(
        fmt::format("material '{}': C10 = {} and kappa = {} MPa must be positive, C20 = {} and C30 = {} MPa "
                    "not negative; correct the case",
                    key, m.c10, m.kappa, m.c20, m.c30));
}

template <class Cells> void check_nodes_used(const std::string &part, Eigen::Index n_nodes, const Cells &cells)
{
  std::vector<bool> used(static_cast<std::size_t>(n_nodes), false);
  for (Eigen::Index i = 0; i < cells.size(); ++i)
  {
    const std::int32_t node = cells.data()[i];
    if (node < 0 || node >= n_nodes)
      throw InputError(
          fmt::format("part '{}': a cell uses node {}, allowed 0 to {}; mend its mesh", part, node, n_nodes - 1));
    used[static_cast<std::size_t>(node)] = true;
  }
  for (Eigen::Index n = 0; n < n_nodes; ++n)
    if (!used[static_cast<std::size_t>(n)])
      throw InputError(fmt::format("part '{}': node {} belongs to no cell; remove it from the mesh", part, n));
}

/// x = R + zeta h/2 N: the Jacobian at the nine nodes of each cell.
void check_shell_cells(const ReferenceShell &shell)
{
  for (Eigen::Index c = 0; c < shell.cells.rows(); ++c)
    for (int at = 0; at < 9; ++at)
    {
      static constexpr int xi[9] = {-1, 1, 1, -1, 0, 1, 0, -1, 0}, eta[9] = {-1, -1, 1, 1, -1, 0, 1, 0, 0};
      const FacePoint q = face_shape(9, xi[at], eta[at]);
      for (const int zeta : {-1, 0, 1})
      {
        Eigen::Matrix3d jacobian = Eigen::Matrix3d::Zero();
        for (int i = 0; i < 9; ++i)
        {
          const std::int32_t node = shell.cells(c, i);
          const Eigen::Vector3d fibre = 0.5 * shell.thickness[node] * shell.directors.row(node).transpose();
          const Eigen::Vector3d x = shell.midsurface.row(node).transpose() + zeta * fibre;
          jacobian.col(0) += q.d_xi[i] * x;
          jacobian.col(1) += q.d_eta[i] * x;
          jacobian.col(2) += q.value[i] * fibre;
        }
        if (!(jacobian.determinant() > 0))
          throw InputError(
              fmt::format("shell '{}': cell {} is inverted at zeta = {} near node {} (Jacobian {:.3g}, must be "
                          "positive); refine the mesh or thin the wall",
                          shell.name, c, zeta, shell.cells(c, at), jacobian.determinant()));
      }
    }
}

/// Border edges of the cells must all lie on the rims that carry caps.
void check_closed(const ReferenceShell &shell)
{
  std::map<std::pair<int, int>, int> count;
  for (Eigen::Index c = 0; c < shell.cells.rows(); ++c)
    for (int k = 0; k < 4; ++k)
      ++count[std::minmax(shell.cells(c, k), shell.cells(c, (k + 1) % 4))];
  std::set<int> on_rim;
  for (const dataset::Integers &rim : shell.rims)
    on_rim.insert(rim.data(), rim.data() + rim.size());
  for (const auto &[edge, n] : count)
    if (n == 1 && !(on_rim.count(edge.first) && on_rim.count(edge.second)))
      throw InputError(
          fmt::format("shell '{}': a cavity is asked but the surface is open at the edge of nodes {} and {}; "
                      "close it or list its border as a rim",
                      shell.name, edge.first, edge.second));
}

std::map<std::string, Eigen::Index> node_counts(const ReferenceModel &model)
{
  std::map<std::string, Eigen::Index> count;
  for (const ReferenceShell &shell : model.shells)
    count[shell.name] = shell.midsurface.rows();
  for (const ReferenceSolid &solid : model.solids)
    count[solid.name] = solid.points.rows();
  return count;
}

void check_trusses(const ReferenceModel &model)
{
  const auto count = node_counts(model);
  for (std::size_t t = 0; t < model.trusses.size(); ++t)
  {
    const dataset::ReferenceTruss &truss = model.trusses[t];
    const std::string user = fmt::format("truss {} of group '{}'", t, truss.group);
    check_material(model, truss.material, user);
    if (!(truss.area > 0))
      throw InputError(fmt::format("{}: its area is {} mm^2, must be positive; correct the case", user, truss.area));
    const auto check_end = [&](const std::string &part, std::int32_t node)
    {
      const auto found = count.find(part);
      if (found == count.end() || node < 0 || node >= found->second)
        throw InputError(fmt::format("{}: it ends at node {} of part '{}', which does not exist; correct its ends",
                                     user, node, part));
    };
    check_end(truss.part_a, truss.node_a);
    if (!truss.part_b.empty())
      check_end(truss.part_b, truss.node_b);
  }
}

/// Every part must hang together with something fixed through bars and ties.
void check_held(const ReferenceModel &model)
{
  std::set<std::string> held;
  for (const ReferenceShell &shell : model.shells)
    if (shell.fixed_nodes.size() > 0)
      held.insert(shell.name);
  for (const ReferenceSolid &solid : model.solids)
    if (solid.fixed_nodes.size() > 0)
      held.insert(solid.name);
  std::vector<std::pair<std::string, std::string>> links = model.ties;
  for (const dataset::ReferenceTruss &truss : model.trusses)
    if (truss.part_b.empty())
      held.insert(truss.part_a);
    else
      links.emplace_back(truss.part_a, truss.part_b);
  for (std::size_t pass = 0; pass <= links.size(); ++pass)
    for (const auto &[a, b] : links)
      if (held.count(a) || held.count(b))
        held.insert({a, b});
  for (const auto &[part, count] : node_counts(model))
    if (!held.count(part))
      throw InputError(
          fmt::format("part '{}' is held by nothing: no fixed node, no bar, no tie to a held part; give it a "
                      "support",
                      part));
}
} // namespace

void check_model(const ReferenceModel &model)
{
  if (!(model.target_displacement > 0) || model.n_increments < 1)
    throw InputError(
        fmt::format("the reference needs a positive target displacement and at least one increment, got {} mm "
                    "and {}; correct the case",
                    model.target_displacement, model.n_increments));
  for (const ReferenceShell &shell : model.shells)
  {
    check_material(model, shell.material, "shell '" + shell.name + "'");
    check_nodes_used(shell.name, shell.midsurface.rows(), shell.cells);
    check_shell_cells(shell);
    if (shell.has_cavity)
      check_closed(shell);
  }
  for (const ReferenceSolid &solid : model.solids)
  {
    check_material(model, solid.material, "solid '" + solid.name + "'");
    check_nodes_used(solid.name, solid.points.rows(), solid.cells);
  }
  const auto count = node_counts(model);
  for (const auto *pairs : {&model.contact_pairs, &model.ties})
    for (const auto &[a, b] : *pairs)
      for (const std::string &part : {a, b})
        if (!count.count(part))
          throw InputError(fmt::format("contact or tie {}–{}: there is no part '{}'; correct the name", a, b, part));
  check_trusses(model);
  check_held(model);
}
} // namespace pelvireg::reference_fe
