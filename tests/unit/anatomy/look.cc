// Prints the counts and gaps of a case and writes its surfaces and bars as VTK files to look at: look CASE DIR.
#include "synthetic/anatomy/case.h"
#include "tests/unit/anatomy/surfaces.h"

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>

namespace
{
using namespace pelvireg;

void write(const dataset::SurfaceMesh &mesh, const std::filesystem::path &file)
{
  std::ofstream out(file);
  out << "# vtk DataFile Version 3.0\nsurface\nASCII\nDATASET POLYDATA\nPOINTS " << mesh.points.rows() << " double\n"
      << mesh.points << "\nPOLYGONS " << mesh.triangles.rows() << " " << 4 * mesh.triangles.rows() << "\n";
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t)
    out << "3 " << mesh.triangles.row(t) << "\n";
  out << "CELL_DATA " << mesh.triangles.rows() << "\nSCALARS region int 1\nLOOKUP_TABLE default\n"
      << mesh.region << "\n";
}

void write_lines(const std::vector<std::pair<Eigen::RowVector3d, Eigen::RowVector3d>> &lines,
                 const std::filesystem::path &file)
{
  std::ofstream out(file);
  out << "# vtk DataFile Version 3.0\nbars\nASCII\nDATASET POLYDATA\nPOINTS " << 2 * lines.size() << " double\n";
  for (const auto &[a, b] : lines)
    out << a << "\n" << b << "\n";
  out << "LINES " << lines.size() << " " << 3 * lines.size() << "\n";
  for (std::size_t i = 0; i < lines.size(); ++i)
    out << "2 " << 2 * i << " " << 2 * i + 1 << "\n";
}

dataset::Points nodes_of(const dataset::ReferenceModel &model, const std::string &part)
{
  for (const auto &shell : model.shells)
    if (shell.name == part)
      return shell.midsurface;
  for (const auto &solid : model.solids)
    if (solid.name == part)
      return solid.points;
  return {};
}

void print_gaps(const std::map<std::string, dataset::SurfaceMesh> &surfaces)
{
  for (auto a = surfaces.begin(); a != surfaces.end(); ++a)
    for (auto b = std::next(a); b != surfaces.end(); ++b)
    {
      const test::Gap gap = test::gap_between(a->second, b->second, 3);
      if (gap.distance < 15)
        std::printf("  gap %-13s %-13s %7.3f at %6.1f %6.1f %6.1f\n", a->first.c_str(), b->first.c_str(), gap.distance,
                    gap.where[0], gap.where[1], gap.where[2]);
    }
}
} // namespace

int main(int argc, char **argv)
{
  if (argc != 3)
    return 2;
  const std::filesystem::path directory = argv[2];
  std::filesystem::create_directories(directory);
  try
  {
    const auto start = std::chrono::steady_clock::now();
    const dataset::Anatomy anatomy = anatomy::build_anatomy(anatomy::case_text(argv[1]), argv[1]);
    std::printf("built in %.2f s\n", std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    for (const auto &shell : anatomy.reference.shells)
      std::printf("shell %-13s %5ld nodes %4ld cells, %ld fixed, %zu rims\n", shell.name.c_str(),
                  static_cast<long>(shell.midsurface.rows()), static_cast<long>(shell.cells.rows()),
                  static_cast<long>(shell.fixed_nodes.size()), shell.rims.size());
    for (const auto &solid : anatomy.reference.solids)
      std::printf("solid %-13s %5ld nodes %4ld cells %ld faces\n", solid.name.c_str(),
                  static_cast<long>(solid.points.rows()), static_cast<long>(solid.cells.rows()),
                  static_cast<long>(solid.faces.rows()));
    std::map<std::string, std::pair<int, double>> groups;
    std::vector<std::pair<Eigen::RowVector3d, Eigen::RowVector3d>> lines;
    for (const auto &bar : anatomy.reference.trusses)
    {
      const Eigen::RowVector3d a = nodes_of(anatomy.reference, bar.part_a).row(bar.node_a);
      const Eigen::RowVector3d b =
          bar.part_b.empty()
              ? Eigen::RowVector3d(bar.fixed_point.transpose())
              : Eigen::RowVector3d(nodes_of(anatomy.reference, bar.part_b).row(bar.node_b) + bar.offset_b.transpose());
      lines.push_back({a, b});
      ++groups[bar.group].first;
      groups[bar.group].second += (a - b).norm();
    }
    for (const auto &[group, entry] : groups)
      std::printf("bars %-20s %3d mean length %6.1f\n", group.c_str(), entry.first, entry.second / entry.first);
    for (const auto &body : anatomy.registration.bodies)
      std::printf("body %-13s %5ld nodes %5ld tets %4ld hexes %ld outer\n", body.name.c_str(),
                  static_cast<long>(body.points.rows()), static_cast<long>(body.tets.rows()),
                  static_cast<long>(body.hexes.rows()), static_cast<long>(body.outer_triangles.rows()));
    const auto reference = test::reference_surfaces(anatomy.reference),
               registration = test::registration_surfaces(anatomy.registration);
    print_gaps(reference);
    std::puts("registration");
    print_gaps(registration);
    for (const auto &[name, surface] : registration)
      std::printf("volume %-10s %.1f mL\n", name.c_str(), test::enclosed_volume(surface) / 1000);
    for (const auto &[name, surface] : reference)
      write(surface, directory / ("ref_" + name + ".vtk"));
    for (const auto &[name, surface] : registration)
      write(surface, directory / ("reg_" + name + ".vtk"));
    write_lines(lines, directory / "bars.vtk");
    lines.clear();
    for (const auto &body : anatomy.registration.bodies)
      for (Eigen::Index h = 0; h < body.hexes.rows(); ++h)
        for (const auto &[i, j] :
             {std::pair{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}})
          lines.push_back({body.points.row(body.hexes(h, i)), body.points.row(body.hexes(h, j))});
    write_lines(lines, directory / "bands.vtk");
  }
  catch (const std::exception &error)
  {
    std::puts(error.what());
    return 1;
  }
  return 0;
}
