#include "synthetic/dataset/error.h"
#include "synthetic/dataset/store_handles.h"

#include <algorithm>
#include <cmath>

namespace pelvireg::dataset
{
namespace
{
// A chunk carries one checksum: large enough to be cheap, small enough to be read in pieces.
constexpr std::int64_t max_chunk_bytes = 4 << 20;

Handle checked(hid_t id, Handle::Close close, const std::string &location)
{
  if (id < 0)
    throw std::runtime_error("cannot write '" + location + "' to the HDF5 file: HDF5 refused it");
  return {id, close};
}

void require_name(const std::string &name, const std::string &location)
{
  if (name.empty() || name == "." || name == ".." || name.find('/') != std::string::npos)
    throw ComputationError("cannot store '" + location + "': a name must not be empty or hold a '/'");
}

Handle text_type(std::size_t length, const std::string &location)
{
  Handle type = checked(H5Tcopy(H5T_C_S1), H5Tclose, location);
  H5Tset_size(type.id(), std::max<std::size_t>(length, 1));
  H5Tset_strpad(type.id(), H5T_STR_NULLPAD);
  H5Tset_cset(type.id(), H5T_CSET_UTF8);
  return type;
}

/// Whole rows of the first extent until a chunk is full.
std::vector<hsize_t> chunk_of(const Extents &extents, std::size_t element_size)
{
  std::vector<hsize_t> chunk(extents.begin(), extents.end());
  const std::int64_t row_bytes = count_of(extents) / extents[0] * static_cast<std::int64_t>(element_size);
  chunk[0] = static_cast<hsize_t>(std::clamp<std::int64_t>(max_chunk_bytes / row_bytes, 1, extents[0]));
  return chunk;
}

Handle creation_properties(const Extents &extents, std::size_t element_size, const std::string &location)
{
  Handle properties = checked(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, location);
  H5Pset_obj_track_times(properties.id(), false);
  H5Pset_fill_time(properties.id(), H5D_FILL_TIME_NEVER);
  if (count_of(extents) > 0)
  {
    const std::vector<hsize_t> chunk = chunk_of(extents, element_size);
    H5Pset_chunk(properties.id(), static_cast<int>(chunk.size()), chunk.data());
    H5Pset_fletcher32(properties.id());
  }
  return properties;
}

void write_dataset(const Handle &group, const std::string &name, const std::string &location, hid_t type,
                   const void *values, const Extents &extents)
{
  const QuietErrors quiet;
  const std::vector<hsize_t> dims(extents.begin(), extents.end());
  const Handle space =
      checked(H5Screate_simple(static_cast<int>(dims.size()), dims.data(), nullptr), H5Sclose, location);
  const Handle properties = creation_properties(extents, H5Tget_size(type), location);
  const Handle dataset =
      checked(H5Dcreate2(group.id(), name.c_str(), type, space.id(), H5P_DEFAULT, properties.id(), H5P_DEFAULT),
              H5Dclose, location);
  if (count_of(extents) > 0 && H5Dwrite(dataset.id(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0)
    throw std::runtime_error("cannot write '" + location + "' to the HDF5 file: is the disk full?");
}

void write_attribute(const Handle &group, const std::string &name, const std::string &location, hid_t type,
                     const void *value)
{
  const QuietErrors quiet;
  const Handle space = checked(H5Screate(H5S_SCALAR), H5Sclose, location);
  const Handle attribute =
      checked(H5Acreate2(group.id(), name.c_str(), type, space.id(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose, location);
  if (H5Awrite(attribute.id(), type, value) < 0)
    throw std::runtime_error("cannot write '" + location + "' to the HDF5 file: is the disk full?");
}
} // namespace

GroupWriter GroupWriter::group(const std::string &name)
{
  const QuietErrors quiet;
  require_name(name, location(name));
  const Handle properties = checked(H5Pcreate(H5P_GROUP_CREATE), H5Pclose, location(name));
  H5Pset_obj_track_times(properties.id(), false);
  Handle handle = checked(H5Gcreate2(handle_.id(), name.c_str(), H5P_DEFAULT, properties.id(), H5P_DEFAULT), H5Gclose,
                          location(name));
  return {std::move(handle), location(name) + "/"};
}

void GroupWriter::number(const std::string &name, double value)
{
  if (!std::isfinite(value))
    throw ComputationError("cannot store '" + location(name) + "': the value is not finite");
  write_attribute(handle_, name, location(name), H5T_NATIVE_DOUBLE, &value);
}

void GroupWriter::integer(const std::string &name, std::int32_t value)
{
  write_attribute(handle_, name, location(name), H5T_NATIVE_INT32, &value);
}

void GroupWriter::text(const std::string &name, const std::string &value)
{
  const Handle type = text_type(value.size(), location(name));
  write_attribute(handle_, name, location(name), type.id(), value.c_str());
}

void GroupWriter::write(const std::string &name, const double *values, const Extents &extents)
{
  require_name(name, location(name));
  if (!std::all_of(values, values + count_of(extents), [](double value) { return std::isfinite(value); }))
    throw ComputationError("cannot store '" + location(name) + "': it holds a value that is not finite");
  write_dataset(handle_, name, location(name), H5T_NATIVE_DOUBLE, values, extents);
}

void GroupWriter::write(const std::string &name, const std::int32_t *values, const Extents &extents)
{
  require_name(name, location(name));
  write_dataset(handle_, name, location(name), H5T_NATIVE_INT32, values, extents);
}

void GroupWriter::stack(const std::string &name, const std::vector<Points> &values)
{
  const Eigen::Index n_rows = values.empty() ? 0 : values[0].rows();
  std::vector<double> flat;
  flat.reserve(values.size() * static_cast<std::size_t>(n_rows) * 3);
  for (const Points &layer : values)
  {
    if (layer.rows() != n_rows)
      throw ComputationError("cannot store '" + location(name) + "': its layers differ in size");
    flat.insert(flat.end(), layer.data(), layer.data() + layer.size());
  }
  write(name, flat.data(), {static_cast<std::int64_t>(values.size()), n_rows, 3});
}

void GroupWriter::texts(const std::string &name, const std::vector<std::string> &values)
{
  require_name(name, location(name));
  std::size_t length = 1;
  for (const std::string &value : values)
    length = std::max(length, value.size());
  std::vector<char> flat(values.size() * length, '\0');
  for (std::size_t i = 0; i < values.size(); ++i)
    std::copy(values[i].begin(), values[i].end(), flat.begin() + static_cast<std::ptrdiff_t>(i * length));
  const Handle type = text_type(length, location(name));
  write_dataset(handle_, name, location(name), type.id(), flat.data(), {static_cast<std::int64_t>(values.size())});
}

void GroupWriter::numbers(const std::string &name, const std::vector<double> &values)
{
  write(name, values.data(), {static_cast<std::int64_t>(values.size())});
}

void GroupWriter::integers(const std::string &name, const std::vector<std::int32_t> &values)
{
  write(name, values.data(), {static_cast<std::int64_t>(values.size())});
}

StoreWriter::StoreWriter(const std::filesystem::path &file, const std::string &format) : pending_(file)
{
  const QuietErrors quiet;
  const Handle properties = checked(H5Pcreate(H5P_FILE_CREATE), H5Pclose, file.string());
  H5Pset_obj_track_times(properties.id(), false);
  file_ = Handle(H5Fcreate(pending_.temporary_path().c_str(), H5F_ACC_TRUNC, properties.id(), H5P_DEFAULT), H5Fclose);
  if (file_.id() < 0)
    throw std::runtime_error("cannot create '" + file.string() + "': check that its folder exists and is writable");
  root_.emplace(GroupWriter(checked(H5Gopen2(file_.id(), "/", H5P_DEFAULT), H5Gclose, "/"), "/"));
  root_->text("format", format);
  root_->text("format_version", store_format_version);
  root_->text("units", store_units);
  root_->text("frame", store_frame);
}

void StoreWriter::finish()
{
  root_->integer("complete", 1);
  root_.reset();
  const QuietErrors quiet;
  if (!file_.reset())
    throw std::runtime_error("cannot finish '" + pending_.temporary_path().string() + "': is the disk full?");
  pending_.publish();
}
} // namespace pelvireg::dataset
