#include "tests/verification/reference_fe/shell/equilibrium_path.h"

#include "reference_fe/constraints/path_control.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <stdexcept>
#include <utility>

namespace pelvireg::reference_fe
{
namespace
{
SurfaceNode midsurface_node(const SingleShell &shell, int node)
{
  SurfaceNode point;
  point.first_unknown = shell.unknown(node, 0);
  point.rest = shell.body.midsurface.col(node);
  return point;
}

std::vector<SurfaceNode> midsurface_nodes(const SingleShell &shell)
{
  std::vector<SurfaceNode> nodes;
  for (int node = 0; node < shell.body.n_nodes(); ++node)
    nodes.push_back(midsurface_node(shell, node));
  return nodes;
}

/// A column that is landed on: 0 the load, 1 … the displacements.
struct Landing
{
  int row = 0, column = 0;
};

/// Walks from rest along the table's rows.
class TableFollower
{
public:
  TableFollower(LoadedShell &loaded, const std::vector<std::vector<double>> &table, const PathOptions &options)
      : loaded_(loaded), system_(loaded.shell->system), options_(options)
  {
    for (std::size_t row = 0; row < table.size(); ++row)
      comparison_.rows.push_back({table[row], options.at_displacement(static_cast<int>(row)), {}});
    load_ = system_.add_unknowns(1, {"load factor"});
    system_.add_term(loaded.load(load_));
    along_path_ = add_control(midsurface_nodes(*loaded.shell));
    for (const auto &[unknown, scale] : loaded.observed)
      at_displacement_.push_back(
          add_control({midsurface_node(*loaded.shell, (unknown - loaded.shell->first) / n_shell_unknowns)}));
    newton_.residual_tolerance = loaded.residual_tolerance;
    newton_.max_merit_growth = 1e12;
    current_ = previous_ = Eigen::VectorXd::Zero(system_.n_unknowns());
  }

  CurveComparison run()
  {
    const std::clock_t start = std::clock();
    system_.fix(load_);
    comparison_.n_unknowns = system_.n_free() + (options_.arc_length ? 1 : 0);
    if (options_.arc_length)
      follow_by_arc_length();
    else
      follow_by_load();
    comparison_.cpu_seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    return std::move(comparison_);
  }

private:
  std::shared_ptr<PathControl> add_control(const std::vector<SurfaceNode> &nodes)
  {
    auto control = std::make_shared<PathControl>(nodes, load_);
    system_.add_term(control);
    return control;
  }

