// Refinement study: CalculiX and the reference's own solver on the same decks, both meshes refined. Not a test: it
// takes minutes. The figures of docs/verification.md are its output.
#include "tests/verification/reference_fe/decks/deck_case.h"

#include <fmt/format.h>

#include <cstdlib>
#include <sstream>

namespace
{
using namespace pelvireg;
using namespace pelvireg::reference_fe;

void print(const char *what, const dataset::Anatomy &anatomy, const dataset::Truth &a, const dataset::Truth &b,
           const std::vector<Eigen::Index> &n_nodes)
{
  if (a.surfaces.empty() || a.surfaces[0].rest.points.rows() < n_nodes[0])
    return;
  for (std::size_t surface = 0; surface < n_nodes.size(); ++surface)
    for (const double clearance : {0., 8.})
    {
      const deck_case::FieldDifference d = deck_case::difference(anatomy, a, b, surface, n_nodes[surface], clearance);
      fmt::print("  {}, surface {}, {} of {} nodes ({} mm from bars): mean {:.4f} mm = {:.2f} %, largest {:.4f} mm = "
                 "{:.2f} % of {:.3f} mm\n",
                 what, surface, d.n_away, d.n_nodes, clearance, d.mean, 100 * d.mean / d.largest_displacement,
                 d.largest, 100 * d.largest / d.largest_displacement, d.largest_displacement);
    }
  std::fflush(stdout);
}
} // namespace

int main(int argc, char **argv)
{
  if (argc != 8)
  {
    fmt::print(stderr, "usage: deck_study CASE PART[,PART] LEVELS PRESSURE_MPA STEPS LAYERS trusses|springs\n"
                       "example: deck_study quick bladder 3 -0.001 4 1 springs\n");
    return 2;
  }
  std::vector<std::string> parts;
  std::istringstream words(argv[2]);
  for (std::string part; std::getline(words, part, ',');)
    parts.push_back(part);
  const int levels = std::atoi(argv[3]), steps = std::atoi(argv[5]);
  const DeckOptions options{.layers = std::atoi(argv[6]), .springs = std::string(argv[7]) == "springs"};
  std::vector<double> pressures;
  for (int s = 1; s <= steps; ++s)
    pressures.push_back(std::atof(argv[4]) * s / steps);
  std::string folder = (std::filesystem::temp_directory_path() / "deck-study-XXXXXX").string();
  if (!mkdtemp(folder.data()))
    return 1;

  const dataset::Anatomy coarse = deck_case::bare_parts(argv[1], parts, steps);
  dataset::Anatomy anatomy = coarse;
  dataset::Truth former;
  std::vector<Eigen::Index> n_common;
  for (int level = 0; level < levels; ++level)
  {
    if (level > 0)
      anatomy = deck_case::refined(anatomy);
    double own_seconds = 0, ccx_seconds = 0;
    const dataset::Truth own = deck_case::moved_by_reference(anatomy, pressures, &own_seconds);
    fmt::print("{} cells, {} bars: own {:.1f} s", anatomy.reference.shells[0].cells.rows(),
               anatomy.reference.trusses.size(), own_seconds);
    std::fflush(stdout);
    const dataset::Truth ccx = deck_case::moved_by_calculix(anatomy, pressures, options, folder, &ccx_seconds);
    fmt::print(", CalculiX {:.1f} s of processor time\n", ccx_seconds);
    if (level == 0)
      for (const dataset::TruthSurface &surface : own.surfaces)
        n_common.push_back(surface.displacements[0].rows());
    print("CalculiX against own", coarse, ccx, own, n_common);
    print("CalculiX against coarser CalculiX", coarse, former, ccx, n_common);
    former = ccx;
  }
  std::filesystem::remove_all(folder);
}
