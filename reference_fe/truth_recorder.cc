#include "reference_fe/truth_recorder.h"

#include <algorithm>
#include <numeric>

namespace pelvireg::reference_fe
{
namespace
{
std::vector<const OuterSurface *> in_table_order(const std::vector<OuterSurface> &surfaces)
{
  std::vector<const OuterSurface *> sorted;
  for (const OuterSurface &surface : surfaces)
    sorted.push_back(&surface);
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](auto *a, auto *b) { return table_rank(a->part) < table_rank(b->part); });
  return sorted;
}

dataset::Points bar_ends(const Bar &bar, const Eigen::VectorXd &solution)
{
  dataset::Points ends(2, 3);
  ends.row(0) = bar.nodes[0].position(solution).transpose();
  ends.row(1) = (bar.nodes.size() == 2 ? bar.nodes[1].position(solution) : bar.fixed_end).transpose();
  return ends;
}
} // namespace

TruthRecorder::TruthRecorder(const PelvisModel &model, const std::string &case_name)
    : model_(model), surfaces_(in_table_order(model.surfaces)), forces_(model)
{
  truth_.case_name = case_name;
  truth_.source = "pelvireg reference (deal.II)";
  for (const OuterSurface *surface : surfaces_)
  {
    dataset::TruthSurface entry;
    entry.name = surface->part;
    entry.rest.points.resize(static_cast<Eigen::Index>(surface->vertices.size()), 3);
    for (std::size_t v = 0; v < surface->vertices.size(); ++v)
      entry.rest.points.row(static_cast<Eigen::Index>(v)) = surface->vertices[v].rest_position().transpose();
    entry.rest.triangles = surface->triangles;
    entry.rest.region = surface->region;
    truth_.surfaces.push_back(std::move(entry));
  }
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(model.system.n_unknowns());
  for (const Bar &bar : model.bars)
    truth_.trusses.push_back({bar.group, bar_ends(bar, rest), {}});
  for (int term = 0; term + 1 < model.n_strain_terms; ++term)
    truth_.energy_parts.push_back(model.system.terms()[static_cast<std::size_t>(term)]->name());
  for (const Bar &bar : model.bars)
    if (std::find(bar_groups_.begin(), bar_groups_.end(), bar.group) == bar_groups_.end())
      bar_groups_.push_back(bar.group);
  for (const std::string &group : bar_groups_)
    truth_.energy_parts.push_back("bars " + group);
  truth_.supports = forces_.supports();
  truth_.cavity_rest_volumes.resize(static_cast<Eigen::Index>(model.cavities.size()));
  for (std::size_t c = 0; c < model.cavities.size(); ++c)
  {
    truth_.cavity_names.push_back(model.cavities[c]->name());
    truth_.cavity_rest_volumes[static_cast<Eigen::Index>(c)] = model.cavities[c]->rest_volume();
  }
}

/// Strain energy by part, what contact and ties store, and what is left of the external work.
dataset::BalanceRecord TruthRecorder::balance(const Eigen::VectorXd &solution, const PathWork &work) const
{
  dataset::BalanceRecord record;
  record.external_work = work.external_work();
  record.work_uncertainty = work.uncertainty();
  record.cavity_work = work.cavity_work();
  const std::vector<double> &energies = model_.system.term_energies();
  const int n_parts = model_.n_strain_terms - 1; // the last of them is the term of all bars
  record.strain_energy = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(truth_.energy_parts.size()));
  for (int part = 0; part < n_parts; ++part)
    record.strain_energy[part] = energies[static_cast<std::size_t>(part)];
  for (const Bar &bar : model_.bars)
    record.strain_energy[n_parts + (std::find(bar_groups_.begin(), bar_groups_.end(), bar.group) -
                                    bar_groups_.begin())] += bar_energy(bar, solution);
  const auto energy_of = [&](const Term *term)
  {
    const auto &terms = model_.system.terms();
    const auto found = std::find_if(terms.begin(), terms.end(), [&](const auto &other) { return other.get() == term; });
    return found == terms.end() ? 0 : energies[static_cast<std::size_t>(found - terms.begin())];
  };
  record.contact_energy = energy_of(model_.contact.get());
  for (const std::shared_ptr<Tie> &tie : model_.ties)
    record.tie_energy += energy_of(tie.get());
  const double balanced =
      record.strain_energy.sum() + record.contact_energy + record.tie_energy + record.cavity_work.sum();
  record.energy_error_percent = 100 * (record.external_work - balanced) / record.external_work;
  record.reactions = forces_.reactions(solution);
  record.pressure_resultant = forces_.pressure_resultant(solution);
  record.force_error = (record.reactions.colwise().sum().transpose() + record.pressure_resultant).norm();
  return record;
}

void TruthRecorder::record(const Eigen::VectorXd &solution, const StepEffort &effort, const PathWork &work)
{
  for (std::size_t s = 0; s < surfaces_.size(); ++s)
  {
    dataset::TruthSurface &entry = truth_.surfaces[s];
    dataset::Points displacement(entry.rest.points.rows(), 3);
    for (Eigen::Index v = 0; v < displacement.rows(); ++v)
      displacement.row(v) =
          surfaces_[s]->vertices[static_cast<std::size_t>(v)].position(solution).transpose() - entry.rest.points.row(v);
    entry.displacements.push_back(std::move(displacement));
  }
  for (std::size_t b = 0; b < model_.bars.size(); ++b)
    truth_.trusses[b].positions.push_back(bar_ends(model_.bars[b], solution));

  dataset::IncrementRecord increment;
  increment.pressure = solution[model_.pressure_unknown];
  increment.mean_vaginal_displacement = model_.probe->mean_displacement(solution);
  increment.residual = effort.residual;
  const std::vector<double> &energies = model_.system.term_energies();
  increment.energy = std::accumulate(energies.begin(), energies.begin() + model_.n_strain_terms, 0.);
  increment.newton_iterations = effort.newton_iterations;
  increment.cuts = effort.cuts;
  increment.max_penetration = model_.contact ? model_.contact->deepest_penetration(solution).depth : 0;
  const Eigen::Index n_cavities = static_cast<Eigen::Index>(model_.cavities.size());
  increment.cavity_volumes.resize(n_cavities);
  increment.cavity_pressures.resize(n_cavities);
  for (Eigen::Index c = 0; c < n_cavities; ++c)
  {
    const Cavity &cavity = *model_.cavities[static_cast<std::size_t>(c)];
    increment.cavity_volumes[c] = cavity.volume(solution);
    increment.cavity_pressures[c] = solution[cavity.pressure_unknown()];
  }
  truth_.increments.push_back(std::move(increment));
  truth_.balances.push_back(balance(solution, work));
}
} // namespace pelvireg::reference_fe
