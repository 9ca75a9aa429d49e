#include "validation/report/gltf.h"

#include <Eigen/Geometry>
#include <nlohmann/json.hpp>

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <stdexcept>

namespace pelvireg::report
{
namespace
{
using json = nlohmann::ordered_json;
using Floats = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
static_assert(std::endian::native == std::endian::little, "glTF's buffers are little-endian");

// Names of numbers in the specification.
constexpr int float_component = 5126, unsigned_int_component = 5125, array_buffer = 34962, element_array_buffer = 34963;
constexpr std::uint32_t glb_magic = 0x46546C67, json_chunk = 0x4E4F534A, binary_chunk = 0x004E4942;

Eigen::RowVector3d turned(const Eigen::RowVector3d &lps)
{
  return {lps[0], lps[2], -lps[1]};
}

void set_row(Floats &values, Eigen::Index row, const Eigen::RowVector3d &vector)
{
  for (Eigen::Index k = 0; k < 3; ++k)
    values(row, k) = static_cast<float>(vector[k]);
}

/// Of one colour component (IEC 61966-2-1).
double linear(double srgb)
{
  return srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4);
}

void require_usable(const GltfMesh &mesh)
{
  const auto n = mesh.points.rows();
  const auto is_one_a_point = [&](std::size_t count) { return count == 0 || static_cast<Eigen::Index>(count) == n; };
  bool is_usable =
      mesh.points.allFinite() && is_one_a_point(mesh.point_colours.size()) && is_one_a_point(mesh.error.size());
  for (const double error : mesh.error)
    is_usable = is_usable && std::isfinite(error);
  for (const GltfPart &part : mesh.parts)
    is_usable = is_usable && !(part.has_point_colours && mesh.point_colours.empty()) &&
                (part.triangles.size() == 0 || (part.triangles.minCoeff() >= 0 && part.triangles.maxCoeff() < n));
  if (!is_usable)
    throw std::invalid_argument("glTF: mesh '" + mesh.name +
                                "' has an index out of range, a number that is not finite, or not one colour and error "
                                "a point");
}

/// Unit, by area; of a point without triangles along +Y.
Floats normals_of(const GltfMesh &mesh)
{
  dataset::Points sums = dataset::Points::Zero(mesh.points.rows(), 3);
  for (const GltfPart &part : mesh.parts)
    for (Eigen::Index t = 0; t < part.triangles.rows(); ++t)
    {
      const auto corner = [&](int k) { return Eigen::RowVector3d(mesh.points.row(part.triangles(t, k))); };
      const Eigen::RowVector3d area = (corner(1) - corner(0)).cross(corner(2) - corner(0));
      for (int k = 0; k < 3; ++k)
        sums.row(part.triangles(t, k)) += area;
    }
  Floats normals(mesh.points.rows(), 3);
  for (Eigen::Index i = 0; i < normals.rows(); ++i)
  {
    const double length = sums.row(i).norm();
    set_row(normals, i, length > 0 ? turned(sums.row(i) / length) : Eigen::RowVector3d(0, 1, 0));
  }
  return normals;
}

Floats positions_of(const GltfMesh &mesh)
{
  Floats positions(mesh.points.rows(), 3);
  for (Eigen::Index i = 0; i < positions.rows(); ++i)
    set_row(positions, i, turned(mesh.points.row(i)) / 1000);
  return positions;
}

Floats linear_colours(const std::vector<Colour> &colours)
{
  Floats values(static_cast<Eigen::Index>(colours.size()), 3);
  for (Eigen::Index i = 0; i < values.rows(); ++i)
    for (Eigen::Index k = 0; k < 3; ++k)
      values(i, k) = static_cast<float>(linear(colours[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)]));
  return values;
}

/// Collects arrays into one buffer with a view and an accessor each.
class Document
{
public:
  explicit Document(const GltfScene &scene)
  {
    root_["asset"] = {{"version", "2.0"}, {"generator", "pelvireg"}};
    for (const auto &[key, value] : scene.remarks)
      root_["asset"]["extras"][key] = value;
    root_["scene"] = 0;
    root_["scenes"] = json::array({json::object({{"name", scene.name}})});
    for (const GltfMesh &mesh : scene.meshes)
      add(mesh);
  }

