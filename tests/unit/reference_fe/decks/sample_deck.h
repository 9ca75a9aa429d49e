// A small anatomy whose deck is known by heart, and CalculiX result files written by hand.
#pragma once

#include "reference_fe/decks/deck_mesh.h"
#include "synthetic/dataset/anatomy.h"
#include "tests/scratch_folder.h"

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace pelvireg::reference_fe
{
/// A flat plate of 1 x 1 cells, z = 0, thickness 2 mm, normal +z: corners (0, 0), (4, 0), (4, 4), (0, 4).
inline dataset::ReferenceShell plate(const std::string &name)
{
  dataset::ReferenceShell shell;
  shell.name = name;
  shell.material = "wall";
  shell.midsurface.resize(9, 3);
  shell.midsurface << 0, 0, 0, 4, 0, 0, 4, 4, 0, 0, 4, 0, 2, 0, 0, 4, 2, 0, 2, 4, 0, 0, 2, 0, 2, 2, 0;
  shell.directors = Eigen::RowVector3d(0, 0, 1).replicate(9, 1);
  shell.thickness = Eigen::VectorXd::Constant(9, 2);
  shell.cells.resize(1, 9);
  shell.cells << 0, 1, 2, 3, 4, 5, 6, 7, 8;
  shell.region = dataset::Integers::Constant(1, static_cast<int>(dataset::SurfaceRegion::peritoneal));
  shell.fixed_nodes.resize(3);
  shell.fixed_nodes << 0, 3, 7;
  return shell;
}

/// A plate called 'vagina', a solid called 'uterus' of one tetrahedron, bars to a corner and to the middle of the
/// plate.
inline dataset::Anatomy sample_deck_anatomy()
{
  dataset::Anatomy anatomy;
  anatomy.case_name = "sample";
  anatomy.dyn_plane.origin = {1.3, 0, 0};
  dataset::ReferenceModel &reference = anatomy.reference;
  reference.n_increments = 2;
  reference.materials["wall"] = {0.25, 0.5, 0.125, 40};
  reference.materials["soft"] = {0.125, 0, 0, 16};
  reference.shells = {plate("vagina")};
  dataset::ReferenceSolid solid;
  solid.name = "uterus";
  solid.material = "soft";
  solid.points.resize(10, 3);
  solid.points << 0, 0, 5, 2, 0, 5, 0, 2, 5, 0, 0, 7, 1, 0, 5, 1, 1, 5, 0, 1, 5, 0, 0, 6, 1, 0, 6, 0, 1, 6;
  solid.cells.resize(1, 10);
  solid.cells << 0, 1, 2, 3, 4, 5, 6, 7, 8, 9;
  solid.faces.resize(4, 6);
  solid.faces << 0, 2, 1, 6, 5, 4, 0, 1, 3, 4, 8, 7, 1, 2, 3, 5, 9, 8, 2, 0, 3, 6, 7, 9;
  solid.region = dataset::Integers::Zero(4);
  solid.region[2] = static_cast<int>(dataset::SurfaceRegion::peritoneal);
  reference.solids = {solid};
  reference.trusses.push_back({"band", "vagina", 2, "", -1, {4, 4, 9}, 3, "wall"});
  reference.trusses.push_back({"band", "vagina", 8, "uterus", 3, {0, 0, 0}, 3, "wall"});
  reference.contact_pairs = {{"vagina", "uterus"}};
  return anatomy;
}

using Field = std::function<Eigen::Vector3d(const Eigen::Vector3d &)>;

/// The rows " -1", id, three numbers of a .frd file.
inline std::string frd_rows(const std::map<int, Eigen::Vector3d> &nodes, const Field &field)
{
  std::string text;
  for (const auto &[id, x] : nodes)
  {
    const Eigen::Vector3d value = field(x);
    text += fmt::format(" -1{:10d}{:12.5E}{:12.5E}{:12.5E}\n", id, value[0], value[1], value[2]);
  }
  return text + " -3\n";
}

/// A result file: the field times the time at each time; a stress result that must be passed over stands between.
inline std::string frd_text(const std::map<int, Eigen::Vector3d> &nodes, const std::vector<double> &times,
                            const Field &field)
{
  std::string text = fmt::format("    1C\n    1UUSER\n    2C{:18}{:12d}{:37}1\n", "", nodes.size(), "");
  text += frd_rows(nodes, [](const Eigen::Vector3d &x) { return x; });
  for (const double time : times)
  {
    const std::string head =
        fmt::format("    1PSTEP\n  100CL  101{:12.5E}{:12d}{:20} 0{:5d}{:10} 1\n", time, nodes.size(), "", 1, "");
    text += head + " -4  STRESS      6    1\n -5  SXX         1    4    1    1\n";
    text += frd_rows(nodes, [](const Eigen::Vector3d &) { return Eigen::Vector3d(1, 2, 3); });
    text += head + " -4  DISP        4    1\n -5  D1          1    2    1    0\n -5  D2          1    2    2    0\n"
                   " -5  D3          1    2    3    0\n -5  ALL         1    2    0    0    1ALL\n";
    text += frd_rows(nodes, [&](const Eigen::Vector3d &x) { return Eigen::Vector3d(time * field(x)); });
  }
  return text + " 9999\n";
}

/// A file of its own for one test, removed at the end.
class ScratchFile
{
public:
  ScratchFile(const std::string &extension, const std::string &text) : extension_(extension)
  {
    std::ofstream(path(), std::ios::binary) << text;
  }
  std::filesystem::path path() const { return folder_ / ("results" + extension_); }

private:
  test::ScratchFolder folder_;
  std::string extension_;
};
} // namespace pelvireg::reference_fe
