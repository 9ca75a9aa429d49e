#include "validation/report/scene.h"

#include "validation/report/vtk_data.h"

#include <vtkActor.h>
#include <vtkArrowSource.h>
#include <vtkCamera.h>
#include <vtkClipClosedSurface.h>
#include <vtkClipPolyData.h>
#include <vtkColorTransferFunction.h>
#include <vtkCutter.h>
#include <vtkGlyph3D.h>
#include <vtkLightKit.h>
#include <vtkPlane.h>
#include <vtkPlaneCollection.h>
#include <vtkPlaneSource.h>
#include <vtkPNGWriter.h>
#include <vtkPointData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataNormals.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkScalarBarActor.h>
#include <vtkStripper.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkTubeFilter.h>
#include <vtkWindowToImageFilter.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <stdexcept>

namespace pelvireg::report
{
namespace
{
constexpr int width = 1000, height = 750;
constexpr int font_size = 20;

vtkSmartPointer<vtkColorTransferFunction> viridis_to(double maximum)
{
  auto function = vtkSmartPointer<vtkColorTransferFunction>::New();
  for (std::size_t i = 0; i < viridis.size(); ++i)
    function->AddRGBPoint(maximum * static_cast<double>(i) / (viridis.size() - 1), viridis[i][0], viridis[i][1],
                          viridis[i][2]);
  return function;
}

vtkSmartPointer<vtkPolyDataMapper> smooth_mapper(vtkPolyData *surface)
{
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputData(surface);
  normals->SetFeatureAngle(60);
  normals->ConsistencyOff();
  auto mapper = vtkSmartPointer<vtkPolyDataMapper>::New();
  mapper->SetInputConnection(normals->GetOutputPort());
  mapper->ScalarVisibilityOff();
  return mapper;
}

vtkSmartPointer<vtkActor> actor_of(vtkPolyDataMapper *mapper, const Colour &colour, double opacity)
{
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  vtkProperty *property = actor->GetProperty();
  property->SetColor(colour[0], colour[1], colour[2]);
  property->SetOpacity(opacity);
  property->SetSpecular(0.15);
  property->SetSpecularPower(20);
  return actor;
}
} // namespace

Scene::Scene()
{
  renderer_->SetBackground(1, 1, 1);
  renderer_->SetUseDepthPeeling(1);
  renderer_->SetMaximumNumberOfPeels(4);
  renderer_->SetOcclusionRatio(0.0);
  vtkNew<vtkLightKit> lights;
  lights->SetKeyLightIntensity(0.8);
  lights->SetKeyToFillRatio(1.6);
  lights->SetKeyToHeadRatio(2.0);
  lights->AddLightsToRenderer(renderer_);
}

void Scene::add_surface(vtkPolyData *surface, const Colour &colour, double opacity)
{
  const auto actor = actor_of(smooth_mapper(surface), colour, opacity);
  vtkNew<vtkProperty> inside;
  inside->DeepCopy(actor->GetProperty());
  inside->SetColor(0.62 * colour[0], 0.62 * colour[1], 0.62 * colour[2]);
  inside->SetSpecular(0);
  actor->SetBackfaceProperty(inside);
  renderer_->AddActor(actor);
}

void Scene::add_coloured_surface(vtkPolyData *surface, const std::string &array, double maximum)
{
  surface->GetPointData()->SetActiveScalars(array.c_str());
  const auto mapper = smooth_mapper(surface);
  mapper->ScalarVisibilityOn();
  mapper->SetScalarModeToUsePointData();
  mapper->InterpolateScalarsBeforeMappingOn();
  mapper->SetLookupTable(viridis_to(maximum));
  mapper->UseLookupTableScalarRangeOn();
  const auto actor = actor_of(mapper, {1, 1, 1}, 1);
  actor->GetProperty()->SetAmbient(0.45); // the colour is a figure: keep shading weak
  actor->GetProperty()->SetDiffuse(0.6);
  actor->GetProperty()->SetSpecular(0);
  renderer_->AddActor(actor);
}

void Scene::add_scale(const std::string &title, double maximum)
{
  vtkNew<vtkScalarBarActor> bar;
  bar->SetLookupTable(viridis_to(maximum));
  bar->SetTitle(title.c_str());
  bar->SetNumberOfLabels(5);
  bar->SetLabelFormat("%.0f");
  bar->UnconstrainedFontSizeOn();
  for (vtkTextProperty *text : {bar->GetTitleTextProperty(), bar->GetLabelTextProperty()})
  {
    text->SetColor(0.1, 0.1, 0.1);
    text->SetFontSize(font_size);
    text->ShadowOff();
    text->ItalicOff();
    text->BoldOff();
  }
  bar->SetPosition(0.87, 0.12);
  bar->SetWidth(0.1);
  bar->SetHeight(0.7);
  renderer_->AddActor2D(bar);
  has_scale_ = true;
}

void Scene::add_wireframe(vtkPolyData *surface, const Colour &colour, double opacity)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(surface);
  mapper->ScalarVisibilityOff();
  const auto actor = actor_of(mapper, colour, opacity);
  actor->GetProperty()->SetRepresentationToWireframe();
  actor->GetProperty()->LightingOff();
  actor->GetProperty()->SetLineWidth(1);
  renderer_->AddActor(actor);
}