  /// The container: a header of 12 bytes, then the two chunks, each with its length and type, filled up to four bytes.
  std::string bytes()
  {
    if (!buffer_.empty())
      root_["buffers"] = json::array({json::object({{"byteLength", buffer_.size()}})});
    std::string text = root_.dump(-1, ' ', false, json::error_handler_t::replace);
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const auto header = [](std::initializer_list<std::uint32_t> words)
    { return std::string(reinterpret_cast<const char *>(words.begin()), 4 * words.size()); };
    const std::size_t binary_size = buffer_.empty() ? 0 : 8 + buffer_.size();
    std::string file = header({glb_magic, 2, static_cast<std::uint32_t>(20 + text.size() + binary_size),
                               static_cast<std::uint32_t>(text.size()), json_chunk}) +
                       text;
    if (!buffer_.empty())
      file += header({static_cast<std::uint32_t>(buffer_.size()), binary_chunk}) + buffer_;
    return file;
  }

private:
  /// Every array is of four-byte numbers, so views stay aligned.
  int add_array(const void *data, std::size_t n_bytes, int target, json accessor)
  {
    root_["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", buffer_.size()}, {"byteLength", n_bytes}, {"target", target}});
    buffer_.append(static_cast<const char *>(data), n_bytes);
    accessor["bufferView"] = root_["bufferViews"].size() - 1;
    root_["accessors"].push_back(std::move(accessor));
    return static_cast<int>(root_["accessors"].size()) - 1;
  }

  int add_floats(const Floats &values, bool with_range = false)
  {
    json accessor = {
        {"componentType", float_component}, {"count", values.rows()}, {"type", values.cols() == 1 ? "SCALAR" : "VEC3"}};
    for (Eigen::Index k = 0; with_range && k < values.cols(); ++k)
    {
      accessor["min"].push_back(values.col(k).minCoeff());
      accessor["max"].push_back(values.col(k).maxCoeff());
    }
    return add_array(values.data(), sizeof(float) * static_cast<std::size_t>(values.size()), array_buffer, accessor);
  }

  int add_indices(const dataset::Triangles &triangles)
  {
    return add_array(triangles.data(), sizeof(std::int32_t) * static_cast<std::size_t>(triangles.size()),
                     element_array_buffer,
                     {{"componentType", unsigned_int_component}, {"count", triangles.size()}, {"type", "SCALAR"}});
  }

  int add_material(const GltfPart &part)
  {
    json colour = json::array();
    for (const double component : part.has_point_colours ? Colour{1, 1, 1} : part.colour)
      colour.push_back(linear(component));
    colour.push_back(part.opacity);
    json material = {
        {"pbrMetallicRoughness", {{"baseColorFactor", colour}, {"metallicFactor", 0}, {"roughnessFactor", 1}}},
        {"doubleSided", true}};
    if (part.opacity < 1)
      material["alphaMode"] = "BLEND";
    root_["materials"].push_back(std::move(material));
    return static_cast<int>(root_["materials"].size()) - 1;
  }

  void add(const GltfMesh &mesh)
  {
    require_usable(mesh);
    json primitives = json::array(), attributes;
    for (const GltfPart &part : mesh.parts)
    {
      if (part.triangles.rows() == 0)
        continue;
      if (attributes.is_null())
        attributes = {{"POSITION", add_floats(positions_of(mesh), true)}, {"NORMAL", add_floats(normals_of(mesh))}};
      json own = attributes;
      if (part.has_point_colours)
        own["COLOR_0"] = add_floats(linear_colours(mesh.point_colours));
      if (part.has_point_colours && !mesh.error.empty())
        own["_ERROR_MM"] = add_floats(
            Eigen::Map<const Eigen::VectorXd>(mesh.error.data(), static_cast<Eigen::Index>(mesh.error.size()))
                .cast<float>());
      primitives.push_back(
          {{"attributes", own}, {"indices", add_indices(part.triangles)}, {"material", add_material(part)}});
    }
    if (primitives.empty())
      return;
    root_["meshes"].push_back({{"name", mesh.name}, {"primitives", primitives}});
    const auto number = root_["meshes"].size() - 1;
    root_["nodes"].push_back({{"name", mesh.name}, {"mesh", number}});
    root_["scenes"][0]["nodes"].push_back(number);
  }

  json root_;
  std::string buffer_;
};
} // namespace

std::string glb(const GltfScene &scene)
{
  return Document(scene).bytes();
}
} // namespace pelvireg::report
