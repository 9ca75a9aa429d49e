#include "validation/report/pictures.h"

#include "validation/metrics/surface_distance.h"
#include "validation/report/scene.h"
#include "validation/report/vtk_data.h"

#include <vtkNew.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <map>

namespace pelvireg::report
{
namespace
{
using namespace dataset;
using Eigen::Vector3d;

const std::map<std::string, Colour> organ_colours = {{"bladder", {0.95, 0.80, 0.25}},
                                                     {"vagina", {0.95, 0.55, 0.65}},
                                                     {"uterus", {0.68, 0.36, 0.58}},
                                                     {"rectum", {0.60, 0.40, 0.26}}};
const Colour floor_colour = {0.62, 0.62, 0.62}, bar_colour = {0.62, 0.76, 0.88}, ghost_colour = {0.45, 0.45, 0.45},
             estimate_colour = {0.1, 0.1, 0.1}, arrow_colour = {0.1, 0.25, 0.6};
constexpr double error_scale = 6; ///< mm, the same in every report, so that pictures can be compared

/// Everything that one picture shows at one instant.
struct Organ
{
  std::string name;
  vtkSmartPointer<vtkPolyData> surface;
};

struct Box
{
  Vector3d lower = Vector3d::Constant(1e30), upper = Vector3d::Constant(-1e30);

