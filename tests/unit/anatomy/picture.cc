// Draws what `anatomy_look` wrote: picture DIR PNG KIND(ref|reg) VIEW(left|front|oblique|top) [cut]. Run it under
// xvfb-run -a.
#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkClipPolyData.h>
#include <vtkNew.h>
#include <vtkPlane.h>
#include <vtkPNGWriter.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataReader.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkRenderWindow.h>
#include <vtkWindowToImageFilter.h>

#include <array>
#include <fstream>
#include <map>
#include <string>

namespace
{
void add(vtkRenderer *renderer, const std::string &file, double r, double g, double b, bool cut, bool edges)
{
  if (!std::ifstream(file))
    return;
  vtkNew<vtkPolyDataReader> reader;
  reader->SetFileName(file.c_str());
  vtkNew<vtkPlane> plane;
  plane->SetOrigin(0, 0, 0);
  plane->SetNormal(-1, 0, 0);
  vtkNew<vtkClipPolyData> clip;
  clip->SetInputConnection(reader->GetOutputPort());
  clip->SetClipFunction(plane);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(cut ? clip->GetOutputPort() : reader->GetOutputPort());
  mapper->ScalarVisibilityOff();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(r, g, b);
  actor->GetProperty()->SetEdgeVisibility(edges);
  actor->GetProperty()->SetLineWidth(edges ? 1 : 2);
  renderer->AddActor(actor);
}
} // namespace

int main(int argc, char **argv)
{
  if (argc < 5)
    return 2;
  const std::string directory = argv[1], png = argv[2], kind = argv[3], view = argv[4];
  const bool cut = argc > 5;
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(1, 1, 1);
  add(renderer, directory + "/" + kind + "_bladder.vtk", 0.95, 0.8, 0.3, cut, true);
  add(renderer, directory + "/" + kind + "_vagina.vtk", 0.9, 0.5, 0.6, cut, true);
  add(renderer, directory + "/" + kind + "_uterus.vtk", 0.75, 0.3, 0.35, cut, true);
  add(renderer, directory + "/" + kind + "_rectum.vtk", 0.6, 0.45, 0.3, cut, true);
  if (kind == "ref")
    add(renderer, directory + "/ref_pelvic_floor.vtk", 0.4, 0.6, 0.8, cut, true);
  add(renderer, directory + (kind == "ref" ? "/bars.vtk" : "/bands.vtk"), 0.1, 0.4, 0.1, cut, false);
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetSize(1100, 900);
  window->AddRenderer(renderer);
  vtkCamera *camera = renderer->GetActiveCamera();
  const std::map<std::string, std::array<double, 3>> eyes = {{"left", {1, 0, 0}},      {"right", {-1, 0, 0}},
                                                             {"front", {0, -1, 0.15}}, {"oblique", {0.8, -0.8, 0.6}},
                                                             {"top", {0, -0.3, 1}},    {"below", {0.3, -0.5, -1}}};
  const auto eye = eyes.at(view);
  camera->SetFocalPoint(0, 35, 40);
  camera->SetPosition(600 * eye[0], 35 + 600 * eye[1], 40 + 600 * eye[2]);
  camera->SetViewUp(0, 0, 1);
  camera->ParallelProjectionOn();
  camera->SetParallelScale(85);
  renderer->ResetCameraClippingRange();
  window->Render();
  vtkNew<vtkWindowToImageFilter> grab;
  grab->SetInput(window);
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(grab->GetOutputPort());
  writer->SetFileName(png.c_str());
  writer->Write();
  return 0;
}
