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
    : model_(model), surfaces_(in_table_order(model.surfaces))
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
  truth_.cavity_rest_volumes.resize(static_cast<Eigen::Index>(model.cavities.size()));
  for (std::size_t c = 0; c < model.cavities.size(); ++c)
  {
    truth_.cavity_names.push_back(model.cavities[c]->name());
    truth_.cavity_rest_volumes[static_cast<Eigen::Index>(c)] = model.cavities[c]->rest_volume();
  }
}

void TruthRecorder::record(const Eigen::VectorXd &solution, const StepEffort &effort)
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
  increment.max_penetration = model_.contact ? model_.contact->deepest_penetration(solution) : 0;
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
}
} // namespace pelvireg::reference_fe
