#include "tests/unit/validation/export/example.h"
#include "validation/report/export_vtk.h"

#include <gtest/gtest.h>

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <fstream>
#include <map>
#include <regex>
#include <sstream>

namespace pelvireg::report
{
namespace
{
using namespace test;
namespace fs = std::filesystem;

std::string content(const fs::path &file)
{
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

std::map<std::string, std::string> all_files(const fs::path &folder)
{
  std::map<std::string, std::string> files;
  for (const auto &entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file())
      files[fs::relative(entry.path(), folder)] = content(entry.path());
  return files;
}

vtkSmartPointer<vtkPolyData> read(const fs::path &file)
{
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  return reader->GetOutput();
}

std::string field_text(vtkDataSet *data, const char *name)
{
  auto *array = vtkStringArray::SafeDownCast(data->GetFieldData()->GetAbstractArray(name));
  return array ? array->GetValue(0) : std::string();
}

class ExportVtk : public ::testing::Test
{
protected:
  void SetUp() override
  {
    folder_ = fresh_folder(::testing::UnitTest::GetInstance()->current_test_info()->name());
    export_vtk(example_anatomy(), example_truth(), example_observations(), {example_estimate()}, folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path folder_;
};

TEST_F(ExportVtk, truth_is_deformed_and_carries_its_displacement)
{
  const auto data = read(folder_ / "truth" / "uterus_02.vtp");
  ASSERT_EQ(data->GetNumberOfPoints(), 6);
  ASSERT_EQ(data->GetNumberOfPolys(), 8);
  vtkDataArray *displacement = data->GetPointData()->GetArray("displacement");
  ASSERT_NE(displacement, nullptr);
  ASSERT_EQ(displacement->GetNumberOfComponents(), 3); // ParaView's Warp By Vector wants three
  EXPECT_EQ(displacement->GetComponent(3, 2), -6);
  EXPECT_EQ(data->GetPoint(4)[1], 100 + 2);
  EXPECT_EQ(data->GetPoint(4)[2], 20 - 6);
  EXPECT_EQ(data->GetCellData()->GetArray("organ")->GetComponent(0, 0), 2);
  EXPECT_NE(data->GetCellData()->GetArray("region"), nullptr);
}

TEST_F(ExportVtk, increment_0_is_rest)
{
  const auto data = read(folder_ / "truth" / "bladder_00.vtp");
  EXPECT_EQ(data->GetPoint(4)[2], 20);
  EXPECT_EQ(data->GetPointData()->GetArray("displacement")->GetMaxNorm(), 0);
}

TEST_F(ExportVtk, every_data_file_states_unit_and_frame)
{
  int n = 0;
  for (const auto &entry : fs::recursive_directory_iterator(folder_))
    if (entry.path().extension() == ".vtp")
    {
      const auto data = read(entry.path());
      EXPECT_EQ(field_text(data, "units"), "mm") << entry.path();
      EXPECT_EQ(field_text(data, "SPACE"), "LPS") << entry.path();
      EXPECT_GT(data->GetNumberOfPoints(), 0) << entry.path();
      ++n;
    }
  EXPECT_EQ(n, 3 * 6 + 4 * 6 + 3 * 8 + 3 * 4); // truth and bars, estimate, contours and control points, slices
}

TEST_F(ExportVtk, error_is_the_distance_to_the_truth_of_that_step)
{
  const auto right = read(folder_ / "full" / "bladder_05.vtp");
  EXPECT_LT(right->GetPointData()->GetArray("error_mm")->GetRange()[1], 1e-12);
  const auto shifted = read(folder_ / "full" / "bladder_06.vtp");
  // the tip at +x leaves the octahedron by the whole shift; the one at -x goes in, 2/sqrt(3) from the nearest faces
  EXPECT_NEAR(shifted->GetPointData()->GetArray("error_mm")->GetComponent(0, 0), 2, 1e-12);
  EXPECT_NEAR(shifted->GetPointData()->GetArray("error_mm")->GetComponent(1, 0), 2 / std::sqrt(3), 1e-12);
}

TEST_F(ExportVtk, bars_carry_stretch_and_group)
{
  const auto data = read(folder_ / "truth" / "bars_02.vtp");
  ASSERT_EQ(data->GetNumberOfLines(), 1);
  EXPECT_DOUBLE_EQ(data->GetCellData()->GetArray("stretch")->GetComponent(0, 0), 1.5);
  auto *group = vtkStringArray::SafeDownCast(data->GetCellData()->GetAbstractArray("group"));
  ASSERT_NE(group, nullptr);
  EXPECT_EQ(group->GetValue(0), "cardinal_left");
}

TEST_F(ExportVtk, outlines_are_closed_lines)
{
  const auto data = read(folder_ / "contours" / "vagina_01.vtp");
  EXPECT_EQ(data->GetNumberOfLines(), 4);
  EXPECT_EQ(data->GetNumberOfPoints(), 4);
}

TEST_F(ExportVtk, supports_are_hexahedra_with_their_fixed_nodes)
{
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName((folder_ / "supports" / "ligaments.vtu").c_str());
  reader->Update();
  vtkUnstructuredGrid *grid = reader->GetOutput();
  ASSERT_EQ(grid->GetNumberOfCells(), 1);
  EXPECT_EQ(grid->GetCellType(0), VTK_HEXAHEDRON);
  double sum = 0;
  for (vtkIdType i = 0; i < 8; ++i)
    sum += grid->GetPointData()->GetArray("fixed")->GetComponent(i, 0);
  EXPECT_EQ(sum, 2);
  EXPECT_EQ(field_text(grid, "units"), "mm");
}

TEST_F(ExportVtk, collections_name_existing_files_and_the_time_is_the_increment)
{
  for (const char *name : {"truth.pvd", "full.pvd", "contours.pvd", "slices.pvd"})
  {
    const std::string text = content(folder_ / name);
    const std::regex entry("timestep=\"([^\"]+)\" [^>]*file=\"([^\"]+)\"");
    int n = 0;
    for (std::sregex_iterator match(text.begin(), text.end(), entry), end; match != end; ++match, ++n)
      EXPECT_TRUE(fs::exists(folder_ / match->str(2))) << match->str(2);
    EXPECT_GT(n, 0) << name;
  }
  const std::string full = content(folder_ / "full.pvd");
  EXPECT_NE(full.find("timestep=\"2\" group=\"\" part=\"5\" file=\"full/bladder_06.vtp\""), std::string::npos);
}

TEST_F(ExportVtk, same_input_gives_the_same_bytes)
{
  const fs::path again = fresh_folder("export_again");
  export_vtk(example_anatomy(), example_truth(), example_observations(), {example_estimate()}, again);
  EXPECT_EQ(all_files(folder_), all_files(again));
  fs::remove_all(again);
}
} // namespace
} // namespace pelvireg::report