void Scene::add_tubes(vtkPolyData *lines, const Colour &colour, double radius, double opacity)
{
  vtkNew<vtkTubeFilter> tubes;
  tubes->SetInputData(lines);
  tubes->SetRadius(radius);
  tubes->SetNumberOfSides(10);
  tubes->CappingOn();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(tubes->GetOutputPort());
  mapper->ScalarVisibilityOff();
  renderer_->AddActor(actor_of(mapper, colour, opacity));
}

void Scene::add_arrows(const dataset::Points &feet, const dataset::Points &vectors, const Colour &colour)
{
  vtkNew<vtkPolyData> data;
  data->SetPoints(to_vtk(feet));
  add_point_array(data, "vectors", vectors);
  data->GetPointData()->SetActiveVectors("vectors");
  vtkNew<vtkArrowSource> arrow;
  arrow->SetShaftRadius(0.04);
  arrow->SetTipRadius(0.12);
  arrow->SetTipLength(0.3);
  vtkNew<vtkGlyph3D> glyphs;
  glyphs->SetInputData(data);
  glyphs->SetSourceConnection(arrow->GetOutputPort());
  glyphs->SetVectorModeToUseVector();
  glyphs->SetScaleModeToScaleByVector();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(glyphs->GetOutputPort());
  mapper->ScalarVisibilityOff();
  renderer_->AddActor(actor_of(mapper, colour, 1));
}

std::vector<Eigen::Vector3d> Scene::add_plane(const dataset::Plane &plane, const std::vector<Eigen::Vector3d> &points)
{
  constexpr double margin = 6; // mm
  const Eigen::Vector3d up = (Eigen::Vector3d::UnitZ() - plane.normal.z() * plane.normal).normalized();
  const Eigen::Vector3d aside = up.cross(plane.normal);
  Eigen::Vector2d lower = Eigen::Vector2d::Constant(1e30), upper = -lower;
  for (const Eigen::Vector3d &point : points)
  {
    const Eigen::Vector3d relative = point - plane.origin;
    lower = lower.cwiseMin(Eigen::Vector2d(relative.dot(aside) - margin, relative.dot(up) - margin));
    upper = upper.cwiseMax(Eigen::Vector2d(relative.dot(aside) + margin, relative.dot(up) + margin));
  }
  const auto corner = [&](double a, double b) -> Eigen::Vector3d { return plane.origin + a * aside + b * up; };
  std::vector<Eigen::Vector3d> corners = {corner(lower[0], lower[1]), corner(upper[0], lower[1]),
                                          corner(upper[0], upper[1]), corner(lower[0], upper[1])};
  vtkNew<vtkPlaneSource> source;
  source->SetOrigin(corners[0].data());
  source->SetPoint1(corners[1].data());
  source->SetPoint2(corners[3].data());
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(source->GetOutputPort());
  const auto actor = actor_of(mapper, {0.35, 0.55, 0.85}, 0.16);
  actor->GetProperty()->LightingOff();
  renderer_->AddActor(actor);
  std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> border;
  for (int i = 0; i < 4; ++i)
    border.emplace_back(corners[i], corners[(i + 1) % 4]);
  add_tubes(to_vtk(border), {0.25, 0.4, 0.7}, 0.35);
  return corners;
}

void Scene::add_cut_surface(vtkPolyData *surface, const Colour &colour, const dataset::Plane &plane)
{
  vtkNew<vtkPlane> function; // vtkClipClosedSurface keeps the side to which the normal points
  function->SetOrigin(plane.origin.data());
  function->SetNormal(-plane.normal.x(), -plane.normal.y(), -plane.normal.z());
  vtkNew<vtkPlaneCollection> planes;
  planes->AddItem(function);
  vtkNew<vtkClipClosedSurface> clip;
  clip->SetInputData(surface);
  clip->SetClippingPlanes(planes);
  clip->SetScalarModeToColors();
  clip->SetBaseColor(colour[0], colour[1], colour[2]);
  clip->SetClipColor(0.45 + 0.55 * colour[0], 0.45 + 0.55 * colour[1], 0.45 + 0.55 * colour[2]);
  clip->Update();
  const auto mapper = smooth_mapper(clip->GetOutput());
  mapper->ScalarVisibilityOn();
  mapper->SetScalarModeToUseCellData();
  renderer_->AddActor(actor_of(mapper, colour, 1));
  add_outline(surface, colour, plane, 0.7);
}

