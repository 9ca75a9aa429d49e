#include "synthetic/anatomy/case.h"
#include "synthetic/dataset/atomic_file.h"
#include "synthetic/dataset/error.h"
#include "validation/cli/commands.h"
#include "validation/cli/mesh_study_file.h"
#include "validation/cli/studies.h"
#include "validation/cli/study_field.h"
#include "validation/cli/version.h"
#include "validation/metrics/grid_convergence.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pelvireg::cli
{
namespace
{
using dataset::DiscretisationError;
using dataset::organ_names;

constexpr double bar_distance = 5; // mm
const std::vector<std::string> meshes = {"coarse", "middle", "fine"};

int n_shell_cells(const dataset::Anatomy &anatomy)
{
  int n = 0;
  for (const dataset::ReferenceShell &shell : anatomy.reference.shells)
    n += static_cast<int>(shell.cells.rows());
  return n;
}

/// mm^2, of the shells' outer faces at rest.
double shell_area(const dataset::Truth &truth)
{
  double area = 0;
  for (const auto &[name, rest, displacements] : truth.surfaces)
    for (Eigen::Index t = 0; t < rest.triangles.rows(); ++t)
    {
      const bool is_cap = rest.region[t] == static_cast<std::int32_t>(dataset::SurfaceRegion::cap);
      if (name == "uterus" || is_cap)
        continue;
      const Eigen::RowVector3d a = rest.points.row(rest.triangles(t, 0)), b = rest.points.row(rest.triangles(t, 1)),
                               c = rest.points.row(rest.triangles(t, 2));
      area += (b - a).cross(c - a).norm() / 2;
    }
  return area;
}

/// Points of one kind of all organs and increments on top of each other: away from bars, or near them.
struct Selection
{
  bool near_bars = false;
  metrics::GridSeries series;
  std::vector<std::size_t> organ, increment; ///< of each row
};

Selection select(const StudyPoints &points, const std::vector<StudyField> &fields, std::size_t n_increments,
                 bool near_bars)
{
  Selection selected;
  selected.near_bars = near_bars;
  dataset::Points *stacked[3] = {&selected.series.coarse, &selected.series.middle, &selected.series.fine};
  std::vector<Eigen::RowVector3d> rows[3];
  for (std::size_t k = 0; k < n_increments; ++k)
    for (std::size_t organ = 0; organ < organ_names.size(); ++organ)
      for (int mesh = 0; mesh < 3; ++mesh)
      {
        const dataset::Points displacements = fields[static_cast<std::size_t>(mesh)].displacements(organ, k);
        for (Eigen::Index i = 0; i < displacements.rows(); ++i)
        {
          if (points.near_bar[organ][static_cast<std::size_t>(i)] != near_bars)
            continue;
          rows[mesh].emplace_back(displacements.row(i));
          if (mesh > 0)
            continue;
          selected.organ.push_back(organ);
          selected.increment.push_back(k);
        }
      }
  for (int mesh = 0; mesh < 3; ++mesh)
  {
    stacked[mesh]->resize(static_cast<Eigen::Index>(rows[mesh].size()), 3);
    for (std::size_t i = 0; i < rows[mesh].size(); ++i)
      stacked[mesh]->row(static_cast<Eigen::Index>(i)) = rows[mesh][i];
  }
  return selected;
}

/// Mean and largest index by increment and organ, from the points away from bars.
void summarise(const Selection &selected, const metrics::GridConvergence &found, Eigen::Index n_increments,
               DiscretisationError &error)
{
  error.mean = error.max = error.max_near_bars = Eigen::VectorXd::Zero(n_increments);
  error.mean_by_organ = error.max_by_organ = dataset::Points4::Zero(n_increments, 4);
  dataset::Points4 count = dataset::Points4::Zero(n_increments, 4);
  for (std::size_t i = 0; i < found.index.size(); ++i)
  {
    const auto k = static_cast<Eigen::Index>(selected.increment[i]),
               organ = static_cast<Eigen::Index>(selected.organ[i]);
    error.mean_by_organ(k, organ) += found.index[i];
    error.max_by_organ(k, organ) = std::max(error.max_by_organ(k, organ), found.index[i]);
    ++count(k, organ);
  }
  error.mean = error.mean_by_organ.rowwise().sum().cwiseQuotient(count.rowwise().sum());
  error.max = error.max_by_organ.rowwise().maxCoeff();
  error.mean_by_organ = error.mean_by_organ.cwiseQuotient(count.cwiseMax(1));
}

void print_table(const DiscretisationError &error, const metrics::GridConvergence &found)
{
  fmt::print("\ncells of the shells: {}; size {:.2f}, {:.2f}, {:.2f} mm\n"
             "difference of displacements (root mean square over organs and increments, away from bars): coarse to "
             "middle {:.4f} mm, middle to fine {:.4f} mm\n"
             "observed order {:.2f}, used {:.2f}, safety factor {:.2f}\n"
             "grid convergence index of the fine mesh, the truth's, mm ({:.0f} % of the points lie within {:g} mm of a "
             "bar's end)\n",
             fmt::join(error.n_cells, ", "), error.cell_sizes[0], error.cell_sizes[1], error.cell_sizes[2],
             found.coarse_difference, found.fine_difference, error.observed_order, error.used_order,
             error.safety_factor, 100 * error.share_near_bars, error.bar_distance);
  fmt::print("{:>9}{:>9}{:>9}{:>11}", "increment", "mean", "max", "near bars");
  for (const std::string &organ : organ_names)
    fmt::print("{:>17}", organ);
  fmt::print("\n");
  for (Eigen::Index k = 0; k < error.mean.size(); ++k)
  {
    fmt::print("{:>9}{:>9.4f}{:>9.4f}{:>11.4f}", k + 1, error.mean[k], error.max[k], error.max_near_bars[k]);
    for (Eigen::Index organ = 0; organ < 4; ++organ)
      fmt::print("{:>17}", fmt::format("{:.4f}/{:.4f}", error.mean_by_organ(k, organ), error.max_by_organ(k, organ)));
    fmt::print("\n");
  }
}

DiscretisationError compare(const std::vector<dataset::Truth> &truths, const Eigen::Vector3d &sizes,
                            const dataset::Integers &n_cells)
{
  const std::vector<dataset::Truth> fine_first = {truths[2], truths[1], truths[0]};
  const StudyPoints points = study_points(fine_first, bar_distance);
  std::vector<StudyField> fields;
  for (const dataset::Truth &truth : truths)
    fields.emplace_back(truth, points);
  const std::size_t n_increments = truths[2].increments.size();
  const auto ratio = [&](int coarse, int fine)
  { return std::sqrt(static_cast<double>(n_cells[fine]) / n_cells[coarse]); };

  DiscretisationError error;
  error.cell_sizes = sizes;
  error.n_cells = n_cells;
  error.bar_distance = bar_distance;
  Selection away = select(points, fields, n_increments, false);
  away.series.coarse_ratio = ratio(0, 1);
  away.series.fine_ratio = ratio(1, 2);
  const metrics::GridConvergence found = metrics::grid_convergence(away.series);
  error.observed_order = found.observed_order;
  error.used_order = found.used_order;
  error.safety_factor = found.safety_factor;
  summarise(away, found, static_cast<Eigen::Index>(n_increments), error);

  // Near a bar's node the field need not converge; its index is taken with the order found elsewhere.
  const Selection near = select(points, fields, n_increments, true);
  const double growth = std::pow(away.series.fine_ratio, found.used_order);
  for (Eigen::Index i = 0; i < near.series.middle.rows(); ++i)
  {
    double &largest = error.max_near_bars[static_cast<Eigen::Index>(near.increment[static_cast<std::size_t>(i)])];
    const double difference = (near.series.middle.row(i) - near.series.fine.row(i)).norm();
    largest = std::max(largest, found.safety_factor * difference / (growth - 1));
  }
  const auto n_near = static_cast<double>(near.organ.size()), n_away = static_cast<double>(away.organ.size());
  error.share_near_bars = n_near / (n_near + n_away);
  print_table(error, found);
  return error;
}
} // namespace

void run_mesh_study(const StudySettings &settings, double ratio)
{
  if (!(ratio > 1))
    throw InputError(fmt::format("the ratio of the cell sizes is {}, but more than 1 is needed; give another", ratio));
  const std::string label = case_label(settings.case_name), text = anatomy::case_text(settings.case_name);
  Eigen::Vector3d sizes;
  dataset::Integers n_cells(3);
  std::vector<dataset::Truth> truths;
  for (int mesh = 0; mesh < 3; ++mesh)
  {
    const double factor = std::pow(ratio, 2 - mesh);
    std::string changed = text;
    for (const char *part : {"bladder", "vagina", "uterus", "rectum", "pelvic_floor"})
    {
      const std::string key = fmt::format("reference.cell_size.{}", part);
      changed = anatomy::with_value(changed, label, key,
                                    fmt::format("{:.6f}", factor * anatomy::number_in_case(text, label, key)));
    }
    const std::filesystem::path folder = settings.folder / meshes[static_cast<std::size_t>(mesh)];
    fmt::print("{} mesh, cells {:.2f} times as long as the case's\n", meshes[static_cast<std::size_t>(mesh)], factor);
    ResultDirectory directory(folder, settings.command_line, ResultDirectory::Missing::create);
    make_anatomy(directory, label, changed);
    make_truth(directory, settings.jobs);
    n_cells[mesh] = n_shell_cells(dataset::load_anatomy(folder / "anatomy.h5"));
    truths.push_back(dataset::load_truth(folder / "truth.h5"));
    sizes[mesh] = std::sqrt(shell_area(truths.back()) / n_cells[mesh]);
  }
  DiscretisationError error = compare(truths, sizes, n_cells);
  error.case_sha256 = case_digest(text, label);
  error.solver_sha256 = solver_digest();
  error.revision = revision();
  dataset::write_text_file(settings.folder / "mesh_study.json", mesh_study_text(label, error));
  fmt::print("\nwritten: {}\n", (settings.folder / "mesh_study.json").string());
}
} // namespace pelvireg::cli
