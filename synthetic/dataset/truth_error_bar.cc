#include "synthetic/dataset/truth_balance.h"

namespace pelvireg::dataset
{
void write_discretisation_error(GroupWriter group, const DiscretisationError &error)
{
  group.array("cell_sizes", error.cell_sizes);
  group.array("n_cells", error.n_cells);
  group.number("observed_order", error.observed_order);
  group.number("used_order", error.used_order);
  group.number("safety_factor", error.safety_factor);
  group.number("bar_distance_mm", error.bar_distance);
  group.number("share_near_bars", error.share_near_bars);
  group.array("mean", error.mean);
  group.array("max", error.max);
  group.array("max_near_bars", error.max_near_bars);
  group.array("mean_by_organ", error.mean_by_organ);
  group.array("max_by_organ", error.max_by_organ);
  group.text("case_sha256", error.case_sha256);
  group.text("solver_sha256", error.solver_sha256);
  group.text("revision", error.revision);
  group.integer("same_solver", error.same_solver);
}

DiscretisationError read_discretisation_error(const GroupReader &group, std::int64_t n_increments)
{
  DiscretisationError error;
  error.cell_sizes = group.array<Eigen::VectorXd>("cell_sizes", 3);
  error.n_cells = group.array<Integers>("n_cells", 3);
  error.observed_order = group.number("observed_order");
  error.used_order = group.number("used_order");
  error.safety_factor = group.number("safety_factor");
  error.bar_distance = group.number("bar_distance_mm");
  error.share_near_bars = group.number("share_near_bars");
  error.mean = group.array<Eigen::VectorXd>("mean", n_increments);
  error.max = group.array<Eigen::VectorXd>("max", n_increments);
  error.max_near_bars = group.array<Eigen::VectorXd>("max_near_bars", n_increments);
  error.mean_by_organ = group.array<Points4>("mean_by_organ", n_increments);
  error.max_by_organ = group.array<Points4>("max_by_organ", n_increments);
  error.case_sha256 = group.text("case_sha256");
  error.solver_sha256 = group.text("solver_sha256");
  error.revision = group.text("revision");
  error.same_solver = group.integer("same_solver") != 0;
  return error;
}
} // namespace pelvireg::dataset
