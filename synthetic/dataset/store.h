// The HDF5 store: a small layer over the serial HDF5 C API. Single values and texts are attributes of their group,
// arrays are datasets. No time stamps, so equal content gives equal bytes. docs/result_format.md lists every file.
#pragma once

#include "synthetic/dataset/atomic_file.h"
#include "synthetic/dataset/geometry.h"

#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace pelvireg::dataset
{
inline constexpr const char *store_format_version = "1.0";
inline constexpr const char *store_units = "mm-N-MPa-s-t";
inline constexpr const char *store_frame = "LPS";

/// Owns one HDF5 identifier. hdf5.h stays out of the headers, so that no other HDF5 flavour can meet ours.
class Handle
{
public:
  using Close = int (*)(std::int64_t);
  Handle() = default;
  Handle(std::int64_t id, Close close) : id_(id), close_(close) {}
  Handle(Handle &&other) noexcept;
  Handle &operator=(Handle &&other) noexcept;
  ~Handle() { reset(); }
  std::int64_t id() const { return id_; }
  /// Close now. Returns false when HDF5 could not.
  bool reset();

private:
  std::int64_t id_ = -1;
  Close close_ = nullptr;
};

using Extents = std::vector<std::int64_t>;

/// One group being written. Throws ComputationError for a value that is not finite or a name that cannot be stored, and
/// std::runtime_error when the disk refuses.
class GroupWriter
{
public:
  GroupWriter group(const std::string &name);

  void number(const std::string &name, double value);
  void integer(const std::string &name, std::int32_t value);
  void text(const std::string &name, const std::string &value);

  /// An Eigen vector (rank 1) or a row-major Eigen matrix of fixed width (rank 2).
  template <typename Matrix> void array(const std::string &name, const Matrix &values)
  {
    static_assert(Matrix::ColsAtCompileTime == 1 || Matrix::IsRowMajor, "only vectors and row-major matrices");
    Extents extents{values.rows()};
    if (Matrix::ColsAtCompileTime != 1)
      extents.push_back(values.cols());
    write(name, values.data(), extents);
  }
  /// k arrays of one shape n x 3 as one dataset k x n x 3.
  void stack(const std::string &name, const std::vector<Points> &values);
  void texts(const std::string &name, const std::vector<std::string> &values);
  void numbers(const std::string &name, const std::vector<double> &values);
  void integers(const std::string &name, const std::vector<std::int32_t> &values);

private:
  friend class StoreWriter;
  GroupWriter(Handle handle, std::string path) : handle_(std::move(handle)), path_(std::move(path)) {}
  void write(const std::string &name, const double *values, const Extents &extents);
  void write(const std::string &name, const std::int32_t *values, const Extents &extents);
  std::string location(const std::string &name) const { return path_ + name; }

  Handle handle_;
  std::string path_; ///< ends in "/"
};

/// A file being written: it gets its name in finish(), after the attribute `complete`.
class StoreWriter
{
public:
  StoreWriter(const std::filesystem::path &file, const std::string &format);
  GroupWriter &root() { return *root_; }
  void finish();

private:
  AtomicFile pending_;
  Handle file_;
  std::optional<GroupWriter> root_;
};

/// One group being read. Every failure is an InputError that names file and dataset.
class GroupReader
{
public:
  GroupReader group(const std::string &name) const;
  /// Whether an optional group or dataset is there.
  bool has(const std::string &name) const;

  double number(const std::string &name) const;
  std::int32_t integer(const std::string &name) const;
  std::string text(const std::string &name) const;

  template <typename Matrix> Matrix array(const std::string &name) const
  {
    constexpr int width = Matrix::ColsAtCompileTime;
    const Handle dataset = open(name);
    const Extents extents = width == 1 ? extents_of(dataset, name, {-1}) : extents_of(dataset, name, {-1, width});
    Matrix values(extents[0], width == 1 ? 1 : extents[1]);
    read(dataset, name, values.data(), values.size());
    return values;
  }
  /// The same with exactly n_rows rows.
  template <typename Matrix> Matrix array(const std::string &name, std::int64_t n_rows) const
  {
    Matrix values = array<Matrix>(name);
    require_rows(name, values.rows(), n_rows);
    return values;
  }
  /// An integer array whose every entry lies in 0 … limit - 1.
  template <typename Matrix> Matrix indices(const std::string &name, std::int64_t limit) const
  {
    Matrix values = array<Matrix>(name);
    require_range(name, values.data(), values.size(), limit);
    return values;
  }
  std::vector<Points> stack(const std::string &name, std::int64_t n_layers, std::int64_t n_rows) const;
  std::vector<std::string> texts(const std::string &name) const;
  std::vector<double> numbers(const std::string &name, std::int64_t count) const;
  std::vector<std::int32_t> integers(const std::string &name, std::int64_t count) const;

  /// Throw InputError: "file: 'location' problem; make the file again".
  [[noreturn]] void refuse(const std::string &name, const std::string &problem) const;

private:
  friend class StoreReader;
  GroupReader(Handle handle, std::string file, std::string path)
      : handle_(std::move(handle)), file_(std::move(file)), path_(std::move(path))
  {
  }
  Handle open(const std::string &name) const;
  /// Extents of a dataset; `expected` gives its rank and, where not -1, its extents.
  Extents extents_of(const Handle &dataset, const std::string &name, const Extents &expected) const;
  void read(const Handle &dataset, const std::string &name, double *values, std::int64_t count) const;
  void read(const Handle &dataset, const std::string &name, std::int32_t *values, std::int64_t count) const;
  void require_rows(const std::string &name, std::int64_t got, std::int64_t expected) const;
  void require_range(const std::string &name, const std::int32_t *values, std::int64_t count, std::int64_t limit) const;

  Handle handle_;
  std::string file_;
  std::string path_; ///< ends in "/"
};

/// An open file whose format, version, units, frame and completeness have been checked.
class StoreReader
{
public:
  StoreReader(const std::filesystem::path &file, const std::string &format);
  const GroupReader &root() const { return *root_; }

private:
  Handle file_;
  std::optional<GroupReader> root_;
};

/// A surface mesh as points, triangles, region.
void write_surface(GroupWriter &group, const SurfaceMesh &surface);
SurfaceMesh read_surface(const GroupReader &group);
/// A plane as origin and normal; read_plane refuses a normal whose length is not 1 within 1e-9.
void write_plane(GroupWriter &group, const std::string &name, const Plane &plane);
Plane read_plane(const GroupReader &group, const std::string &name);
} // namespace pelvireg::dataset
