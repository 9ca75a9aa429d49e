#include "synthetic/dataset/truth_balance.h"

#include "synthetic/dataset/error.h"

namespace pelvireg::dataset
{
namespace
{
using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

std::vector<double> column(const Truth &truth, double BalanceRecord::*field)
{
  std::vector<double> values;
  for (const BalanceRecord &record : truth.balances)
    values.push_back(record.*field);
  return values;
}

/// One row an increment.
Rows rows(const Truth &truth, Eigen::VectorXd BalanceRecord::*field, std::size_t n_columns)
{
  Rows result(static_cast<Eigen::Index>(truth.balances.size()), static_cast<Eigen::Index>(n_columns));
  for (Eigen::Index i = 0; i < result.rows(); ++i)
  {
    const Eigen::VectorXd &values = truth.balances[static_cast<std::size_t>(i)].*field;
    if (values.size() != result.cols())
      throw ComputationError("cannot store the balance of increment " + std::to_string(i + 1) +
                             ": it has not one value a part and a cavity");
    result.row(i) = values;
  }
  return result;
}

Rows read_rows(const GroupReader &group, const std::string &name, std::int64_t n_rows, std::size_t n_columns)
{
  const Rows values = group.array<Rows>(name, n_rows);
  if (values.cols() != static_cast<Eigen::Index>(n_columns))
    group.refuse(name, "has not one column a name");
  return values;
}
} // namespace

void write_balances(GroupWriter group, const Truth &truth)
{
  std::vector<Points> reactions;
  Points resultants(static_cast<Eigen::Index>(truth.balances.size()), 3);
  for (const BalanceRecord &record : truth.balances)
  {
    if (record.reactions.rows() != static_cast<Eigen::Index>(truth.supports.size()))
      throw ComputationError("cannot store the balances: one has not one reaction a support");
    resultants.row(static_cast<Eigen::Index>(reactions.size())) = record.pressure_resultant.transpose();
    reactions.push_back(record.reactions);
  }
  group.texts("energy_parts", truth.energy_parts);
  group.texts("supports", truth.supports);
  group.numbers("external_work", column(truth, &BalanceRecord::external_work));
  group.numbers("work_uncertainty", column(truth, &BalanceRecord::work_uncertainty));
  group.array("strain_energy", rows(truth, &BalanceRecord::strain_energy, truth.energy_parts.size()));
  group.numbers("contact_energy", column(truth, &BalanceRecord::contact_energy));
  group.numbers("tie_energy", column(truth, &BalanceRecord::tie_energy));
  group.array("cavity_work", rows(truth, &BalanceRecord::cavity_work, truth.cavity_names.size()));
  group.numbers("energy_error_percent", column(truth, &BalanceRecord::energy_error_percent));
  group.stack("reactions", reactions);
  group.array("pressure_resultant", resultants);
  group.numbers("force_error", column(truth, &BalanceRecord::force_error));
}

void read_balances(const GroupReader &group, std::int64_t n_increments, Truth &truth)
{
  truth.energy_parts = group.texts("energy_parts");
  truth.supports = group.texts("supports");
  const auto work = group.numbers("external_work", n_increments);
  const auto uncertainty = group.numbers("work_uncertainty", n_increments);
  const Rows strain = read_rows(group, "strain_energy", n_increments, truth.energy_parts.size());
  const auto contact = group.numbers("contact_energy", n_increments);
  const auto tie = group.numbers("tie_energy", n_increments);
  const Rows cavity = read_rows(group, "cavity_work", n_increments, truth.cavity_names.size());
  const auto energy_error = group.numbers("energy_error_percent", n_increments);
  const auto reactions = group.stack("reactions", n_increments, static_cast<std::int64_t>(truth.supports.size()));
  const Points resultants = group.array<Points>("pressure_resultant", n_increments);
  const auto force_error = group.numbers("force_error", n_increments);
  for (std::size_t i = 0; i < work.size(); ++i)
  {
    const auto row = static_cast<Eigen::Index>(i);
    truth.balances.push_back({.external_work = work[i],
                              .work_uncertainty = uncertainty[i],
                              .strain_energy = strain.row(row),
                              .contact_energy = contact[i],
                              .tie_energy = tie[i],
                              .cavity_work = cavity.row(row),
                              .energy_error_percent = energy_error[i],
                              .reactions = reactions[i],
                              .pressure_resultant = resultants.row(row).transpose(),
                              .force_error = force_error[i]});
  }
}
} // namespace pelvireg::dataset
