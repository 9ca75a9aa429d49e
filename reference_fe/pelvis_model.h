// From the anatomy to the terms of the equilibrium equations.
#pragma once

#include "reference_fe/constraints/cavity.h"
#include "reference_fe/constraints/displacement_probe.h"
#include "reference_fe/constraints/follower_pressure.h"
#include "reference_fe/constraints/path_control.h"
#include "reference_fe/constraints/tie.h"
#include "reference_fe/contact/penalty_contact.h"
#include "reference_fe/elements/shell_term.h"
#include "reference_fe/elements/truss.h"
#include "reference_fe/equilibrium_system.h"
#include "reference_fe/outer_surface.h"
#include "synthetic/dataset/anatomy.h"

#include <memory>
#include <string>
#include <vector>

namespace pelvireg::reference_fe
{
/// Nodes of one part whose displacement is zero.
struct HeldNodes
{
  std::string part;
  std::vector<int> first_unknowns; ///< index of u_x of each
};

/// One monolithic system: shell nodes {u, w, alpha}, solid nodes {u}, one pressure a cavity, one load factor (the
/// abdominal pressure). The pieces that the load stepper and the record of the truth need stay at hand.
struct PelvisModel
{
  explicit PelvisModel(int n_threads) : system(n_threads) {}

  EquilibriumSystem system;
  int n_strain_terms = 0; ///< the first terms of the system store strain energy: shells, solids, trusses
  int pressure_unknown = 0;
  std::vector<std::shared_ptr<ShellTerm>> shells;
  std::shared_ptr<FollowerPressure> load;
  std::shared_ptr<DisplacementProbe> probe;
  std::shared_ptr<PathControl> path;
  std::shared_ptr<PenaltyContact> contact; ///< null when nothing may touch
  std::vector<std::shared_ptr<Cavity>> cavities;
  std::vector<std::shared_ptr<Tie>> ties;
  std::vector<OuterSurface> surfaces; ///< with caps: shells, then solids, in the order of the anatomy
  std::vector<Bar> bars;              ///< in the order of ReferenceModel::trusses
  std::vector<HeldNodes> held_nodes;  ///< parts with any
};

/// Numbers the unknowns, fixes the supports and adds every term. Expects a model that has passed check_model().
PelvisModel build_pelvis_model(const dataset::Anatomy &anatomy, int n_threads);
} // namespace pelvireg::reference_fe