  void add(const Points &points)
  {
    lower = lower.cwiseMin(points.colwise().minCoeff().transpose());
    upper = upper.cwiseMax(points.colwise().maxCoeff().transpose());
  }
  Vector3d centre() const { return 0.5 * (lower + upper); }
};

using Bars = std::vector<std::pair<Vector3d, Vector3d>>;

/// Organs, floor, bars and bands of the anatomy before anything moves.
struct RestScene
{
  std::vector<Organ> organs;
  vtkSmartPointer<vtkPolyData> floor, bars;
  Box box;
};

RestScene rest_of(const Anatomy &anatomy)
{
  RestScene rest;
  for (const RegistrationBody &body : anatomy.registration.bodies)
    if (organ_colours.contains(body.name))
    {
      rest.organs.push_back({body.name, to_vtk(body.points, body.outer_triangles, body.outer_region)});
      rest.box.add(body.points);
    }
  for (const ReferenceShell &shell : anatomy.reference.shells)
    if (shell.name == "pelvic_floor")
    {
      const SurfaceMesh surface = outer_surface(shell);
      rest.floor = to_vtk(surface.points, surface.triangles, surface.region);
      rest.box.add(surface.points);
    }
  const Bars bars = bars_at_rest(anatomy.reference);
  rest.bars = to_vtk(bars);
  for (const auto &[a, b] : bars)
  {
    rest.box.add(a.transpose());
    rest.box.add(b.transpose());
  }
  return rest;
}

std::vector<std::pair<std::string, Colour>> legend()
{
  std::vector<std::pair<std::string, Colour>> entries;
  for (const std::string &organ : organ_names)
    entries.emplace_back(organ, organ_colours.at(organ));
  return entries;
}

void draw_anatomy(const Anatomy &anatomy, View view, const std::filesystem::path &file)
{
  const RestScene rest = rest_of(anatomy);
  Scene scene;
  for (const Organ &organ : rest.organs)
  {
    const bool cut = view == View::sagittal;
    scene.add_surface(cut ? right_of(organ.surface, anatomy.dyn_plane).Get() : organ.surface.Get(),
                      organ_colours.at(organ.name));
  }
  if (rest.floor)
  {
    const bool cut = view == View::sagittal;
    scene.add_surface(cut ? right_of(rest.floor, anatomy.dyn_plane).Get() : rest.floor.Get(), floor_colour, 0.55);
  }
  const auto bars = view == View::sagittal ? right_of(rest.bars, anatomy.dyn_plane) : rest.bars;
  scene.add_tubes(bars, bar_colour, 0.7);
  if (view == View::oblique)
    scene.add_plane(anatomy.dyn_plane, rest.box.centre(), 75);
  auto names = legend();
  names.emplace_back("pelvic floor", floor_colour);
  names.emplace_back("ligaments and fasciae", bar_colour);
  scene.add_legend(names);
  scene.save(file, view, rest.box.lower, rest.box.upper);
}

/// The bodies of the registration: organs and the hexahedral bands that hold them.
void draw_registration_model(const Anatomy &anatomy, const std::filesystem::path &file)
{
  // faces of VTK_HEXAHEDRON as two triangles each
  constexpr int faces[12][3] = {{0, 3, 2}, {0, 2, 1}, {4, 5, 6}, {4, 6, 7}, {0, 1, 5}, {0, 5, 4},
                                {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};
  Scene scene;
  Box box;
  for (const RegistrationBody &body : anatomy.registration.bodies)
  {
    box.add(body.points);
    if (body.hexes.rows() == 0)
    {
      scene.add_surface(to_vtk(body.points, body.outer_triangles, body.outer_region), organ_colours.at(body.name));
      continue;
    }
    Triangles triangles(12 * body.hexes.rows(), 3);
    for (Eigen::Index h = 0; h < body.hexes.rows(); ++h)
      for (int f = 0; f < 12; ++f)
        triangles.row(12 * h + f) << body.hexes(h, faces[f][0]), body.hexes(h, faces[f][1]), body.hexes(h, faces[f][2]);
    const auto surface = to_vtk(body.points, triangles, {});
    scene.add_surface(surface, bar_colour, 0.75);
    scene.add_wireframe(surface, {0.3, 0.42, 0.55}, 0.5);
  }
  auto names = legend();
  names.emplace_back("ligaments and fasciae (hexahedra)", bar_colour);
  scene.add_legend(names);
  scene.save(file, View::oblique, box.lower, box.upper);
}

Points last_positions(const TruthSurface &surface)
{
  return surface.displacements.empty() ? surface.rest.points : surface.rest.points + surface.displacements.back();
}

/// Feet and vectors of arrows about 9 mm apart.
std::pair<Points, Points> arrows_of(const TruthSurface &surface)
{
  constexpr double spacing = 9;
  std::vector<Eigen::Index> chosen;
  for (Eigen::Index i = 0; i < surface.rest.points.rows(); ++i)
    if (std::none_of(chosen.begin(), chosen.end(),
                     [&](Eigen::Index j)
                     { return (surface.rest.points.row(i) - surface.rest.points.row(j)).norm() < spacing; }))
      chosen.push_back(i);
  return {surface.rest.points(chosen, Eigen::all), surface.displacements.back()(chosen, Eigen::all)};
}

void draw_truth(const Anatomy &anatomy, const Truth &truth, View view, const std::filesystem::path &file)
{
  Scene scene;
  Box box;
  const auto shown = [&](vtkSmartPointer<vtkPolyData> surface)
  { return view == View::sagittal ? right_of(surface, anatomy.dyn_plane) : surface; };
  for (const TruthSurface &surface : truth.surfaces)
  {
    const bool is_organ = organ_colours.contains(surface.name);
    const auto deformed = to_vtk(last_positions(surface), surface.rest.triangles, surface.rest.region);
    scene.add_surface(shown(deformed), is_organ ? organ_colours.at(surface.name) : floor_colour, is_organ ? 1 : 0.45);
    box.add(surface.rest.points);
    box.add(last_positions(surface));
    if (!is_organ)
      continue;
    const auto rest = to_vtk(surface.rest.points, surface.rest.triangles, surface.rest.region);
    if (view == View::sagittal)
      scene.add_surface(shown(rest), ghost_colour, 0.18);
    else
    {
      const auto [feet, vectors] = arrows_of(surface);
      scene.add_arrows(feet, vectors, arrow_colour);
    }
  }
  Bars bars;
  for (const TruthTruss &truss : truth.trusses)
  {
    const Points &ends = truss.positions.empty() ? truss.rest : truss.positions.back();
    bars.emplace_back(ends.row(0), ends.row(1));
    box.add(ends);
  }
  scene.add_tubes(shown(to_vtk(bars)), bar_colour, 0.7);
  auto names = legend();
  if (view == View::sagittal)
    names.emplace_back("rest shape", ghost_colour);
  else
    names.emplace_back("displacement, true length", arrow_colour);
  scene.add_legend(names);
  if (view == View::oblique)
    scene.add_plane(anatomy.dyn_plane, box.centre(), 75);
  scene.save(file, view, box.lower, box.upper);
}

/// Distance of each point of the truth's last surface to the registered surface: the error of the tables, by point.
void draw_error(const Truth &truth, const Estimate &estimate, View view, const std::filesystem::path &file)
{
  Scene scene;
  Box box;
  for (const EstimateSurface &registered : estimate.samples.front().surfaces)
  {
    const auto surface = std::find_if(truth.surfaces.begin(), truth.surfaces.end(),
                                      [&](const TruthSurface &other) { return other.name == registered.name; });
    if (surface == truth.surfaces.end() || registered.positions.empty())
      continue;
    const Points positions = last_positions(*surface);
    const Points &estimated = registered.positions.back();
    const std::vector<double> error =
        metrics::surface_distances(positions, estimated, registered.rest.triangles, registered.rest.region);
    const auto data = to_vtk(positions, surface->rest.triangles, surface->rest.region);
    add_point_array(data, "error_mm", Eigen::Map<const Eigen::VectorXd>(error.data(), error.size()));
    scene.add_coloured_surface(data, "error_mm", error_scale);
    scene.add_wireframe(to_vtk(estimated, registered.rest.triangles, registered.rest.region), estimate_colour, 0.35);
    box.add(positions);
    box.add(estimated);
  }
  scene.add_scale("error, mm", error_scale);
  scene.save(file, view, box.lower, box.upper);
}
} // namespace

std::vector<Picture> picture_list()
{
  return {
      {"anatomy_oblique.png", "The pelvis at rest with its supports; the blue plane is the DYN image plane."},
      {"anatomy_sagittal.png", "The pelvis at rest, cut open along the DYN plane, seen from the left."},
      {"registration_model.png", "The registration's bodies: hollow organs, full uterus, hexahedral supports."},
      {"truth_oblique.png", "The truth at the last increment; arrows are the displacements from rest, at true length."},
      {"truth_sagittal.png", "The truth at the last increment, cut open along the DYN plane; grey is the rest shape."},
      {"error_oblique.png", "The truth at the last increment, coloured by its distance to the registered surface "
                            "(lines; condition full)."},
      {"error_sagittal.png", "The same, seen from the left. Above the end of the scale the colour stays yellow."},
  };
}

void render_pictures(const Anatomy &anatomy, const Truth &truth, const std::vector<Estimate> &estimates,
                     const std::filesystem::path &folder)
{
  std::filesystem::create_directories(folder);
  draw_anatomy(anatomy, View::oblique, folder / "anatomy_oblique.png");
  draw_anatomy(anatomy, View::sagittal, folder / "anatomy_sagittal.png");
  draw_registration_model(anatomy, folder / "registration_model.png");
  if (truth.increments.empty())
    return;
  draw_truth(anatomy, truth, View::oblique, folder / "truth_oblique.png");
  draw_truth(anatomy, truth, View::sagittal, folder / "truth_sagittal.png");
  for (const Estimate &estimate : estimates)
    if (estimate.condition == "full" && !estimate.samples.empty())
    {
      draw_error(truth, estimate, View::oblique, folder / "error_oblique.png");
      draw_error(truth, estimate, View::sagittal, folder / "error_sagittal.png");
    }
}

void render_result(const std::filesystem::path &result, const std::filesystem::path &folder)
{
  const Anatomy anatomy = load_anatomy(result / "anatomy.h5");
  const bool has_truth = std::filesystem::exists(result / "truth.h5");
  const Truth truth = has_truth ? load_truth(result / "truth.h5") : Truth{};
  std::vector<Estimate> estimates;
  if (const auto file = result / "estimate-full.h5"; has_truth && std::filesystem::exists(file))
    estimates.push_back(load_estimate(file));
  render_pictures(anatomy, truth, estimates, folder);
}
} // namespace pelvireg::report
