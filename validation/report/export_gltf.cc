#include "validation/report/export_gltf.h"

#include "synthetic/dataset/atomic_file.h"
#include "validation/metrics/surface_distance.h"
#include "validation/report/gltf.h"
#include "validation/report/surface_error.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <limits>

namespace pelvireg::report
{
namespace
{
using namespace dataset;
using Eigen::Vector3d;

constexpr Colour plane_colour = {0.35, 0.60, 0.90}, cap_colour = {0.85, 0.85, 0.85};
constexpr double plane_opacity = 0.35, plane_margin = 8; // mm around what it cuts

Triangles triangles_where(const SurfaceMesh &mesh, bool is_scored)
{
  std::vector<Eigen::Index> chosen;
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t)
    if (metrics::is_scored(mesh.region[t]) == is_scored)
      chosen.push_back(t);
  return mesh.triangles(chosen, Eigen::all);
}

/// A rectangle of the plane that holds the shadows of all meshes.
GltfMesh image_plane(const Plane &plane, const std::vector<GltfMesh> &meshes)
{
  const Vector3d up = (Vector3d::UnitZ() - plane.normal.z() * plane.normal).normalized(),
                 across = up.cross(plane.normal);
  Eigen::Vector2d lower = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity()), upper = -lower;
  for (const GltfMesh &mesh : meshes)
    for (Eigen::Index i = 0; i < mesh.points.rows(); ++i)
    {
      const Vector3d from_origin = mesh.points.row(i).transpose() - plane.origin;
      const Eigen::Vector2d place(from_origin.dot(across), from_origin.dot(up));
      lower = lower.cwiseMin(place);
      upper = upper.cwiseMax(place);
    }
  lower.array() -= plane_margin;
  upper.array() += plane_margin;
  GltfMesh quad{.name = "image_plane", .points = Points(4, 3), .point_colours = {}, .error = {}, .parts = {}};
  const auto corner = [&](double x, double y) { return (plane.origin + x * across + y * up).transpose().eval(); };
  quad.points << corner(lower.x(), lower.y()), corner(upper.x(), lower.y()), corner(upper.x(), upper.y()),
      corner(lower.x(), upper.y());
  Triangles halves(2, 3);
  halves << 0, 1, 2, 0, 2, 3;
  quad.parts.push_back({halves, plane_colour, plane_opacity});
  return quad;
}

GltfScene scene_of(const Anatomy &anatomy, const std::string &what, const std::string &state)
{
  return {.name = what,
          .remarks = {{"case", anatomy.case_name},
                      {"frame", "mm, LPS (+x left, +y posterior, +z superior): (x, y, z) is (x, z, -y) / 1000 here"},
                      {"state", state}},
          .meshes = {}};
}

void write(GltfScene scene, const Plane &plane, const std::filesystem::path &file)
{
  if (!scene.meshes.empty())
    scene.meshes.push_back(image_plane(plane, scene.meshes));
  write_text_file(file, glb(scene));
}

GltfMesh registered(const Truth &truth, const EstimateSurface &surface)
{
  const Points &positions = surface.positions.back();
  GltfMesh mesh{.name = surface.name,
                .points = positions,
                .point_colours = {},
                .error = distances_to_truth(truth, surface.name, truth.increments.size(), positions),
                .parts = {}};
  for (const double error : mesh.error)
    mesh.point_colours.push_back(viridis_at(error / error_scale));
  mesh.parts = {{.triangles = triangles_where(surface.rest, true), .has_point_colours = !mesh.error.empty()},
                {.triangles = triangles_where(surface.rest, false), .colour = cap_colour}};
  return mesh;
}

void export_estimate(const Anatomy &anatomy, const Truth &truth, const Estimate &estimate,
                     const std::filesystem::path &folder)
{
  const EstimateSample &run = estimate.samples.front();
  GltfScene scene = scene_of(anatomy, estimate.label(), fmt::format("run {}, step {}", run.sample, run.steps.size()));
  scene.remarks["colour"] =
      fmt::format("viridis, 0 to {:g} mm: distance of the registered point to the truth's surface, "
                  "which is _ERROR_MM; grey caps have none",
                  error_scale);
  for (const EstimateSurface &surface : run.surfaces)
    if (!surface.positions.empty())
      scene.meshes.push_back(registered(truth, surface));
  write(std::move(scene), anatomy.dyn_plane, folder / (estimate.label() + ".glb"));
}
} // namespace

void export_gltf(const Anatomy &anatomy, const Truth &truth, const std::vector<Estimate> &estimates,
                 const std::filesystem::path &folder)
{
  std::filesystem::create_directories(folder);
  GltfScene moved = scene_of(anatomy, "truth", fmt::format("increment {}", truth.increments.size()));
  for (const TruthSurface &surface : truth.surfaces)
  {
    const auto colour = organ_colours.find(surface.name);
    moved.meshes.push_back({.name = surface.name,
                            .points = surface.rest.points + displacement_of(surface, truth.increments.size()),
                            .point_colours = {},
                            .error = {},
                            .parts = {{.triangles = surface.rest.triangles,
                                       .colour = colour == organ_colours.end() ? floor_colour : colour->second}}});
  }
  write(std::move(moved), anatomy.dyn_plane, folder / "truth.glb");
  for (const Estimate &estimate : estimates)
    if (!estimate.samples.empty())
      export_estimate(anatomy, truth, estimate, folder);
}
} // namespace pelvireg::report
