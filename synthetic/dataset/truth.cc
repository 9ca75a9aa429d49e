#include "synthetic/dataset/truth.h"

#include "synthetic/dataset/error.h"
#include "synthetic/dataset/store.h"
#include "synthetic/dataset/truth_balance.h"

namespace pelvireg::dataset
{
namespace
{
constexpr const char *format = "pelvireg truth";

void write_surfaces(GroupWriter group, const Truth &truth)
{
  std::vector<std::string> names;
  for (const TruthSurface &surface : truth.surfaces)
    names.push_back(surface.name);
  group.texts("names", names);
  for (const TruthSurface &surface : truth.surfaces)
  {
    GroupWriter entry = group.group(surface.name);
    write_surface(entry, surface.rest);
    entry.stack("displacements", surface.displacements);
  }
}

std::vector<TruthSurface> read_surfaces(const GroupReader &group, std::int64_t n_increments)
{
  std::vector<TruthSurface> surfaces;
  for (const std::string &name : group.texts("names"))
  {
    const GroupReader entry = group.group(name);
    TruthSurface surface;
    surface.name = name;
    surface.rest = read_surface(entry);
    surface.displacements = entry.stack("displacements", n_increments, surface.rest.points.rows());
    surfaces.push_back(std::move(surface));
  }
  return surfaces;
}

/// Ends of every bar, bar i in rows 2i and 2i + 1.
Points join_ends(const std::vector<TruthTruss> &trusses, int increment)
{
  Points ends(static_cast<Eigen::Index>(2 * trusses.size()), 3);
  for (std::size_t i = 0; i < trusses.size(); ++i)
  {
    const Points &bar = increment < 0 ? trusses[i].rest : trusses[i].positions.at(static_cast<std::size_t>(increment));
    if (bar.rows() != 2)
      throw ComputationError("cannot store truss " + std::to_string(i) + ": it has not two ends");
    ends.middleRows<2>(static_cast<Eigen::Index>(2 * i)) = bar;
  }
  return ends;
}

void write_trusses(GroupWriter group, const Truth &truth)
{
  std::vector<std::string> groups;
  for (const TruthTruss &truss : truth.trusses)
  {
    if (truss.positions.size() != truth.increments.size())
      throw ComputationError("cannot store truss '" + truss.group + "': it has not one position an increment");
    groups.push_back(truss.group);
  }
  std::vector<Points> positions;
  for (int increment = 0; increment < static_cast<int>(truth.increments.size()); ++increment)
    positions.push_back(join_ends(truth.trusses, increment));
  group.texts("group", groups);
  group.array("rest", join_ends(truth.trusses, -1));
  group.stack("positions", positions);
}

std::vector<TruthTruss> read_trusses(const GroupReader &group, std::int64_t n_increments)
{
  const std::vector<std::string> groups = group.texts("group");
  const std::int64_t n_ends = 2 * static_cast<std::int64_t>(groups.size());
  const Points rest = group.array<Points>("rest", n_ends);
  const std::vector<Points> positions = group.stack("positions", n_increments, n_ends);
  std::vector<TruthTruss> trusses;
  for (std::size_t i = 0; i < groups.size(); ++i)
  {
    const auto first_row = static_cast<Eigen::Index>(2 * i);
    TruthTruss truss;
    truss.group = groups[i];
    truss.rest = rest.middleRows<2>(first_row);
    for (const Points &ends : positions)
      truss.positions.emplace_back(ends.middleRows<2>(first_row));
    trusses.push_back(std::move(truss));
  }
  return trusses;
}

template <typename Value, typename Field>
std::vector<Value> column(const std::vector<IncrementRecord> &records, Field field)
{
  std::vector<Value> values;
  for (const IncrementRecord &record : records)
    values.push_back(record.*field);
  return values;
}

using CavityRows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

CavityRows cavity_rows(const Truth &truth, Eigen::VectorXd IncrementRecord::*field)
{
  const auto n_cavities = static_cast<Eigen::Index>(truth.cavity_names.size());
  CavityRows rows(static_cast<Eigen::Index>(truth.increments.size()), n_cavities);
  for (Eigen::Index i = 0; i < rows.rows(); ++i)
  {
    const Eigen::VectorXd &values = truth.increments[static_cast<std::size_t>(i)].*field;
    if (values.size() != n_cavities)
      throw ComputationError("cannot store increment " + std::to_string(i + 1) + ": it has not one value a cavity");
    rows.row(i) = values;
  }
  return rows;
}

void write_increments(GroupWriter group, const Truth &truth)
{
  const std::vector<IncrementRecord> &records = truth.increments;
  group.numbers("pressure", column<double>(records, &IncrementRecord::pressure));
  group.numbers("mean_vaginal_displacement", column<double>(records, &IncrementRecord::mean_vaginal_displacement));
  group.numbers("residual", column<double>(records, &IncrementRecord::residual));
  group.numbers("energy", column<double>(records, &IncrementRecord::energy));
  group.integers("newton_iterations", column<std::int32_t>(records, &IncrementRecord::newton_iterations));
  group.integers("cuts", column<std::int32_t>(records, &IncrementRecord::cuts));
  group.numbers("max_penetration", column<double>(records, &IncrementRecord::max_penetration));
  group.array("cavity_volumes", cavity_rows(truth, &IncrementRecord::cavity_volumes));
  group.array("cavity_pressures", cavity_rows(truth, &IncrementRecord::cavity_pressures));
}

std::vector<IncrementRecord> read_increments(const GroupReader &group, std::int64_t count, std::int64_t n_cavities)
{
  const auto pressure = group.numbers("pressure", count);
  const auto displacement = group.numbers("mean_vaginal_displacement", count);
  const auto residual = group.numbers("residual", count);
  const auto energy = group.numbers("energy", count);
  const auto iterations = group.integers("newton_iterations", count);
  const auto cuts = group.integers("cuts", count);
  const auto penetration = group.numbers("max_penetration", count);
  const CavityRows volumes = group.array<CavityRows>("cavity_volumes", count);
  const CavityRows pressures = group.array<CavityRows>("cavity_pressures", count);
  if (volumes.cols() != n_cavities || pressures.cols() != n_cavities)
    group.refuse("cavity_volumes", "and 'cavity_pressures' have not one column a cavity");
  std::vector<IncrementRecord> records;
  for (std::size_t i = 0; i < pressure.size(); ++i)
    records.push_back({.pressure = pressure[i],
                       .mean_vaginal_displacement = displacement[i],
                       .residual = residual[i],
                       .energy = energy[i],
                       .newton_iterations = iterations[i],
                       .cuts = cuts[i],
                       .max_penetration = penetration[i],
                       .cavity_volumes = volumes.row(static_cast<Eigen::Index>(i)),
                       .cavity_pressures = pressures.row(static_cast<Eigen::Index>(i))});
  return records;
}

void require_one_layer_an_increment(const Truth &truth)
{
  for (const TruthSurface &surface : truth.surfaces)
    if (surface.displacements.size() != truth.increments.size())
      throw ComputationError("cannot store surface '" + surface.name + "': it has not one displacement an increment");
  if (!truth.balances.empty() && truth.balances.size() != truth.increments.size())
    throw ComputationError("cannot store the balances: there is neither none nor one an increment");
}
} // namespace

void save(const Truth &truth, const std::filesystem::path &file)
{
  require_one_layer_an_increment(truth);
  StoreWriter writer(file, format);
  GroupWriter &root = writer.root();
  root.text("case_name", truth.case_name);
  root.text("source", truth.source);
  root.integer("n_increments", static_cast<std::int32_t>(truth.increments.size()));
  root.texts("cavity_names", truth.cavity_names);
  root.array("cavity_rest_volumes", truth.cavity_rest_volumes);
  write_surfaces(root.group("surfaces"), truth);
  write_trusses(root.group("trusses"), truth);
  write_increments(root.group("increments"), truth);
  if (!truth.balances.empty())
    write_balances(root.group("balance"), truth);
  if (truth.discretisation_error)
    write_discretisation_error(root.group("discretisation_error"), *truth.discretisation_error);
  writer.finish();
}

Truth load_truth(const std::filesystem::path &file)
{
  const StoreReader reader(file, format);
  const GroupReader &root = reader.root();
  Truth truth;
  truth.case_name = root.text("case_name");
  truth.source = root.text("source");
  truth.cavity_names = root.texts("cavity_names");
  const auto n_cavities = static_cast<std::int64_t>(truth.cavity_names.size());
  truth.cavity_rest_volumes = root.array<Eigen::VectorXd>("cavity_rest_volumes", n_cavities);
  const std::int32_t n_increments = root.integer("n_increments");
  truth.surfaces = read_surfaces(root.group("surfaces"), n_increments);
  truth.trusses = read_trusses(root.group("trusses"), n_increments);
  truth.increments = read_increments(root.group("increments"), n_increments, n_cavities);
  if (root.has("balance"))
    read_balances(root.group("balance"), n_increments, truth);
  if (root.has("discretisation_error"))
    truth.discretisation_error = read_discretisation_error(root.group("discretisation_error"), n_increments);
  return truth;
}
} // namespace pelvireg::dataset
