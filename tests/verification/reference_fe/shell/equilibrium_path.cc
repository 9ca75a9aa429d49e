#include "tests/verification/reference_fe/shell/equilibrium_path.h"

#include "reference_fe/constraints/path_control.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <stdexcept>
#include <utility>

namespace pelvireg::reference_fe
{
namespace
{
std::vector<SurfaceNode> midsurface_nodes(const SingleShell &shell)
{
  std::vector<SurfaceNode> nodes(shell.body.n_nodes());
  for (int node = 0; node < shell.body.n_nodes(); ++node)
  {
    nodes[node].first_unknown = shell.unknown(node, 0);
    nodes[node].rest = shell.body.midsurface.col(node);
  }
  return nodes;
}

std::vector<double> largest_entries(const std::vector<std::vector<double>> &table)
{
  std::vector<double> largest(table.at(0).size(), 0);
  for (const std::vector<double> &row : table)
    for (std::size_t k = 0; k < row.size(); ++k)
      largest[k] = std::max(largest[k], std::abs(row[k]));
  return largest;
}

/// Walks from rest along the table's rows.
class TableFollower
{
public:
  TableFollower(LoadedShell &loaded, const std::vector<std::vector<double>> &table, const PathOptions &options)
      : loaded_(loaded), system_(loaded.shell->system), table_(table), scale_(largest_entries(table)), options_(options)
  {
    load_ = system_.add_unknowns(1, {"load factor"});
    system_.add_term(loaded.load(load_));
    control_ = std::make_shared<PathControl>(midsurface_nodes(*loaded.shell), load_);
    system_.add_term(control_);
    newton_.residual_tolerance = loaded.residual_tolerance;
    newton_.max_merit_growth = 1e12;
    current_ = previous_ = Eigen::VectorXd::Zero(system_.n_unknowns());
  }

  CurveComparison run()
  {
    const std::clock_t start = std::clock();
    system_.fix(load_);
    comparison_.n_unknowns = system_.n_free() + (options_.arc_length ? 1 : 0);
    comparison_.table = table_;
    if (options_.arc_length)
      follow_by_arc_length();
    else
      follow_by_load();
    comparison_.cpu_seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    return std::move(comparison_);
  }

private:
  std::vector<double> row_at(const Eigen::VectorXd &x) const
  {
    std::vector<double> row = loaded_.observe(x);
    row.insert(row.begin(), x[load_]);
    return row;
  }

  /// Iterations taken; -1 when it failed.
  int solve(Eigen::VectorXd &x, int max_iterations = 60)
  {
    newton_.max_iterations = max_iterations;
    const NewtonResult result = solve_newton(system_, x, newton_);
    const int n = static_cast<int>(result.iterations.size());
    comparison_.n_iterations += n;
    return result.converged() ? n : -1;
  }

  [[noreturn]] void fail(const std::string &what, double at) const
  {
    throw std::runtime_error(what + " at the load factor " + std::to_string(at));
  }

  void follow_by_load()
  {
    for (const std::vector<double> &row : table_)
    {
      current_[load_] = row[0];
      if (solve(current_) < 0)
        fail("no equilibrium", row[0]);
      comparison_.computed.push_back(row_at(current_));
      ++comparison_.n_points;
    }
  }

  void follow_by_arc_length()
  {
    current_[load_] = options_.first_load;
    if (solve(current_) < 0)
      fail("no equilibrium", options_.first_load);
    ++comparison_.n_points;
    land_on_rows();
    double ratio = 1;
    while (comparison_.computed.size() < table_.size())
    {
      if (comparison_.n_points > options_.max_points || ratio < 0.01)
        fail("the path ends", current_[load_]);
      Eigen::VectorXd trial = current_ + ratio * (current_ - previous_);
      system_.release(load_);
      control_->prescribe(current_, trial);
      const int n_iterations = solve(trial, options_.max_iterations);
      if (n_iterations < 0 || growth(trial) > 2 * options_.largest_step)
      {
        ratio *= 0.5;
        continue;
      }
      previous_ = std::exchange(current_, trial);
      ++comparison_.n_points;
      const double length = growth(previous_);
      ratio = std::min(2 * n_iterations > options_.max_iterations ? 0.7 : 1.5,
                       options_.largest_step / std::max(length, 1e-12));
      land_on_rows();
    }
  }

