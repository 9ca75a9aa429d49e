#include "validation/report/export_vtk.h"

#include "validation/report/surface_error.h"
#include "validation/report/vtk_data.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkStringArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace pelvireg::report
{
namespace
{
using namespace dataset;
namespace fs = std::filesystem;

constexpr const char *part_names[] = {"bladder", "vagina", "uterus", "rectum", "pelvic_floor"};

void add_text(vtkDataSet *data, const char *name, const std::string &value)
{
  vtkNew<vtkStringArray> array;
  array->SetName(name);
  array->InsertNextValue(value);
  data->GetFieldData()->AddArray(array);
}

/// Cell array "organ": index in organ_names, 4 for the pelvic floor.
void add_organ(vtkDataSet *data, const std::string &name)
{
  const auto found = std::find(std::begin(part_names), std::end(part_names), name);
  vtkNew<vtkIntArray> array;
  array->SetName("organ");
  array->SetNumberOfTuples(data->GetNumberOfCells());
  array->FillValue(static_cast<int>(found - std::begin(part_names)));
  data->GetCellData()->AddArray(array);
  add_text(data, "organ_name", name);
}

template <class Writer> void write(vtkDataSet *data, const fs::path &file)
{
  add_text(data, "units", "mm");
  add_text(data, "SPACE", "LPS");
  vtkNew<Writer> writer;
  writer->SetFileName(file.c_str());
  writer->SetInputData(data);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetCompressorTypeToZLib();
  if (writer->Write() != 1)
    throw std::runtime_error("The file " + file.string() + " cannot be written; is the disk full?");
}

/// Collects the pieces of a time series.
class Collection
{
public:
  Collection(fs::path folder, std::string name) : folder_(std::move(folder)), name_(std::move(name))
  {
    fs::create_directories(folder_ / name_);
  }

  /// Where the piece goes; `file` is its name without folder.
  fs::path add(double time, const std::string &file)
  {
    entries_ << "    <DataSet timestep=\"" << time << "\" group=\"\" part=\"" << n_++ << "\" file=\"" << name_ << '/'
             << file << "\"/>\n";
    return folder_ / name_ / file;
  }

  void save() const
  {
    std::ofstream stream(folder_ / (name_ + ".pvd"));
    stream << "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n  <Collection>\n"
           << entries_.str() << "  </Collection>\n</VTKFile>\n";
    stream.close();
    if (!stream)
      throw std::runtime_error("The file " + (folder_ / (name_ + ".pvd")).string() + " cannot be written.");
  }

private:
  fs::path folder_;
  std::string name_;
  std::ostringstream entries_;
  int n_ = 0;
};

std::string numbered(const std::string &name, int number, const char *extension)
{
  std::ostringstream text;
  text << name << '_' << (number < 0 ? "m" : "") << (std::abs(number) < 10 ? "0" : "") << std::abs(number) << extension;
  return text.str();
}

void write_surface(const std::string &name, const SurfaceMesh &rest, const Points &displacement, const fs::path &file,
                   const std::vector<double> &error = {})
{
  const auto data = to_vtk(rest.points + displacement, rest.triangles, rest.region);
  add_point_array(data, "displacement", displacement);
  if (!error.empty())
    add_point_array(data, "error_mm", Eigen::Map<const Eigen::VectorXd>(error.data(), error.size()));
  add_organ(data, name);
  write<vtkXMLPolyDataWriter>(data, file);
}

void write_bars(const Truth &truth, std::size_t increment, const fs::path &file)
{
  std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> bars;
  vtkNew<vtkDoubleArray> stretch;
  stretch->SetName("stretch");
  vtkNew<vtkStringArray> group;
  group->SetName("group");
  for (const TruthTruss &truss : truth.trusses)
  {
    const Points &ends = increment == 0 ? truss.rest : truss.positions.at(increment - 1);
    bars.emplace_back(ends.row(0), ends.row(1));
    stretch->InsertNextValue((ends.row(1) - ends.row(0)).norm() / (truss.rest.row(1) - truss.rest.row(0)).norm());
    group->InsertNextValue(truss.group);
  }
  const auto data = to_vtk(bars);
  data->GetCellData()->AddArray(stretch);
  data->GetCellData()->AddArray(group);
  write<vtkXMLPolyDataWriter>(data, file);
}

void export_truth(const Truth &truth, const fs::path &folder)
{
  Collection collection(folder, "truth");
  for (std::size_t k = 0; k <= truth.increments.size(); ++k)
  {
    const int number = static_cast<int>(k);
    for (const TruthSurface &surface : truth.surfaces)
      write_surface(surface.name, surface.rest, displacement_of(surface, k),
                    collection.add(number, numbered(surface.name, number, ".vtp")));
    write_bars(truth, k, collection.add(number, numbered("bars", number, ".vtp")));
  }
  collection.save();
}

void export_estimate(const Anatomy &anatomy, const Truth &truth, const Estimate &estimate, const fs::path &folder)
{
  if (estimate.samples.empty())
    return;
  const std::size_t per_increment = static_cast<std::size_t>(anatomy.registration_steps_per_increment);
  Collection collection(folder, estimate.label());
  for (const EstimateSurface &surface : estimate.samples.front().surfaces)
    for (std::size_t step = 1; step <= surface.positions.size(); ++step)
    {
      const Points &positions = surface.positions[step - 1];
      const std::size_t increment = (step + per_increment - 1) / per_increment;
      const fs::path file = collection.add(static_cast<double>(step) / static_cast<double>(per_increment),
                                           numbered(surface.name, static_cast<int>(step), ".vtp"));
      write_surface(surface.name, surface.rest, positions - surface.rest.points, file,
                    distances_to_truth(truth, surface.name, increment, positions));
    }
  collection.save();
}

void write_outlines(const std::vector<OrganOutline> &outlines, int number, Collection &collection)
{
  for (const OrganOutline &outline : outlines)
  {
    if (outline.contours.empty())
      continue;
    const auto data = to_vtk(outline.contours);
    add_organ(data, outline.organ);
    write<vtkXMLPolyDataWriter>(data, collection.add(number, numbered(outline.organ, number, ".vtp")));
  }
}

void write_control_points(const DynamicFrame &frame, Collection &collection)
{
  for (std::size_t organ = 0; organ < frame.control_points.size(); ++organ)
  {
    const Points &points = frame.control_points[organ];
    if (points.rows() == 0)
      continue;
    vtkNew<vtkPolyData> data;
    data->SetPoints(to_vtk(points));
    vtkNew<vtkCellArray> vertices;
    for (Eigen::Index i = 0; i < points.rows(); ++i)
      vertices->InsertNextCell({i});
    data->SetVerts(vertices);
    add_point_array(data, "normal", frame.control_point_normals[organ]);
    const std::string name = frame.outlines[organ].organ;
    add_organ(data, name);
    write<vtkXMLPolyDataWriter>(
        data, collection.add(frame.increment, numbered(name + "_control_points", frame.increment, ".vtp")));
  }
}

void export_observations(const Observations &observations, const fs::path &folder)
{
  Collection contours(folder, "contours"), slices(folder, "slices");
  std::vector<DynamicFrame> frames = {observations.rest};
  frames.insert(frames.end(), observations.frames.begin(), observations.frames.end());
  for (const DynamicFrame &frame : frames)
  {
    write_outlines(frame.outlines, frame.increment, contours);
    write_control_points(frame, contours);
  }
  for (const ValidationSlice &slice : observations.slices)
    write_outlines(slice.outlines, slice.index, slices);
  contours.save();
  slices.save();
}

/// Bodies of hexahedra: ligaments and fasciae.
void export_supports(const RegistrationModel &model, const fs::path &folder)
{
  for (const RegistrationBody &body : model.bodies)
  {
    if (body.hexes.rows() == 0)
      continue;
    vtkNew<vtkUnstructuredGrid> grid;
    grid->SetPoints(to_vtk(body.points));
    for (Eigen::Index h = 0; h < body.hexes.rows(); ++h)
    {
      vtkIdType nodes[8];
      for (int i = 0; i < 8; ++i)
        nodes[i] = body.hexes(h, i);
      grid->InsertNextCell(VTK_HEXAHEDRON, 8, nodes);
    }
    Eigen::VectorXd fixed = Eigen::VectorXd::Zero(body.points.rows());
    for (const std::int32_t node : body.fixed_nodes)
      fixed[node] = 1;
    add_point_array(grid, "fixed", fixed);
    add_text(grid, "body_name", body.name);
    write<vtkXMLUnstructuredGridWriter>(grid, folder / "supports" / (body.name + ".vtu"));
  }
}
} // namespace

void export_vtk(const Anatomy &anatomy, const Truth &truth, const Observations &observations,
                const std::vector<Estimate> &estimates, const fs::path &folder)
{
  fs::create_directories(folder / "supports");
  export_supports(anatomy.registration, folder);
  export_truth(truth, folder);
  export_observations(observations, folder);
  for (const Estimate &estimate : estimates)
    export_estimate(anatomy, truth, estimate, folder);
}
} // namespace pelvireg::report
