#include "tests/verification/reference_fe/decks/deck_case.h"

#include "reference_fe/decks/decks.h"
#include "reference_fe/elements/surface_face.h"
#include "reference_fe/model_checks.h"
#include "reference_fe/newton_solver.h"
#include "reference_fe/pelvis_model.h"
#include "synthetic/anatomy/case.h"
#include "synthetic/dataset/atomic_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <map>
#include <set>
#include <stdexcept>
#include <sys/resource.h>
#include <utility>

namespace pelvireg::reference_fe::deck_case
{
namespace
{
double processor_seconds(int who)
{
  rusage usage{};
  getrusage(who, &usage);
  return static_cast<double>(usage.ru_utime.tv_sec) + 1e-6 * static_cast<double>(usage.ru_utime.tv_usec);
}

/// The nodes of a shell whose cells are cut in four: old nodes first, each new one a weighted sum of a cell's nodes.
class Refinement
{
public:
  explicit Refinement(const dataset::ReferenceShell &shell) : shell_(shell)
  {
    for (const std::int32_t node : shell.fixed_nodes)
      fixed_.insert(node);
    for (Eigen::Index c = 0; c < shell.cells.rows(); ++c)
      cut(c);
  }

  dataset::ReferenceShell result() const
  {
    dataset::ReferenceShell fine = shell_;
    const Eigen::Index n_old = shell_.midsurface.rows(), n = n_old + static_cast<Eigen::Index>(weights_.size());
    fine.midsurface.conservativeResize(n, 3);
    fine.directors.conservativeResize(n, 3);
    fine.thickness.conservativeResize(n);
    for (Eigen::Index i = n_old; i < n; ++i)
    {
      const auto &[cell, weight] = weights_[static_cast<std::size_t>(i - n_old)];
      fine.midsurface.row(i).setZero();
      fine.directors.row(i).setZero();
      fine.thickness[i] = 0;
      for (int k = 0; k < 9; ++k)
      {
        const std::int32_t node = shell_.cells(cell, k);
        fine.midsurface.row(i) += weight[k] * shell_.midsurface.row(node);
        fine.directors.row(i) += weight[k] * shell_.directors.row(node);
        fine.thickness[i] += weight[k] * shell_.thickness[node];
      }
      fine.directors.row(i).normalize();
    }
    fine.cells.resize(static_cast<Eigen::Index>(cells_.size()), 9);
    fine.region.resize(fine.cells.rows());
    for (Eigen::Index c = 0; c < fine.cells.rows(); ++c)
    {
      for (int k = 0; k < 9; ++k)
        fine.cells(c, k) = cells_[static_cast<std::size_t>(c)][static_cast<std::size_t>(k)];
      fine.region[c] = shell_.region[c / 4];
    }
    fine.fixed_nodes.resize(static_cast<Eigen::Index>(fixed_.size()));
    std::copy(fixed_.begin(), fixed_.end(), fine.fixed_nodes.data());
    return fine;
  }

  /// The fine nodes around a coarse one and the hat function of the coarse one there: what one bar becomes.
  std::map<int, double> spread(int coarse_node)
  {
    static constexpr int at[9][2] = {{0, 0}, {4, 0}, {4, 4}, {0, 4}, {2, 0}, {4, 2}, {2, 4}, {0, 2}, {2, 2}};
    std::map<int, double> weight;
    for (Eigen::Index c = 0; c < shell_.cells.rows(); ++c)
      for (int k = 0; k < 9; ++k)
        if (shell_.cells(c, k) == coarse_node)
          for (int i = std::max(0, at[k][0] - 1); i <= std::min(4, at[k][0] + 1); ++i)
            for (int j = std::max(0, at[k][1] - 1); j <= std::min(4, at[k][1] + 1); ++j)
              weight[node_at(c, i, j)] = std::pow(0.5, std::abs(i - at[k][0]) + std::abs(j - at[k][1]));
    double total = 0;
    for (const auto &[node, w] : weight)
      total += w;
    for (auto &[node, w] : weight)
      w /= total;
    return weight;
  }

private:
  /// Node of a cell at quarter coordinates (i, j), 0 … 4 each.
  int node_at(Eigen::Index cell, int i, int j)
  {
    static constexpr int old_node[3][3] = {{0, 7, 3}, {4, 8, 6}, {1, 5, 2}};
    if (i % 2 == 0 && j % 2 == 0)
      return shell_.cells(cell, old_node[i / 2][j / 2]);
    std::pair<int, int> key = {-1 - static_cast<int>(cell), 4 * i + j}; // inside a cell
    const bool is_on_edge = i == 0 || i == 4 || j == 0 || j == 4;
    if (is_on_edge)
      key = i % 2 ? std::minmax(int(node_at(cell, i - 1, j)), int(node_at(cell, i + 1, j)))
                  : std::minmax(int(node_at(cell, i, j - 1)), int(node_at(cell, i, j + 1)));
    const auto [place, is_new] =
        number_.emplace(key, static_cast<int>(shell_.midsurface.rows()) + static_cast<int>(weights_.size()));
    if (is_new)
    {
      weights_.emplace_back(cell, face_shape(9, 0.5 * i - 1, 0.5 * j - 1).value);
      if (is_on_edge && fixed_.count(key.first) && fixed_.count(key.second))
        fixed_.insert(place->second);
    }
    return place->second;
  }