  /// Load factor (column 0) and observed displacements.
  std::vector<double> row_at(const Eigen::VectorXd &x) const
  {
    std::vector<double> row = {x[load_]};
    for (const auto &[unknown, scale] : loaded_.observed)
      row.push_back(scale * x[unknown]);
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

  void log(const char *what, const Eigen::VectorXd &x, int n_iterations) const
  {
    if (options_.log)
      options_.log(fmt::format("{} {:.5g} ({} iterations)", what, fmt::join(row_at(x), " "), n_iterations));
  }

  void follow_by_load()
  {
    for (ComparedRow &row : comparison_.rows)
    {
      if (comparison_.n_points >= options_.n_rows)
        return;
      current_[load_] = row.table[0];
      if (solve(current_) < 0)
        fail("no equilibrium", row.table[0]);
      const std::vector<double> values = row_at(current_);
      row.computed.assign(values.begin() + 1, values.end());
      ++comparison_.n_points;
    }
  }

  void follow_by_arc_length()
  {
    current_[load_] = options_.first_load;
    if (solve(current_) < 0)
      fail("no equilibrium", options_.first_load);
    ++comparison_.n_points;
    open_row(0);
    land_on_rows();
    double ratio = 1;
    while (!pending_.empty())
    {
      if (comparison_.n_points > options_.max_points || ratio < 0.01)
        fail("the path ends", current_[load_]);
      Eigen::VectorXd trial = current_ + ratio * (current_ - previous_);
      hold_along_path(current_, trial);
      const int n_iterations = solve(trial, options_.max_iterations);
      if (n_iterations < 0 || growth(trial) > 2 * options_.largest_step)
      {
        log(n_iterations < 0 ? "  no convergence" : "  too far", trial, n_iterations);
        ratio *= 0.5;
        continue;
      }
      previous_ = std::exchange(current_, trial);
      ++comparison_.n_points;
      log("point", current_, n_iterations);
      ratio = std::min(2 * n_iterations > options_.max_iterations ? 0.7 : 1.5,
                       options_.largest_step / std::max(growth(previous_), 1e-12));
      land_on_rows();
    }
  }

  /// Largest change of the load or an observed displacement from the current state, in units of its largest tabulated
  /// value. The load too: where a displacement turns back the rest of the shell goes on.
  double growth(const Eigen::VectorXd &to) const
  {
    const std::vector<double> a = row_at(current_), b = row_at(to);
    double largest = 0;
    for (std::size_t k = 0; k < a.size(); ++k)
      largest = std::max(largest, std::abs(b[k] - a[k]) / comparison_.largest_entry(k));
    return largest;
  }

  void open_row(int row)
  {
    if (row >= std::min(static_cast<int>(comparison_.rows.size()), options_.n_rows))
      return;
    ComparedRow &opened = comparison_.rows[row];
    opened.computed.assign(comparison_.n_columns(), 0);
    if (!opened.at_displacement)
      pending_.push_back({row, 0});
    for (int column = 1; column <= comparison_.n_columns() && opened.at_displacement; ++column)
      pending_.push_back({row, column});
    last_opened_ = row;
  }

  /// Computes what the last step went past. A row is looked for once the path has come to the row before it.
  void land_on_rows()
  {
    for (std::size_t i = 0; i < pending_.size();)
    {
      const Landing landing = pending_[i];
      ComparedRow &row = comparison_.rows[landing.row];
      const double value = row.table[landing.column];
      if ((value - row_at(previous_)[landing.column]) * (value - row_at(current_)[landing.column]) > 0)
      {
        ++i;
        continue;
      }
      const std::vector<double> landed = land(value, landing.column);
      if (row.at_displacement)
        row.computed[landing.column - 1] = landed[0];
      else
        row.computed.assign(landed.begin() + 1, landed.end());
      pending_.erase(pending_.begin() + static_cast<std::ptrdiff_t>(i));
      if (landing.row == last_opened_)
        open_row(landing.row + 1);
    }
  }

  /// The state between previous and current whose load (column 0) or displacement is `value`: Newton's method from the
  /// line between them; where it fails or runs away, regula falsi along the path.
  std::vector<double> land(double value, int column)
  {
    Eigen::VectorXd a = previous_, b = current_;
    for (int round = 0; round < 20; ++round)
    {
      const double before = row_at(a)[column], after = row_at(b)[column], part = (value - before) / (after - before);
      Eigen::VectorXd x = a + part * (b - a);
      hold(x, value, column);
      const int n_iterations = solve_near(x, (b - a).norm());
      log(n_iterations < 0 ? "  no row" : "  row", x, n_iterations);
      if (n_iterations >= 0)
        return row_at(x);
      if (!go_between(a, b, std::clamp(part, 0.1, 0.9), x))
        break;
      const double reached = row_at(x)[column];
      if (std::abs(reached - value) <= 1e-6 * comparison_.largest_entry(column))
        return row_at(x);
      ((value - before) * (value - reached) <= 0 ? b : a) = x;
    }
    fail(column == 0 ? "no equilibrium at this load" : "no equilibrium at a row's displacement", value);
  }

  /// As solve(), and fails when x moves by more than `radius`.
  int solve_near(Eigen::VectorXd &x, double radius)
  {
    const Eigen::VectorXd guess = x;
    const int n_iterations = solve(x, options_.max_iterations);
    return (x - guess).norm() <= radius ? n_iterations : -1;
  }

  /// Finds x on the path from a to b, `part` of the way; like every step of the path halved where it fails.
  bool go_between(const Eigen::VectorXd &a, const Eigen::VectorXd &b, double part, Eigen::VectorXd &x)
  {
    for (; part > 0.01; part *= 0.5)
    {
      x = a + part * (b - a);
      hold_along_path(a, x);
      const int n_iterations = solve_near(x, (b - a).norm());
      log(n_iterations < 0 ? "  no point between" : "  between", x, n_iterations);
      if (n_iterations >= 0)
        return true;
    }
    return false;
  }

  void release_controls()
  {
    along_path_->release();
    for (const std::shared_ptr<PathControl> &control : at_displacement_)
      control->release();
    system_.release(load_);
  }

  void hold_along_path(const Eigen::VectorXd &from, const Eigen::VectorXd &predicted)
  {
    release_controls();
    along_path_->prescribe(from, predicted);
  }

  /// The load, or a displacement: the path of a single point, along the observed axis.
  void hold(Eigen::VectorXd &x, double value, int column)
  {
    release_controls();
    if (column == 0)
    {
      system_.fix(load_);
      x[load_] = value;
      return;
    }
    const auto &[unknown, scale] = loaded_.observed[column - 1];
    x[unknown] = value / scale;
    Eigen::VectorXd from = x;
    from[unknown] -= 1;
    at_displacement_[column - 1]->prescribe(from, x);
  }

  LoadedShell &loaded_;
  EquilibriumSystem &system_;
  PathOptions options_;
  NewtonOptions newton_;
  int load_ = 0, last_opened_ = -1;
  std::shared_ptr<PathControl> along_path_;
  std::vector<std::shared_ptr<PathControl>> at_displacement_; ///< of each observed displacement
  std::vector<Landing> pending_;
  Eigen::VectorXd previous_, current_;
  CurveComparison comparison_;
};
} // namespace

double CurveComparison::largest_entry(std::size_t column) const
{
  double largest = 0;
  for (const ComparedRow &row : rows)
    largest = std::max(largest, std::abs(row.table[column]));
  return largest;
}

double CurveComparison::difference(int row, int column) const
{
  const ComparedRow &compared = rows.at(row);
  const std::size_t in_table = compared.at_displacement ? 0 : column + 1;
  return std::abs(compared.computed.at(column) - compared.table[in_table]) / largest_entry(in_table);
}

double CurveComparison::largest_difference(int column, bool at_displacement, double begin, double end) const
{
  double largest = 0;
  for (int row = 0; row < static_cast<int>(rows.size()); ++row)
    if (!rows[row].computed.empty() && rows[row].at_displacement == at_displacement && rows[row].table[0] > begin &&
        rows[row].table[0] <= end)
      largest = std::max(largest, difference(row, column));
  return largest;
}

CurveComparison follow_table(LoadedShell &loaded, const std::vector<std::vector<double>> &table,
                             const PathOptions &options)
{
  return TableFollower(loaded, table, options).run();
}
} // namespace pelvireg::reference_fe