  /// Largest change of the load or an observed displacement from the current state, in units of its largest tabulated
  /// value. The load too: where a displacement turns back the rest of the shell goes on.
  double growth(const Eigen::VectorXd &to) const
  {
    const std::vector<double> a = row_at(current_), b = row_at(to);
    double largest = 0;
    for (std::size_t k = 0; k < scale_.size(); ++k)
      largest = std::max(largest, std::abs(b[k] - a[k]) / scale_[k]);
    return largest;
  }

  /// Computes the rows that the last step went past.
  void land_on_rows()
  {
    while (comparison_.computed.size() < table_.size())
    {
      const int index = static_cast<int>(comparison_.computed.size());
      const std::vector<double> &row = table_[index];
      const std::size_t column = options_.at_displacement(index) ? 1 : 0;
      const double before = row_at(previous_)[column], after = row_at(current_)[column];
      if ((row[column] - before) * (row[column] - after) > 0)
        return;
      comparison_.computed.push_back(land(row[column], column));
    }
  }

  /// The state between previous and current whose load (column 0) or displacement (1) is `value`, from the line between
  /// them; where Newton's method fails or runs away, the segment is first halved along the path.
  std::vector<double> land(double value, std::size_t column)
  {
    Eigen::VectorXd a = previous_, b = current_;
    for (int halving = 0; halving < 8; ++halving)
    {
      const double before = row_at(a)[column], after = row_at(b)[column];
      const Eigen::VectorXd guess = a + (value - before) / (after - before) * (b - a);
      Eigen::VectorXd x = guess;
      if ((column == 0 ? solve_at_load(x, value) : solve_at_displacement(x, value)) &&
          (x - guess).norm() <= (b - a).norm())
        return row_at(x);
      Eigen::VectorXd middle = 0.5 * (a + b);
      system_.release(load_);
      control_->prescribe(a, middle);
      if (solve(middle, options_.max_iterations) < 0)
        break;
      ((value - before) * (value - row_at(middle)[column]) <= 0 ? b : a) = middle;
    }
    fail(column == 0 ? "no equilibrium at this load" : "no equilibrium at a row's displacement", value);
  }

  bool solve_at_load(Eigen::VectorXd &x, double factor)
  {
    system_.fix(load_);
    x[load_] = factor;
    return solve(x, options_.max_iterations) >= 0;
  }

  /// The point's displacement is prescribed without any load; its reaction is the load.
  bool solve_at_displacement(Eigen::VectorXd &x, double displacement)
  {
    const LoadedShell::PointLoad &point = loaded_.point_load;
    system_.fix(load_);
    system_.fix(point.unknown);
    const double guess = x[load_];
    x[load_] = 0;
    x[point.unknown] = displacement / point.displacement_per_unknown;
    const bool solved = solve(x, options_.max_iterations) >= 0;
    x[load_] = solved ? system_.residual()[point.unknown] / point.force : guess;
    system_.release(point.unknown);
    return solved;
  }

  LoadedShell &loaded_;
  EquilibriumSystem &system_;
  const std::vector<std::vector<double>> &table_;
  std::vector<double> scale_;
  PathOptions options_;
  NewtonOptions newton_;
  int load_ = 0;
  std::shared_ptr<PathControl> control_;
  Eigen::VectorXd previous_, current_;
  CurveComparison comparison_;
};
} // namespace

double CurveComparison::largest_difference(int column, double begin, double end) const
{
  double largest = 0;
  for (std::size_t row = 0; row < table.size(); ++row)
    if (table[row][0] > begin && table[row][0] <= end)
      largest = std::max(largest, std::abs(computed.at(row)[column] - table[row][column]));
  return largest / largest_entries(table)[column];
}

CurveComparison follow_table(LoadedShell &loaded, const std::vector<std::vector<double>> &table,
                             const PathOptions &options)
{
  return TableFollower(loaded, table, options).run();
}
} // namespace pelvireg::reference_fe
