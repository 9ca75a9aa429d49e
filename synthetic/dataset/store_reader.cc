#include "synthetic/dataset/error.h"
#include "synthetic/dataset/store_handles.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pelvireg::dataset
{
namespace
{
// No file of ours comes near; a damaged header must not make us allocate the machine's memory.
constexpr std::int64_t max_elements = std::int64_t{1} << 31;
constexpr std::size_t max_text_length = 1 << 20;

std::string text_from(const char *data, std::size_t length)
{
  return {data, static_cast<std::size_t>(std::find(data, data + length, '\0') - data)};
}
} // namespace

Handle::Handle(Handle &&other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}

Handle &Handle::operator=(Handle &&other) noexcept
{
  reset();
  id_ = std::exchange(other.id_, -1);
  close_ = other.close_;
  return *this;
}

bool Handle::reset()
{
  const std::int64_t id = std::exchange(id_, -1);
  return id < 0 || close_(id) >= 0;
}

void GroupReader::refuse(const std::string &name, const std::string &problem) const
{
  throw InputError("'" + file_ + "': '" + path_ + name + "' " + problem + "; make the file again");
}

GroupReader GroupReader::group(const std::string &name) const
{
  const QuietErrors quiet;
  Handle handle(H5Gopen2(handle_.id(), name.c_str(), H5P_DEFAULT), H5Gclose);
  if (handle.id() < 0)
    refuse(name, "is missing");
  return {std::move(handle), file_, path_ + name + "/"};
}

bool GroupReader::has(const std::string &name) const
{
  const QuietErrors quiet;
  return H5Lexists(handle_.id(), name.c_str(), H5P_DEFAULT) > 0;
}

namespace
{
/// Reads a scalar attribute of exactly this type, or returns false.
bool read_scalar(std::int64_t group, const std::string &name, hid_t type, void *value)
{
  const QuietErrors quiet;
  const Handle attribute(H5Aopen(group, name.c_str(), H5P_DEFAULT), H5Aclose);
  if (attribute.id() < 0)
    return false;
  const Handle stored(H5Aget_type(attribute.id()), H5Tclose);
  const Handle space(H5Aget_space(attribute.id()), H5Sclose);
  return H5Tequal(stored.id(), type) > 0 && H5Sget_simple_extent_npoints(space.id()) == 1 &&
         H5Aread(attribute.id(), type, value) >= 0;
}
} // namespace

double GroupReader::number(const std::string &name) const
{
  double value = 0;
  if (!read_scalar(handle_.id(), name, H5T_NATIVE_DOUBLE, &value))
    refuse(name, "is not a number that can be read");
  if (!std::isfinite(value))
    refuse(name, "is not finite");
  return value;
}

std::int32_t GroupReader::integer(const std::string &name) const
{
  std::int32_t value = 0;
  if (!read_scalar(handle_.id(), name, H5T_NATIVE_INT32, &value))
    refuse(name, "is not an integer that can be read");
  return value;
}

std::string GroupReader::text(const std::string &name) const
{
  const QuietErrors quiet;
  const Handle attribute(H5Aopen(handle_.id(), name.c_str(), H5P_DEFAULT), H5Aclose);
  const Handle type(attribute.id() < 0 ? -1 : H5Aget_type(attribute.id()), H5Tclose);
  const Handle space(attribute.id() < 0 ? -1 : H5Aget_space(attribute.id()), H5Sclose);
  const bool is_text = type.id() >= 0 && H5Tget_class(type.id()) == H5T_STRING && H5Tis_variable_str(type.id()) == 0 &&
                       H5Tget_size(type.id()) <= max_text_length && H5Sget_simple_extent_npoints(space.id()) == 1;
  if (!is_text)
    refuse(name, "is not a text that can be read");
  std::vector<char> buffer(H5Tget_size(type.id()), '\0');
  if (H5Aread(attribute.id(), type.id(), buffer.data()) < 0)
    refuse(name, "cannot be read");
  return text_from(buffer.data(), buffer.size());
}

Handle GroupReader::open(const std::string &name) const
{
  const QuietErrors quiet;
  Handle dataset(H5Dopen2(handle_.id(), name.c_str(), H5P_DEFAULT), H5Dclose);
  if (dataset.id() < 0)
    refuse(name, "is missing");
  return dataset;
}

Extents GroupReader::extents_of(const Handle &dataset, const std::string &name, const Extents &expected) const
{
  const QuietErrors quiet;
  const Handle space(H5Dget_space(dataset.id()), H5Sclose);
  if (H5Sget_simple_extent_ndims(space.id()) != static_cast<int>(expected.size()))
    refuse(name, "has not " + std::to_string(expected.size()) + " dimension(s)");
  std::vector<hsize_t> dims(expected.size());
  H5Sget_simple_extent_dims(space.id(), dims.data(), nullptr);
  Extents extents;
  std::int64_t count = 1;
  for (std::size_t i = 0; i < dims.size(); ++i)
  {
    if (dims[i] > static_cast<hsize_t>(max_elements) || (count *= static_cast<std::int64_t>(dims[i])) > max_elements)
      refuse(name, "claims an impossible size");
    if (expected[i] >= 0 && dims[i] != static_cast<hsize_t>(expected[i]))
      refuse(name, "has extent " + std::to_string(dims[i]) + " in dimension " + std::to_string(i) + ", must be " +
                       std::to_string(expected[i]));
    extents.push_back(static_cast<std::int64_t>(dims[i]));
  }
  // Nothing is compressed: less storage than content means a truncated or forged dataset.
  const Handle type(H5Dget_type(dataset.id()), H5Tclose);
  if (H5Dget_storage_size(dataset.id()) < static_cast<hsize_t>(count) * H5Tget_size(type.id()))
    refuse(name, "is cut short");
  return extents;
}

namespace
{
bool read_values(const Handle &dataset, hid_t type, void *values)
{
  const QuietErrors quiet;
  const Handle stored(H5Dget_type(dataset.id()), H5Tclose);
  return H5Tequal(stored.id(), type) > 0 && H5Dread(dataset.id(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) >= 0;
}
} // namespace

void GroupReader::read(const Handle &dataset, const std::string &name, double *values, std::int64_t count) const
{
  if (count == 0)
    return;
  if (!read_values(dataset, H5T_NATIVE_DOUBLE, values))
    refuse(name, "is damaged or not of type float64");
  if (!std::all_of(values, values + count, [](double value) { return std::isfinite(value); }))
    refuse(name, "holds a value that is not finite");
}

void GroupReader::read(const Handle &dataset, const std::string &name, std::int32_t *values, std::int64_t count) const
{
  if (count > 0 && !read_values(dataset, H5T_NATIVE_INT32, values))
    refuse(name, "is damaged or not of type int32");
}

void GroupReader::require_rows(const std::string &name, std::int64_t got, std::int64_t expected) const
{
  if (got != expected)
    refuse(name, "has " + std::to_string(got) + " rows, must be " + std::to_string(expected));
}

void GroupReader::require_range(const std::string &name, const std::int32_t *values, std::int64_t count,
                                std::int64_t limit) const
{
  for (std::int64_t i = 0; i < count; ++i)
    if (values[i] < 0 || values[i] >= limit)
      refuse(name, "holds index " + std::to_string(values[i]) + ", allowed are 0 to " + std::to_string(limit - 1));
}

std::vector<Points> GroupReader::stack(const std::string &name, std::int64_t n_layers, std::int64_t n_rows) const
{
  const Handle dataset = open(name);
  // An empty stack has no rows to tell.
  const Extents extents = extents_of(dataset, name, {n_layers, n_layers == 0 ? -1 : n_rows, 3});
  std::vector<double> flat(static_cast<std::size_t>(count_of(extents)));
  read(dataset, name, flat.data(), count_of(extents));
  std::vector<Points> layers;
  for (std::int64_t i = 0; i < n_layers; ++i)
    layers.emplace_back(Eigen::Map<const Points>(flat.data() + i * n_rows * 3, n_rows, 3));
  return layers;
}

std::vector<std::string> GroupReader::texts(const std::string &name) const
{
  const Handle dataset = open(name);
  const std::int64_t count = extents_of(dataset, name, {-1})[0];
  const QuietErrors quiet;
  const Handle type(H5Dget_type(dataset.id()), H5Tclose);
  if (H5Tget_class(type.id()) != H5T_STRING || H5Tis_variable_str(type.id()) != 0 ||
      H5Tget_size(type.id()) > max_text_length)
    refuse(name, "is not a list of texts of fixed length");
  const std::size_t length = H5Tget_size(type.id());
  std::vector<char> flat(static_cast<std::size_t>(count) * length);
  if (count > 0 && H5Dread(dataset.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, flat.data()) < 0)
    refuse(name, "is damaged");
  std::vector<std::string> values;
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
    values.push_back(text_from(flat.data() + i * length, length));
  return values;
}

std::vector<double> GroupReader::numbers(const std::string &name, std::int64_t count) const
{
  const Eigen::VectorXd values = array<Eigen::VectorXd>(name, count);
  return {values.data(), values.data() + values.size()};
}

std::vector<std::int32_t> GroupReader::integers(const std::string &name, std::int64_t count) const
{
  const Integers values = array<Integers>(name, count);
  return {values.data(), values.data() + values.size()};
}

StoreReader::StoreReader(const std::filesystem::path &file, const std::string &format)
{
  const std::string name = file.string();
  if (!std::filesystem::is_regular_file(file))
    throw InputError("'" + name + "' does not exist; run the stage that makes it first");
  const QuietErrors quiet;
  file_ = Handle(H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  if (file_.id() < 0)
    throw InputError("'" + name + "' is not a readable HDF5 file (damaged or cut short); make it again");
  root_.emplace(GroupReader(Handle(H5Gopen2(file_.id(), "/", H5P_DEFAULT), H5Gclose), name, "/"));
  const auto require = [&](const char *attribute, const std::string &expected)
  {
    const std::string got = root_->text(attribute);
    if (got != expected)
      throw InputError("'" + name + "' has " + attribute + " '" + got + "', must be '" + expected +
                       "'; give a file that this version of pelvireg wrote");
  };
  require("format", format);
  require("format_version", store_format_version);
  require("units", store_units);
  require("frame", store_frame);
  if (root_->integer("complete") != 1)
    throw InputError("'" + name + "' is incomplete: its writer did not finish; make it again");
}
} // namespace pelvireg::dataset
