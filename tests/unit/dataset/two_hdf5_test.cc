// Debian's deal.II brings the MPI build of HDF5, VTK the serial one. With both in one process the store still works.
#include "tests/unit/dataset/samples.h"

#include <deal.II/base/hdf5.h>
#include <gtest/gtest.h>
#include <vtkHDFReader.h>
#include <vtkNew.h>

#include <dlfcn.h>
#include <fstream>

namespace pelvireg::dataset::testing
{
namespace
{
bool is_loaded(const std::string &library)
{
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);)
    if (line.find(library) != std::string::npos)
      return true;
  return false;
}

/// The library that H5Fopen of this program comes from.
std::string hdf5_library()
{
  Dl_info info;
  return dladdr(reinterpret_cast<void *>(&H5Fopen), &info) ? info.dli_fname : "";
}
} // namespace

TEST(Store, RoundTripsWithBothHdf5BuildsInOneProcess)
{
  const ScratchFolder folder;
  // Only the constructor: deal.II's inline HDF5 calls would resolve to our build and meet an identifier of the other.
  const dealii::HDF5::File other((folder / "other.h5").string(), dealii::HDF5::File::FileAccessMode::create);
  save(sample_truth(), folder / "first.h5");
  vtkNew<vtkHDFReader> reader;
  EXPECT_EQ(reader->CanReadFile((folder / "first.h5").c_str()), 0); // HDF5, but not VTK's
  save(load_truth(folder / "first.h5"), folder / "second.h5");
  EXPECT_EQ(bytes_of(folder / "first.h5"), bytes_of(folder / "second.h5"));
  EXPECT_NE(hdf5_library().find("hdf5_serial"), std::string::npos) << hdf5_library();
  EXPECT_TRUE(is_loaded("libhdf5_openmpi"));
  EXPECT_TRUE(is_loaded("libhdf5_serial"));
  EXPECT_TRUE(is_loaded("libvtkIOHDF"));
}
} // namespace pelvireg::dataset::testing
