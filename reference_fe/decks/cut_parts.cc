#include "reference_fe/decks/decks.h"
#include "synthetic/dataset/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace pelvireg::reference_fe
{
namespace
{
using dataset::ReferenceModel;

Eigen::Vector3d rest_position(const ReferenceModel &reference, const std::string &part, int node)
{
  for (const dataset::ReferenceShell &shell : reference.shells)
    if (shell.name == part)
      return shell.midsurface.row(node).transpose();
  for (const dataset::ReferenceSolid &solid : reference.solids)
    if (solid.name == part)
      return solid.points.row(node).transpose();
  throw InputError(fmt::format("a bar ends at part '{}', which does not exist; correct its ends", part));
}

std::set<std::string> known_parts(const ReferenceModel &reference)
{
  std::set<std::string> names;
  for (const dataset::ReferenceShell &shell : reference.shells)
    names.insert(shell.name);
  for (const dataset::ReferenceSolid &solid : reference.solids)
    names.insert(solid.name);
  return names;
}
} // namespace

dataset::Anatomy cut_parts(const dataset::Anatomy &anatomy, const std::vector<std::string> &parts)
{
  const ReferenceModel &whole = anatomy.reference;
  const std::set<std::string> known = known_parts(whole), kept(parts.begin(), parts.end());
  if (kept.empty())
    throw InputError("no part is named; name at least one");
  for (const std::string &name : kept)
    if (!known.contains(name))
      throw InputError(fmt::format("there is no part '{}'; the parts are {}", name, fmt::join(known, ", ")));

  dataset::Anatomy cut = anatomy;
  ReferenceModel &reference = cut.reference;
  const auto is_gone = [&](const auto &part) { return !kept.contains(part.name); };
  std::erase_if(reference.shells, is_gone);
  std::erase_if(reference.solids, is_gone);
  for (auto *pairs : {&reference.contact_pairs, &reference.ties})
    std::erase_if(*pairs, [&](const auto &pair) { return !kept.contains(pair.first) || !kept.contains(pair.second); });
  reference.trusses.clear();
  for (dataset::ReferenceTruss truss : whole.trusses)
  {
    const bool has_a = kept.contains(truss.part_a), has_b = kept.contains(truss.part_b);
    if (!has_a && !has_b)
      continue;
    if (!has_b && !truss.part_b.empty())
      truss.fixed_point = rest_position(whole, truss.part_b, truss.node_b) + truss.offset_b;
    if (!has_a)
    {
      truss.fixed_point = rest_position(whole, truss.part_a, truss.node_a) - truss.offset_b;
      truss.part_a = truss.part_b;
      truss.node_a = truss.node_b;
    }
    if (!has_a || !has_b)
    {
      truss.offset_b.setZero();
      truss.part_b.clear();
      truss.node_b = -1;
    }
    reference.trusses.push_back(std::move(truss));
  }
  return cut;
}
} // namespace pelvireg::reference_fe
