#include "reference_fe/constraints/displacement_probe.h"
#include "reference_fe/decks/deck_mesh.h"
#include "reference_fe/decks/decks.h"
#include "reference_fe/outer_surface.h"
#include "synthetic/dataset/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pelvireg::reference_fe
{
namespace
{
constexpr double rest_tolerance = 1e-3; ///< mm: .frd files have six digits
constexpr int most_layers = 8;
constexpr double not_known = -1;

/// The deck that the results belong to: the number of layers shows in its nodes.
DeckMesh deck_of(const dataset::ReferenceModel &reference, const NodalResults &results)
{
  std::string counts;
  for (int layers = 1; layers <= most_layers; ++layers)
  {
    DeckMesh mesh(reference, layers);
    if (std::equal(results.ids.begin(), results.ids.end(), mesh.nodes().begin(), mesh.nodes().end(),
                   [](int id, const auto &node) { return id == node.first; }))
      return mesh;
    counts += fmt::format("{}{}", layers == 1 ? "" : ", ", mesh.nodes().size());
  }
  throw InputError(
      fmt::format("the results have {} nodes{}, the deck of this anatomy has {} with 1, 2, … {} layers; "
                  "give results of every node of that deck, with its ids",
                  results.ids.size(),
                  results.ids.empty() ? "" : fmt::format(" (ids {} to {})", results.ids.front(), results.ids.back()),
                  counts, most_layers));
}

void check_rest(const DeckMesh &mesh, const NodalResults &results)
{
  Eigen::Index row = 0;
  for (const auto &[id, rest] : mesh.nodes())
  {
    const Eigen::Vector3d found = results.rest->row(row++).transpose();
    if (!((found - rest).norm() <= rest_tolerance))
      throw InputError(
          fmt::format("node {} of the results lies at ({:.4g}, {:.4g}, {:.4g}) mm at rest, in the anatomy at "
                      "({:.4g}, {:.4g}, {:.4g}); give results of the deck of this directory",
                      id, found[0], found[1], found[2], rest[0], rest[1], rest[2]));
  }
}

void check_increments(const NodalResults &results, int n_increments)
{
  bool is_right = results.times.size() == static_cast<std::size_t>(n_increments);
  for (std::size_t i = 0; is_right && i < results.times.size(); ++i)
    is_right = std::abs(results.times[i] - static_cast<double>(i + 1)) <= 1e-4;
  if (!is_right)
    throw InputError(fmt::format("the results hold displacements at {} times{}, must be at the {} times 1, 2, … {} "
                                 "(the end of every step); let every step of the deck converge and write U at its end",
                                 results.times.size(),
                                 results.times.empty() ? "" : fmt::format(", the last {:g}", results.times.back()),
                                 n_increments, n_increments));
}

/// Displacement of a point of the deck.
Eigen::Vector3d displacement_of(const DeckPoint &point, const NodalResults &results, const dataset::Points &layer)
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < point.nodes.size(); ++i)
  {
    const auto row = std::lower_bound(results.ids.begin(), results.ids.end(), point.nodes[i]) - results.ids.begin();
    sum += point.weights[i] * layer.row(row).transpose();
  }
  return sum;
}
/// Node of the part behind a vertex of an outer surface whose unknowns begin at 0.
int node_of(const SurfaceNode &vertex, bool is_shell)
{
  return vertex.first_unknown / (is_shell ? 7 : 3);
}

dataset::TruthSurface displaced(const OuterSurface &outer, bool is_shell, const DeckMesh &mesh,
                                const NodalResults &results)
{
  dataset::TruthSurface surface;
  surface.name = outer.part;
  const auto n_vertices = static_cast<Eigen::Index>(outer.vertices.size());
  surface.rest.points.resize(n_vertices, 3);
  surface.rest.triangles = outer.triangles;
  surface.rest.region = outer.region;
  surface.displacements.assign(results.times.size(), dataset::Points(n_vertices, 3));
  for (Eigen::Index v = 0; v < n_vertices; ++v)
  {
    const SurfaceNode &vertex = outer.vertices[static_cast<std::size_t>(v)];
    surface.rest.points.row(v) = vertex.rest_position().transpose();
    const DeckPoint point = mesh.outer_point(outer.part, node_of(vertex, is_shell));
    for (std::size_t i = 0; i < results.times.size(); ++i)
      surface.displacements[i].row(v) = displacement_of(point, results, results.displacements[i]).transpose();
  }
  return surface;
}