  void cut(Eigen::Index cell)
  {
    for (const auto &[i, j] : {std::pair(0, 0), std::pair(2, 0), std::pair(2, 2), std::pair(0, 2)})
    {
      static constexpr int at[9][2] = {{0, 0}, {2, 0}, {2, 2}, {0, 2}, {1, 0}, {2, 1}, {1, 2}, {0, 1}, {1, 1}};
      std::array<int, 9> &nodes = cells_.emplace_back();
      for (std::size_t k = 0; k < 9; ++k)
        nodes[k] = node_at(cell, i + at[k][0], j + at[k][1]);
    }
  }

  const dataset::ReferenceShell &shell_;
  std::set<int> fixed_;
  std::map<std::pair<int, int>, int> number_;
  std::vector<std::pair<Eigen::Index, Eigen::VectorXd>> weights_;
  std::vector<std::array<int, 9>> cells_;
};

/// Bars of one group that come to hang on the same node become one, with the mean of their far ends.
std::vector<dataset::ReferenceTruss> spread_bars(const std::vector<dataset::ReferenceTruss> &bars,
                                                 Refinement &refinement, const dataset::Points &nodes)
{
  std::map<std::pair<std::string, int>, dataset::ReferenceTruss> fine;
  for (const dataset::ReferenceTruss &bar : bars)
    for (const auto &[node, weight] : refinement.spread(bar.node_a))
    {
      const auto [entry, is_new] = fine.try_emplace({bar.group, node}, bar);
      dataset::ReferenceTruss &part = entry->second;
      const double area = weight * bar.area, before = is_new ? 0 : part.area;
      const Eigen::Vector3d far = bar.fixed_point + (nodes.row(node) - nodes.row(bar.node_a)).transpose();
      part.fixed_point = (before * part.fixed_point + area * far) / (before + area);
      part.node_a = node;
      part.area = before + area;
    }
  std::vector<dataset::ReferenceTruss> result;
  for (const auto &[key, bar] : fine)
    result.push_back(bar);
  return result;
}

/// Where bars hold the parts, at rest, on the mid-surface.
std::vector<Eigen::Vector3d> bar_ends(const dataset::Anatomy &anatomy)
{
  std::vector<Eigen::Vector3d> ends;
  const auto add = [&](const std::string &part, int node)
  {
    for (const dataset::ReferenceShell &shell : anatomy.reference.shells)
      if (shell.name == part)
        ends.push_back(shell.midsurface.row(node).transpose());
    for (const dataset::ReferenceSolid &solid : anatomy.reference.solids)
      if (solid.name == part)
        ends.push_back(solid.points.row(node).transpose());
  };
  for (const dataset::ReferenceTruss &truss : anatomy.reference.trusses)
  {
    add(truss.part_a, truss.node_a);
    add(truss.part_b, truss.node_b);
  }
  return ends;
}

void solve(PelvisModel &model, Eigen::VectorXd &solution)
{
  NewtonResult result;
  for (const bool mixed : {true, false})
  {
    for (const auto &shell : model.shells)
      shell->use_mixed_integration_points(mixed);
    Eigen::VectorXd trial = solution;
    result = solve_newton(model.system, trial, {});
    if (!result.converged())
      continue;
    solution = trial;
    return;
  }
  throw std::runtime_error(result.message);
}
} // namespace

dataset::Anatomy bare_parts(const std::string &case_name, const std::vector<std::string> &parts, int n_increments)
{
  dataset::Anatomy anatomy = cut_parts(anatomy::build_anatomy(anatomy::case_text(case_name), case_name), parts);
  dataset::ReferenceModel &reference = anatomy.reference;
  reference.n_increments = n_increments;
  reference.contact_pairs.clear();
  for (dataset::ReferenceShell &shell : reference.shells)
  {
    shell.has_cavity = false;
    shell.rims.clear();
    shell.pressure_share.resize(0); // by region
  }
  if (std::find(parts.begin(), parts.end(), "vagina") != parts.end())
    return anatomy;
  const std::string former = std::exchange(reference.shells.at(0).name, "vagina");
  for (dataset::ReferenceTruss &truss : reference.trusses)
    for (std::string *part : {&truss.part_a, &truss.part_b})
      if (*part == former)
        *part = "vagina";
  return anatomy;
}

dataset::Anatomy refined(const dataset::Anatomy &anatomy)
{
  dataset::Anatomy fine = anatomy;
  Refinement refinement(anatomy.reference.shells.at(0));
  fine.reference.shells[0] = refinement.result();
  fine.reference.trusses = spread_bars(anatomy.reference.trusses, refinement, fine.reference.shells[0].midsurface);
  return fine;
}

dataset::Truth moved_by_reference(const dataset::Anatomy &anatomy, const std::vector<double> &pressures,
                                  double *seconds)
{
  const double begin = processor_seconds(RUSAGE_SELF);
  check_model(anatomy.reference);
  PelvisModel model = build_pelvis_model(anatomy, 1);
  Eigen::VectorXd solution = Eigen::VectorXd::Zero(model.system.n_unknowns());
  dataset::Truth truth;
  for (const OuterSurface &surface : model.surfaces)
    truth.surfaces.push_back({surface.part, {}, {}});
  for (const double pressure : pressures)
  {
    model.probe->prescribe_pressure(pressure);
    solve(model, solution);
    for (std::size_t s = 0; s < model.surfaces.size(); ++s)
    {
      const std::vector<SurfaceNode> &vertices = model.surfaces[s].vertices;
      dataset::Points moved(static_cast<Eigen::Index>(vertices.size()), 3);
      for (std::size_t v = 0; v < vertices.size(); ++v)
        moved.row(static_cast<Eigen::Index>(v)) =
            (vertices[v].position(solution) - vertices[v].rest_position()).transpose();
      truth.surfaces[s].displacements.push_back(std::move(moved));
    }
  }
  if (seconds)
    *seconds = processor_seconds(RUSAGE_SELF) - begin;
  return truth;
}

dataset::Truth moved_by_calculix(const dataset::Anatomy &anatomy, const std::vector<double> &pressures,
                                 const DeckOptions &options, const std::filesystem::path &folder, double *seconds)
{
  dataset::write_text_file(folder / "deck.inp", abaqus_deck(anatomy, {pressures, {}}, options));
  const double begin = processor_seconds(RUSAGE_CHILDREN);
  const std::string command =
      fmt::format("cd '{}' && OMP_NUM_THREADS=1 OMP_THREAD_LIMIT=1 ccx deck >ccx.log 2>&1", folder.string());
  if (std::system(command.c_str()) != 0)
    throw std::runtime_error("ccx failed; see " + (folder / "ccx.log").string());
  if (seconds)
    *seconds = processor_seconds(RUSAGE_CHILDREN) - begin;
  return imported_truth(anatomy, read_frd(folder / "deck.frd"), "ccx", pressures.back());
}

FieldDifference difference(const dataset::Anatomy &anatomy, const dataset::Truth &a, const dataset::Truth &b,
                           std::size_t surface, Eigen::Index n_nodes, double clearance)
{
  const dataset::Points &of_a = a.surfaces.at(surface).displacements.back(),
                        &of_b = b.surfaces.at(surface).displacements.back();
  const std::vector<Eigen::Vector3d> ends = bar_ends(anatomy);
  FieldDifference result;
  result.n_nodes = static_cast<int>(n_nodes);
  for (Eigen::Index n = 0; n < n_nodes; ++n)
  {
    result.largest_displacement = std::max(result.largest_displacement, of_b.row(n).norm());
    const Eigen::Vector3d rest = a.surfaces[surface].rest.points.row(n).transpose();
    if (std::any_of(ends.begin(), ends.end(),
                    [&](const Eigen::Vector3d &end) { return (end - rest).norm() < clearance; }))
      continue;
    const double gap = (of_a.row(n) - of_b.row(n)).norm();
    ++result.n_away;
    result.mean += gap;
    result.largest = std::max(result.largest, gap);
  }
  result.mean /= std::max(1, result.n_away);
  return result;
}
} // namespace pelvireg::reference_fe::deck_case