void Scene::add_outline(vtkPolyData *surface, const Colour &colour, const dataset::Plane &plane, double radius)
{
  vtkNew<vtkPlane> function;
  function->SetOrigin(plane.origin.data());
  function->SetNormal(plane.normal.data());
  vtkNew<vtkCutter> cutter;
  cutter->SetInputData(surface);
  cutter->SetCutFunction(function);
  vtkNew<vtkStripper> stripper;
  stripper->SetInputConnection(cutter->GetOutputPort());
  stripper->JoinContiguousSegmentsOn();
  stripper->Update();
  if (stripper->GetOutput()->GetNumberOfPoints() > 0)
    add_tubes(stripper->GetOutput(), colour, radius);
}

void Scene::add_legend(const std::vector<std::pair<std::string, Colour>> &entries)
{
  double x = 20;
  for (const auto &[name, colour] : entries)
  {
    vtkNew<vtkTextActor> text;
    text->SetInput(name.c_str());
    text->SetPosition(x, 18);
    text->GetTextProperty()->SetFontSize(font_size);
    text->GetTextProperty()->BoldOn();
    text->GetTextProperty()->SetColor(0.8 * colour[0], 0.8 * colour[1], 0.8 * colour[2]);
    renderer_->AddActor2D(text);
    x += 0.56 * font_size * static_cast<double>(name.size()) + 28; // mean width of a letter of this font
  }
  has_legend_ = true;
}

void Scene::save(const std::filesystem::path &file, View view, const std::vector<Eigen::Vector3d> &shown)
{
  const Eigen::Vector3d from =
      view == View::sagittal ? Eigen::Vector3d(1, 0, 0) : Eigen::Vector3d(0.72, -0.85, 0.42).normalized();
  const Eigen::Vector3d right = (-from).cross(Eigen::Vector3d::UnitZ()).normalized(), up = right.cross(-from);
  Eigen::Vector2d lower = Eigen::Vector2d::Constant(1e30), upper = -lower;
  for (const Eigen::Vector3d &point : shown)
  {
    lower = lower.cwiseMin(Eigen::Vector2d(point.dot(right), point.dot(up)));
    upper = upper.cwiseMax(Eigen::Vector2d(point.dot(right), point.dot(up)));
  }
  const Eigen::Vector2d middle = 0.5 * (lower + upper), half = 0.5 * (upper - lower);
  // what the scale on the right and the legend at the bottom leave free
  const double free_width = has_scale_ ? 0.84 : 1.0, free_height = has_legend_ ? 0.93 : 1.0;

  vtkCamera *camera = renderer_->GetActiveCamera();
  camera->ParallelProjectionOn();
  const Eigen::Vector3d focus = middle[0] * right + middle[1] * up, position = focus + 500 * from;
  camera->SetFocalPoint(focus.data());
  camera->SetPosition(position.data());
  camera->SetViewUp(0, 0, 1);
  camera->SetParallelScale(1.05 * std::max(half[1] / free_height, half[0] * height / (free_width * width)));
  camera->SetWindowCenter(1 - free_width, free_height - 1);
  renderer_->ResetCameraClippingRange();

  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(0); // depth peeling and multisampling exclude each other
  window->SetAlphaBitPlanes(1);
  window->SetSize(width, height);
  renderer_->UseFXAAOn();
  window->AddRenderer(renderer_);
  window->Render();
  vtkNew<vtkWindowToImageFilter> image;
  image->SetInput(window);
  image->SetInputBufferTypeToRGB();
  image->ReadFrontBufferOff();
  vtkNew<vtkPNGWriter> writer;
  writer->SetFileName(file.c_str());
  writer->SetCompressionLevel(6);
  writer->SetInputConnection(image->GetOutputPort());
  writer->Write();
  if (writer->GetErrorCode() != 0 || !std::filesystem::exists(file))
    throw std::runtime_error("The picture " + file.string() + " cannot be written; is the disk full?");
}

vtkSmartPointer<vtkPolyData> right_of(vtkPolyData *surface, const dataset::Plane &plane)
{
  vtkNew<vtkPlane> function;
  function->SetOrigin(plane.origin.data());
  function->SetNormal(plane.normal.data());
  vtkNew<vtkClipPolyData> clip;
  clip->SetInputData(surface);
  clip->SetClipFunction(function);
  clip->InsideOutOn();
  clip->Update();
  return clip->GetOutput();
}
} // namespace pelvireg::report
