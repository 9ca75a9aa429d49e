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

const Colour bar_colour = {0.62, 0.76, 0.88}, ghost_colour = {0.45, 0.45, 0.45}, estimate_colour = {0.1, 0.1, 0.1},
             arrow_colour = {0.1, 0.25, 0.6}, cap_colour = {0.85, 0.85, 0.85};

/// Everything that one picture shows at one instant.
struct Organ
{
  std::string name;
  vtkSmartPointer<vtkPolyData> surface;
};

/// Points that a picture has to show.
class Shown
{
public:
  void add(const Points &points)
  {
    for (Eigen::Index i = 0; i < points.rows(); ++i)
      points_.emplace_back(points.row(i));
  }
  void add(const std::vector<Vector3d> &points) { points_.insert(points_.end(), points.begin(), points.end()); }
  const std::vector<Vector3d> &points() const { return points_; }

private:
  std::vector<Vector3d> points_;
};

using Bars = std::vector<std::pair<Vector3d, Vector3d>>;

/// Organs, floor, bars and bands of the anatomy before anything moves.
struct RestScene
{
  std::vector<Organ> organs;
  vtkSmartPointer<vtkPolyData> floor, bars;
  Shown organ_points, shown;
};

RestScene rest_of(const Anatomy &anatomy)
{
  RestScene rest;
  for (const RegistrationBody &body : anatomy.registration.bodies)
    if (organ_colours.contains(body.name))
    {
      rest.organs.push_back({body.name, to_vtk(body.points, body.outer_triangles, body.outer_region)});
      rest.organ_points.add(body.points);
    }
  for (const ReferenceShell &shell : anatomy.reference.shells)
    if (shell.name == "pelvic_floor")
    {
      const SurfaceMesh surface = outer_surface(shell);
      rest.floor = to_vtk(surface.points, surface.triangles, surface.region);
      rest.shown.add(surface.points);
    }
  rest.shown.add(rest.organ_points.points());
  const Bars bars = bars_at_rest(anatomy.reference);
  rest.bars = to_vtk(bars);
  for (const auto &[a, b] : bars)
  {
    rest.shown.add(a.transpose());
    rest.shown.add(b.transpose());
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
  RestScene rest = rest_of(anatomy);
  const bool cut = view == View::sagittal;
  Scene scene;
  for (const Organ &organ : rest.organs)
    if (cut)
      scene.add_cut_surface(organ.surface, organ_colours.at(organ.name), anatomy.dyn_plane);
    else
      scene.add_surface(organ.surface, organ_colours.at(organ.name));
  if (rest.floor)
    scene.add_surface(cut ? right_of(rest.floor, anatomy.dyn_plane).Get() : rest.floor.Get(), floor_colour, 0.55);
  scene.add_tubes(cut ? right_of(rest.bars, anatomy.dyn_plane).Get() : rest.bars.Get(), bar_colour, 0.7);
  if (!cut)
    rest.shown.add(scene.add_plane(anatomy.dyn_plane, rest.organ_points.points()));
  auto names = legend();
  names.emplace_back("pelvic floor", floor_colour);
  names.emplace_back("ligaments and fasciae", bar_colour);
  scene.add_legend(names);
  scene.save(file, view, rest.shown.points());
}

/// The bodies of the registration: organs and the hexahedral bands that hold them.
void draw_registration_model(const Anatomy &anatomy, const std::filesystem::path &file)
{
  // faces of VTK_HEXAHEDRON as two triangles each
  constexpr int faces[12][3] = {{0, 3, 2}, {0, 2, 1}, {4, 5, 6}, {4, 6, 7}, {0, 1, 5}, {0, 5, 4},
                                {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};
  Scene scene;
  Shown shown;
  for (const RegistrationBody &body : anatomy.registration.bodies)
  {
    shown.add(body.points);
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
  scene.save(file, View::oblique, shown.points());
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

void draw_truth_surface(Scene &scene, const TruthSurface &surface, View view, const Plane &plane)
{
  const auto deformed = to_vtk(last_positions(surface), surface.rest.triangles, surface.rest.region);
  const auto colour = organ_colours.find(surface.name);
  const bool cut = view == View::sagittal;
  if (colour == organ_colours.end()) // the floor is not closed
    scene.add_surface(cut ? right_of(deformed, plane).Get() : deformed.Get(), floor_colour, 0.45);
  else if (cut)
  {
    scene.add_cut_surface(deformed, colour->second, plane);
    scene.add_outline(to_vtk(surface.rest.points, surface.rest.triangles, surface.rest.region), ghost_colour, plane,
                      0.35);
  }
  else
  {
    scene.add_surface(deformed, colour->second);
    const auto [feet, vectors] = arrows_of(surface);
    scene.add_arrows(feet, vectors, arrow_colour);
  }
}

void draw_truth(const Anatomy &anatomy, const Truth &truth, View view, const std::filesystem::path &file)
{
  Scene scene;
  Shown organ_points, shown;
  for (const TruthSurface &surface : truth.surfaces)
  {
    draw_truth_surface(scene, surface, view, anatomy.dyn_plane);
    shown.add(surface.rest.points);
    shown.add(last_positions(surface));
    if (organ_colours.contains(surface.name))
      organ_points.add(last_positions(surface));
  }
  Bars bars;
  for (const TruthTruss &truss : truth.trusses)
  {
    const Points &ends = truss.positions.empty() ? truss.rest : truss.positions.back();
    bars.emplace_back(ends.row(0), ends.row(1));
    shown.add(ends);
  }
  const bool cut = view == View::sagittal;
  scene.add_tubes(cut ? right_of(to_vtk(bars), anatomy.dyn_plane).Get() : to_vtk(bars).Get(), bar_colour, 0.7);
  auto names = legend();
  if (cut)
    names.emplace_back("outline at rest", ghost_colour);
  else
  {
    names.emplace_back("displacement, true length", arrow_colour);
    shown.add(scene.add_plane(anatomy.dyn_plane, organ_points.points()));
  }
  scene.add_legend(names);
  scene.save(file, view, shown.points());
}

/// The scored triangles, or the caps.
Triangles triangles_where(const SurfaceMesh &surface, bool scored)
{
  std::vector<Eigen::Index> chosen;
  for (Eigen::Index t = 0; t < surface.triangles.rows(); ++t)
    if (metrics::is_scored(surface.region[t]) == scored)
      chosen.push_back(t);
  return surface.triangles(chosen, Eigen::all);
}

/// Distance of each point of the truth's last surface to the registered surface: the error of the tables, by point.
void draw_error(const Truth &truth, const Estimate &estimate, View view, const std::filesystem::path &file)
{
  Scene scene;
  Shown shown;
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
    const auto data = to_vtk(positions, triangles_where(surface->rest, true), {});
    add_point_array(data, "error_mm", Eigen::Map<const Eigen::VectorXd>(error.data(), error.size()));
    scene.add_coloured_surface(data, "error_mm", error_scale);
    scene.add_surface(to_vtk(positions, triangles_where(surface->rest, false), {}), cap_colour); // no metric there
    scene.add_wireframe(to_vtk(estimated, registered.rest.triangles, registered.rest.region), estimate_colour, 0.35);
    shown.add(positions);
    shown.add(estimated);
  }
  scene.add_scale("error, mm", error_scale);
  scene.save(file, view, shown.points());
}
} // namespace

std::vector<Picture> picture_list()
{
  return {
      {"anatomy_oblique.png", "The pelvis at rest with its supports; the blue plane is the DYN image plane."},
      {"anatomy_sagittal.png", "The pelvis at rest, cut open along the DYN plane, seen from the left."},
      {"registration_model.png", "The registration's bodies: hollow organs, full uterus, hexahedral supports."},
      {"truth_oblique.png", "The truth at the last increment; arrows are the displacements from rest, at true length."},
      {"truth_sagittal.png",
       "The truth at the last increment, cut open along the DYN plane; grey lines are the outlines at rest."},
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
    if (estimate.label() == "full" && !estimate.samples.empty())
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
    estimates.push_back(load_first_run(file));
  render_pictures(anatomy, truth, estimates, folder);
}
} // namespace pelvireg::report
