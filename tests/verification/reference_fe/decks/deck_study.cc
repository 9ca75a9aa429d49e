// Refinement study: CalculiX and the reference's own solver on the same decks, both meshes refined. Not a test: it
// takes minutes. Usage: deck_study CASE PART LEVELS PRESSURE_MPA STEPS LAYERS
#include "tests/verification/reference_fe/decks/deck_case.h"

#include <fmt/format.h>

#include <cstdlib>

int main(int argc, char **argv)
{
  using namespace pelvireg;
  using namespace pelvireg::reference_fe;
  if (argc != 7)
  {
    fmt::print(stderr, "usage: deck_study CASE PART LEVELS PRESSURE_MPA STEPS LAYERS\n"
                       "example: deck_study quick bladder 3 -0.002 4 1\n");
    return 2;
  }
  const int levels = std::atoi(argv[3]), steps = std::atoi(argv[5]), layers = std::atoi(argv[6]);
  std::vector<double> pressures;
  for (int s = 1; s <= steps; ++s)
    pressures.push_back(std::atof(argv[4]) * s / steps);
  std::string folder = (std::filesystem::temp_directory_path() / "deck-study-XXXXXX").string();
  if (!mkdtemp(folder.data()))
    return 1;
  dataset::Anatomy anatomy = deck_case::lone_shell(argv[1], argv[2], steps);
  const dataset::Anatomy coarse = anatomy;
  const Eigen::Index n_common = anatomy.reference.shells[0].midsurface.rows();
  dataset::Truth former_own, former_ccx;
  for (int level = 0; level < levels; ++level)
  {
    if (level > 0)
      anatomy = deck_case::refined(anatomy);
    double own_seconds = 0, ccx_seconds = 0;
    const dataset::Truth own = deck_case::moved_by_reference(anatomy, pressures, &own_seconds);
    fmt::print("{} cells, {} bars: own {:.1f} s", anatomy.reference.shells[0].cells.rows(),
               anatomy.reference.trusses.size(), own_seconds);
    std::fflush(stdout);
    const dataset::Truth ccx = deck_case::moved_by_calculix(anatomy, pressures, layers, folder, &ccx_seconds);
    fmt::print(", ccx {:.1f} s\n", ccx_seconds);
    const auto print = [&](const char *what, const dataset::Truth &a, const dataset::Truth &b)
    {
      if (a.surfaces.empty())
        return;
      for (const double clearance : {0., 8.})
      {
        const deck_case::FieldDifference d = deck_case::difference(coarse, a, b, n_common, clearance);
        fmt::print("  {} ({} of {} nodes farther than {} mm from a bar): largest {:.4f} mm = {:.2f} %, mean {:.4f} mm "
                   "= {:.2f} % of {:.3f} mm\n",
                   what, d.n_away, d.n_nodes, clearance, d.largest, 100 * d.largest / d.largest_displacement, d.mean,
                   100 * d.mean / d.largest_displacement, d.largest_displacement);
      }
    };
    print("CalculiX against own", ccx, own);
    print("own against coarser own", former_own, own);
    print("CalculiX against coarser CalculiX", former_ccx, ccx);
    std::fflush(stdout);
    former_own = own;
    former_ccx = ccx;
  }
}
