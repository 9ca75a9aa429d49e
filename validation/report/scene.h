// One off-screen still.
#pragma once

#include "synthetic/dataset/geometry.h"
#include "validation/report/colour_map.h"

#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>

#include <array>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace pelvireg::report
{
enum class View
{
  sagittal, ///< from the left: anterior on the left side of the picture, cranial up, as sagittal images are shown
  oblique   ///< from the left, from the front and from above
};

/// Collects what is to be seen, then draws it. Parallel projection, white background.
class Scene
{
public:
  Scene();

  /// Smooth-shaded surface; the inside is darker, so that cut-open organs read as such.
  void add_surface(vtkPolyData *surface, const Colour &colour, double opacity = 1);
  /// Surface coloured by the point array `array` between 0 and `maximum`, with a labelled bar.
  void add_coloured_surface(vtkPolyData *surface, const std::string &array, double maximum);
  void add_scale(const std::string &title, double maximum);
  /// The edges of the triangles.
  void add_wireframe(vtkPolyData *surface, const Colour &colour, double opacity);
  /// Lines as round bars of the given radius, mm.
  void add_tubes(vtkPolyData *lines, const Colour &colour, double radius, double opacity = 1);
  /// Arrows from `feet` along `vectors` (k x 3, mm), at true length.
  void add_arrows(const dataset::Points &feet, const dataset::Points &vectors, const Colour &colour);
  /// The rectangle of the plane that holds the projections of `points`, with a margin. Returns its corners.
  std::vector<Eigen::Vector3d> add_plane(const dataset::Plane &plane, const std::vector<Eigen::Vector3d> &points);
  /// The part of a closed surface on the negative side of the plane (what lies to the left is taken away), with the cut
  /// face in a light tint and its outline in the full colour.
  void add_cut_surface(vtkPolyData *surface, const Colour &colour, const dataset::Plane &plane);
  /// The outline of a surface in the plane.
  void add_outline(vtkPolyData *surface, const Colour &colour, const dataset::Plane &plane, double radius);
  /// Names in their colours, in a row at the bottom.
  void add_legend(const std::vector<std::pair<std::string, Colour>> &entries);

  /// Draw everything seen from `view`, so that `shown` (points, mm) fills the picture, and write a PNG.
  /// Throws std::runtime_error when the file cannot be written.
  void save(const std::filesystem::path &file, View view, const std::vector<Eigen::Vector3d> &shown);

private:
  vtkNew<vtkRenderer> renderer_;
  bool has_scale_ = false, has_legend_ = false;
};

/// The part of a surface on the negative side of the plane (its left side is taken away).
vtkSmartPointer<vtkPolyData> right_of(vtkPolyData *surface, const dataset::Plane &plane);
} // namespace pelvireg::report
