#include "validation/report/export_gltf.h"

#include "tests/unit/validation/export/example.h"
#include "validation/report/gltf.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <vtkCompositeDataIterator.h>
#include <vtkCompositeDataSet.h>
#include <vtkGLTFReader.h>
#include <vtkMassProperties.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkTriangleFilter.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <stdexcept>

namespace pelvireg::report
{
namespace
{
using namespace test;
namespace fs = std::filesystem;
using nlohmann::json;

std::string content(const fs::path &file)
{
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::uint32_t word(const std::string &bytes, std::size_t offset)
{
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

/// The two chunks of a .glb, read by the layout of the specification (section 4.4).
struct Glb
{
  json root;
  std::string buffer;

  explicit Glb(const std::string &bytes)
  {
    EXPECT_EQ(bytes.substr(0, 4), "glTF");
    EXPECT_EQ(word(bytes, 4), 2u);
    EXPECT_EQ(word(bytes, 8), bytes.size());
    const std::size_t json_size = word(bytes, 12);
    EXPECT_EQ(json_size % 4, 0u);
    EXPECT_EQ(bytes.substr(16, 4), "JSON");
    root = json::parse(bytes.substr(20, json_size));
    const std::size_t second = 20 + json_size;
    EXPECT_EQ(word(bytes, second) % 4, 0u);
    EXPECT_EQ(bytes.substr(second + 4, 4), std::string("BIN\0", 4));
    buffer = bytes.substr(second + 8);
    EXPECT_EQ(word(bytes, second), buffer.size());
  }

  /// The numbers of an accessor, component by component.
  template <class Number> std::vector<Number> numbers(std::size_t accessor) const
  {
    const json &given = root.at("accessors").at(accessor);
    const json &view = root.at("bufferViews").at(given.at("bufferView").get<std::size_t>());
    const std::size_t n_components = given.at("type") == "VEC3" ? 3 : 1;
    std::vector<Number> values(given.at("count").get<std::size_t>() * n_components);
    EXPECT_EQ(values.size() * sizeof(Number), view.at("byteLength").get<std::size_t>());
    std::memcpy(values.data(), buffer.data() + view.at("byteOffset").get<std::size_t>(),
                values.size() * sizeof(Number));
    return values;
  }

  const json &primitive(const std::string &mesh, std::size_t number = 0) const
  {
    for (const json &entry : root.at("meshes"))
      if (entry.at("name") == mesh)
        return entry.at("primitives").at(number);
    throw std::runtime_error("no mesh " + mesh);
  }
};

GltfScene one_octahedron()
{
  const SurfaceMesh mesh = octahedron(1);
  GltfMesh body{.name = "body", .points = mesh.points, .point_colours = {}, .error = {}, .parts = {}};
  for (int i = 0; i < 6; ++i)
  {
    body.error.push_back(0.5 * i);
    body.point_colours.push_back(viridis_at(i / 5.0));
  }
  body.parts = {{.triangles = mesh.triangles.topRows(6), .has_point_colours = true},
                {.triangles = mesh.triangles.bottomRows(2), .colour = {1, 0.5, 0}, .opacity = 0.25}};
  return {.name = "scene", .remarks = {{"case", "a \"quoted\"\n case"}}, .meshes = {body}};
}

TEST(Glb, EveryViewIsAlignedAndInsideTheBufferAndEveryIndexIsOfAPoint)
{
  const Glb file(glb(one_octahedron()));
  EXPECT_EQ(file.root.at("asset").at("version"), "2.0");
  EXPECT_EQ(file.root.at("asset").at("extras").at("case"), "a \"quoted\"\n case");
  EXPECT_EQ(file.root.at("buffers").at(0).at("byteLength"), file.buffer.size());
  for (const json &view : file.root.at("bufferViews"))
  {
    EXPECT_EQ(view.at("byteOffset").get<std::size_t>() % 4, 0u);
    EXPECT_LE(view.at("byteOffset").get<std::size_t>() + view.at("byteLength").get<std::size_t>(), file.buffer.size());
  }
  for (const std::size_t part : {0u, 1u})
    for (const std::uint32_t index : file.numbers<std::uint32_t>(file.primitive("body", part).at("indices")))
      EXPECT_LT(index, 6u);
}

TEST(Glb, IsInMetresWithYUpAndTheFaceTowardsZAndStatesTheRangeOfItsPositions)
{
  const Glb file(glb(one_octahedron()));
  const std::size_t accessor = file.primitive("body").at("attributes").at("POSITION");
  const auto positions = file.numbers<float>(accessor);
  const Points lps = octahedron(1).points;
  for (int i = 0; i < 6; ++i)
  {
    EXPECT_FLOAT_EQ(positions[3 * i], static_cast<float>(lps(i, 0) / 1000)) << "left stays x";
    EXPECT_FLOAT_EQ(positions[3 * i + 1], static_cast<float>(lps(i, 2) / 1000)) << "superior is up";
    EXPECT_FLOAT_EQ(positions[3 * i + 2], static_cast<float>(-lps(i, 1) / 1000)) << "anterior is forward";
  }
  const json &given = file.root.at("accessors").at(accessor);
  EXPECT_EQ(given.at("min").get<std::vector<float>>(), (std::vector<float>{-0.02f, -0.02f, -0.07f}));
  EXPECT_EQ(given.at("max").get<std::vector<float>>(), (std::vector<float>{0.02f, 0.02f, -0.03f}));
}

TEST(Glb, NormalsAreUnitAndPointOutward)
{
  const Glb file(glb(one_octahedron()));
  const auto normals = file.numbers<float>(file.primitive("body").at("attributes").at("NORMAL"));
  const auto positions = file.numbers<float>(file.primitive("body").at("attributes").at("POSITION"));
  for (std::size_t i = 0; i < 6; ++i)
  {
    const Eigen::Vector3f normal(normals[3 * i], normals[3 * i + 1], normals[3 * i + 2]);
    const Eigen::Vector3f out(positions[3 * i], positions[3 * i + 1], positions[3 * i + 2] + 0.05f);
    EXPECT_NEAR(normal.norm(), 1, 1e-6);
    EXPECT_NEAR(normal.dot(out.normalized()), 1, 1e-6);
  }
}

TEST(Glb, ColoursAreLinearAndTheErrorIsKept)
{
  const Glb file(glb(one_octahedron()));
  const json &attributes = file.primitive("body").at("attributes");
  const auto colours = file.numbers<float>(attributes.at("COLOR_0"));
  // IEC 61966-2-1: ((0.267 + 0.055) / 1.055)^2.4 = 0.057949 and 0.005 / 12.92.
  EXPECT_NEAR(colours[0], 0.057949, 1e-6);
  EXPECT_NEAR(colours[1], 0.005 / 12.92, 1e-7);
  EXPECT_EQ(file.numbers<float>(attributes.at("_ERROR_MM")), (std::vector<float>{0, 0.5, 1, 1.5, 2, 2.5}));
  const json &plain = file.root.at("materials").at(file.primitive("body", 1).at("material").get<std::size_t>());
  EXPECT_EQ(plain.at("alphaMode"), "BLEND");
  EXPECT_EQ(plain.at("pbrMetallicRoughness").at("baseColorFactor").at(3), 0.25);
  EXPECT_NEAR(plain.at("pbrMetallicRoughness").at("baseColorFactor").at(1), 0.21404, 1e-5) << "of 0.5";
  EXPECT_FALSE(file.primitive("body", 1).at("attributes").contains("COLOR_0"));
}

TEST(Glb, RefusesWhatNoViewerCanDraw)
{
  const auto expect_refusal = [](const std::function<void(GltfMesh &)> &break_mesh)
  {
    GltfScene scene = one_octahedron();
    break_mesh(scene.meshes[0]);
    EXPECT_THROW(glb(scene), std::invalid_argument);
  };
  expect_refusal([](GltfMesh &mesh) { mesh.points(3, 1) = std::nan(""); });
  expect_refusal([](GltfMesh &mesh) { mesh.error[2] = std::numeric_limits<double>::infinity(); });
  expect_refusal([](GltfMesh &mesh) { mesh.error.pop_back(); });
  expect_refusal([](GltfMesh &mesh) { mesh.point_colours.clear(); });
  expect_refusal([](GltfMesh &mesh) { mesh.parts[1].triangles(0, 0) = 6; });
  expect_refusal([](GltfMesh &mesh) { mesh.parts[1].triangles(0, 0) = -1; });
}

TEST(Glb, OfNothingIsAFileWithoutBuffer)
{
  const std::string bytes = glb({.name = "nothing", .remarks = {}, .meshes = {}});
  EXPECT_EQ(word(bytes, 8), bytes.size());
  const json root = json::parse(bytes.substr(20));
  EXPECT_FALSE(root.contains("buffers"));
  EXPECT_FALSE(root.at("scenes").at(0).contains("nodes")) << "an empty list is not allowed";
}

TEST(ColourMap, RunsThroughItsAnchorsAndKeepsItsEnds)
{
  EXPECT_EQ(viridis_at(0), viridis[0]);
  EXPECT_EQ(viridis_at(-1), viridis[0]);
  EXPECT_EQ(viridis_at(7), viridis[5]);
  EXPECT_NEAR(viridis_at(0.3)[0], (viridis[1][0] + viridis[2][0]) / 2, 1e-15);
}

class ExportGltf : public ::testing::Test
{
protected:
  void SetUp() override
  {
    folder_ = fresh_folder(::testing::UnitTest::GetInstance()->current_test_info()->name());
    export_gltf(example_anatomy(), example_truth(), {example_estimate()}, folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path folder_;
};

TEST_F(ExportGltf, NamesItsMeshesByOrganAndHoldsTheLastStepOfTheNominalRun)
{
  const Glb file(content(folder_ / "full.glb"));
  std::vector<std::string> names;
  for (const json &node : file.root.at("nodes"))
    names.push_back(node.at("name"));
  EXPECT_EQ(names, (std::vector<std::string>{"bladder", "vagina", "uterus", "rectum", "image_plane"}));
  // The last step of the bladder: rest (20, 0, 0), the truth's (0, 2, -6), and 2 mm to the left.
  const auto positions = file.numbers<float>(file.primitive("bladder").at("attributes").at("POSITION"));
  EXPECT_FLOAT_EQ(positions[0], 0.022f);
  EXPECT_FLOAT_EQ(positions[1], -0.006f);
  EXPECT_FLOAT_EQ(positions[2], -0.002f);
  const auto error = file.numbers<float>(file.primitive("bladder").at("attributes").at("_ERROR_MM"));
  EXPECT_NEAR(error[0], 2, 1e-6);
  EXPECT_NEAR(error[1], 2 / std::sqrt(3), 1e-6);
}

TEST_F(ExportGltf, IsReadByVtkWithTheSamePointsAndAnEnclosedVolume)
{
  for (const char *name : {"full.glb", "truth.glb"})
  {
    vtkNew<vtkGLTFReader> reader;
    reader->SetFileName((folder_ / name).c_str());
    reader->Update();
    vtkMultiBlockDataSet *blocks = reader->GetOutput();
    ASSERT_NE(blocks, nullptr);
    int n_closed = 0;
    const auto iterator = vtkSmartPointer<vtkCompositeDataIterator>::Take(blocks->NewIterator());
    for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
    {
      auto *surface = vtkPolyData::SafeDownCast(iterator->GetCurrentDataObject());
      ASSERT_NE(surface, nullptr);
      if (surface->GetNumberOfPolys() != 8)
        continue; // the image plane
      ++n_closed;
      vtkNew<vtkTriangleFilter> triangles;
      triangles->SetInputData(surface);
      vtkNew<vtkMassProperties> mass;
      mass->SetInputConnection(triangles->GetOutputPort());
      EXPECT_NEAR(mass->GetVolume(), 4.0 / 3 * 8e-6, 1e-10) << "m^3, of an octahedron of radius 20 mm";
    }
    EXPECT_EQ(n_closed, std::string(name) == "full.glb" ? 4 : 5) << name;
  }
}

TEST_F(ExportGltf, CapsAreGreyAndHaveNoError)
{
  Estimate estimate = example_estimate();
  for (EstimateSurface &surface : estimate.samples[0].surfaces)
    surface.rest.region[7] = static_cast<std::int32_t>(SurfaceRegion::cap);
  export_gltf(example_anatomy(), example_truth(), {estimate}, folder_);
  const Glb file(content(folder_ / "full.glb"));
  EXPECT_EQ(file.root.at("accessors").at(file.primitive("uterus").at("indices").get<std::size_t>()).at("count"), 21);
  const json &cap = file.primitive("uterus", 1);
  EXPECT_EQ(file.root.at("accessors").at(cap.at("indices").get<std::size_t>()).at("count"), 3);
  EXPECT_FALSE(cap.at("attributes").contains("_ERROR_MM"));
}

TEST_F(ExportGltf, SameInputGivesTheSameBytes)
{
  const std::string before = content(folder_ / "full.glb");
  export_gltf(example_anatomy(), example_truth(), {example_estimate()}, folder_);
  EXPECT_EQ(content(folder_ / "full.glb"), before);
}
} // namespace
} // namespace pelvireg::report