dataset::TruthTruss displaced(const DeckBar &bar, const DeckMesh &mesh, const NodalResults &results)
{
  dataset::TruthTruss truss{bar.group, dataset::Points(2, 3), {}};
  truss.rest << mesh.nodes().at(bar.node_a).transpose(), mesh.nodes().at(bar.node_b).transpose();
  for (const dataset::Points &layer : results.displacements)
  {
    dataset::Points ends = truss.rest;
    ends.row(0) += displacement_of({{bar.node_a}, {1}}, results, layer).transpose();
    ends.row(1) += displacement_of({{bar.node_b}, {1}}, results, layer).transpose();
    truss.positions.push_back(std::move(ends));
  }
  return truss;
}

/// In-plane displacement of the vagina's outer contour, as the reference measures its own.
std::vector<double> mean_displacements(const dataset::Truth &truth, const dataset::Plane &plane)
{
  const auto vagina = std::find_if(truth.surfaces.begin(), truth.surfaces.end(),
                                   [](const dataset::TruthSurface &surface) { return surface.name == "vagina"; });
  if (vagina == truth.surfaces.end())
    throw InputError("the anatomy has no part 'vagina', whose displacement is recorded; import into a whole case");
  std::vector<SurfaceNode> vertices;
  for (Eigen::Index v = 0; v < vagina->rest.points.rows(); ++v)
    vertices.push_back({.first_unknown = static_cast<int>(3 * v), .rest = vagina->rest.points.row(v).transpose()});
  const DisplacementProbe probe(probe_points(vertices, vagina->rest.triangles, vagina->rest.region, plane),
                                plane.normal, 0);
  std::vector<double> means;
  for (const dataset::Points &layer : vagina->displacements)
    means.push_back(probe.mean_displacement(Eigen::Map<const Eigen::VectorXd>(layer.data(), layer.size())));
  return means;
}
} // namespace

dataset::Truth imported_truth(const dataset::Anatomy &anatomy, const NodalResults &results, const std::string &source,
                              double pressure)
{
  const dataset::ReferenceModel &reference = anatomy.reference;
  if (!std::isfinite(pressure))
    throw InputError(fmt::format("the abdominal pressure is {}, must be finite; give it in MPa", pressure));
  const DeckMesh mesh = deck_of(reference, results);
  if (results.rest)
    check_rest(mesh, results);
  check_increments(results, reference.n_increments);

  dataset::Truth truth;
  truth.case_name = anatomy.case_name;
  truth.source = source;
  for (const dataset::ReferenceShell &shell : reference.shells)
    truth.surfaces.push_back(displaced(outer_surface(shell, 0), true, mesh, results));
  for (const dataset::ReferenceSolid &solid : reference.solids)
    truth.surfaces.push_back(displaced(outer_surface(solid, 0), false, mesh, results));
  std::stable_sort(truth.surfaces.begin(), truth.surfaces.end(),
                   [](const auto &a, const auto &b) { return table_rank(a.name) < table_rank(b.name); });
  for (const DeckBar &bar : mesh.bars())
    truth.trusses.push_back(displaced(bar, mesh, results));
  const std::vector<double> means = mean_displacements(truth, anatomy.dyn_plane);
  for (std::size_t i = 0; i < means.size(); ++i)
    truth.increments.push_back({.pressure = pressure * static_cast<double>(i + 1) / static_cast<double>(means.size()),
                                .mean_vaginal_displacement = means[i],
                                .residual = not_known,
                                .energy = not_known,
                                .newton_iterations = static_cast<int>(not_known),
                                .cuts = static_cast<int>(not_known),
                                .max_penetration = not_known,
                                .cavity_volumes = Eigen::VectorXd(0),
                                .cavity_pressures = Eigen::VectorXd(0)});
  truth.cavity_rest_volumes.resize(0);
  return truth;
}

DeckLoads loads_of(const dataset::Truth &truth, bool with_cavities)
{
  DeckLoads loads;
  for (const dataset::IncrementRecord &increment : truth.increments)
  {
    loads.pressure.push_back(increment.pressure);
    for (std::size_t c = 0; with_cavities && c < truth.cavity_names.size(); ++c)
      loads.cavity_pressure[truth.cavity_names[c]].push_back(increment.cavity_pressures[static_cast<Eigen::Index>(c)]);
  }
  return loads;
}
} // namespace pelvireg::reference_fe
