// The pinched cylinder of Sze, Liu, Lo (2004, case 3.6) for CalculiX or Abaqus: an unrelated program on the same
// eighth that shell_study follows.
// usage: pinched_cylinder_deck N1 N2 ELEMENT FACTOR [FACTOR ...] > FILE.inp
// N1 x N2 20-node bricks of type ELEMENT (C3D20R or C3D20), one through the wall; FACTORs of P_max, a step each.
#include "reference_fe/decks/deck_text.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <string>
#include <vector>

namespace
{
using pelvireg::reference_fe::DeckText;

constexpr double radius = 100, half_length = 100, thickness = 1, quarter_of_largest_load = 3000;

/// Nodes on a lattice of half cells: i from the top (x = 0) round to the side (z = 0), j from the middle (y = 0) to the
/// diaphragm, k = 0, 1, 2 from the inner surface to the outer. A brick's nodes have at most one odd index.
struct Lattice
{
  int n1 = 1, n2 = 1;

  int i_end() const { return 2 * n1; }
  int j_end() const { return 2 * n2; }
  static bool has(int i, int j, int k) { return i % 2 + j % 2 + k % 2 <= 1; }
  int id(int i, int j, int k) const { return 1 + i + (i_end() + 1) * (j + (j_end() + 1) * k); }
  /// A node of its own whose z is the mean through the wall under the load.
  int loaded() const { return 1 + id(i_end(), j_end(), 2); }

  template <typename Function> void for_each(const Function &function) const
  {
    for (int k = 0; k <= 2; ++k)
      for (int j = 0; j <= j_end(); ++j)
        for (int i = 0; i <= i_end(); ++i)
          if (has(i, j, k))
            function(i, j, k);
  }
};

void write_nodes(const Lattice &lattice, DeckText &deck)
{
  deck.line("*NODE");
  lattice.for_each(
      [&](int i, int j, int k)
      {
        const double angle = std::numbers::pi / 2 * i / lattice.i_end(), r = radius + thickness * (k - 1) / 2;
        deck.line("{},{:.15g},{:.15g},{:.15g}", lattice.id(i, j, k), r * std::sin(angle),
                  half_length * j / lattice.j_end(), r * std::cos(angle));
      });
  deck.line("{},0.,0.,{}", lattice.loaded(), radius);
}

void write_bricks(const Lattice &lattice, const std::string &element, DeckText &deck)
{
  constexpr int offsets[20][3] = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {0, 0, 2}, {2, 0, 2}, {2, 2, 2},
                                  {0, 2, 2}, {1, 0, 0}, {2, 1, 0}, {1, 2, 0}, {0, 1, 0}, {1, 0, 2}, {2, 1, 2},
                                  {1, 2, 2}, {0, 1, 2}, {0, 0, 1}, {2, 0, 1}, {2, 2, 1}, {0, 2, 1}};
  deck.line("*ELEMENT, TYPE={}, ELSET=WALL", element);
  for (int cell = 0; cell < lattice.n1 * lattice.n2; ++cell)
  {
    std::vector<std::string> ids = {std::to_string(cell + 1)};
    for (const auto &[i, j, k] : offsets)
      ids.push_back(std::to_string(lattice.id(2 * (cell % lattice.n1) + i, 2 * (cell / lattice.n1) + j, k)));
    deck.list(ids, 12);
  }
  // With NLGEOM a law between Green-Lagrange strain and second Piola-Kirchhoff stress.
  deck.line("*MATERIAL, NAME=WALL\n*ELASTIC\n30000.,0.3\n*SOLID SECTION, ELSET=WALL, MATERIAL=WALL");
}

/// Mirror planes hold the whole wall; the diaphragm holds the mid-surface in its plane, which between the corners is
/// the mean of inner and outer node.
void write_supports(const Lattice &lattice, DeckText &deck)
{
  deck.line("*BOUNDARY");
  lattice.for_each(
      [&](int i, int j, int k)
      {
        const int id = lattice.id(i, j, k);
        const bool held = j == lattice.j_end() && k == 1;
        if (i == 0 || held)
          deck.line("{},1", id);
        if (j == 0)
          deck.line("{},2", id);
        if (i == lattice.i_end() || held)
          deck.line("{},3", id);
      });
  deck.line("{},1,2", lattice.loaded());
  for (int i = 1; i < lattice.i_end(); i += 2)
    for (const int direction : {1, 3})
      deck.line("*EQUATION\n2\n{0},{2},1.,{1},{2},1.", lattice.id(i, lattice.j_end(), 0),
                lattice.id(i, lattice.j_end(), 2), direction);
}

/// The force acts on the mean through the wall.
void write_steps(const Lattice &lattice, const std::vector<double> &factors, DeckText &deck)
{
  deck.line("*EQUATION\n4\n{},3,1.,{},3,4.,{},3,1.,{},3,-6.", lattice.id(0, 0, 0), lattice.id(0, 0, 1),
            lattice.id(0, 0, 2), lattice.loaded());
  deck.line("*NSET, NSET=OBSERVED\n{},{}", lattice.id(0, 0, 1), lattice.id(lattice.i_end(), 0, 1));
  for (const double factor : factors)
  {
    deck.line("*STEP, NLGEOM, INC=2000\n*STATIC\n0.25,1.,1.E-5,1.");
    deck.line("*CONTROLS, PARAMETERS=FIELD\n1.E-5,1.E-4");
    deck.line("*CLOAD\n{},3,{:.12g}", lattice.loaded(), -quarter_of_largest_load * factor);
    deck.line("*NODE PRINT, NSET=OBSERVED, FREQUENCY=2000\nU\n*END STEP");
  }
}
} // namespace

int main(int argc, char **argv)
{
  const bool is_complete = argc >= 5;
  const std::string element = is_complete ? argv[3] : "";
  const Lattice lattice{is_complete ? std::atoi(argv[1]) : 0, is_complete ? std::atoi(argv[2]) : 0};
  if (lattice.n1 < 1 || lattice.n2 < 1 || (element != "C3D20R" && element != "C3D20"))
  {
    fmt::print(stderr, "usage: pinched_cylinder_deck N1 N2 C3D20R|C3D20 FACTOR [FACTOR ...] > FILE.inp\n"
                       "example: pinched_cylinder_deck 40 40 C3D20R 0.05 0.075 0.1 0.125 > cylinder.inp\n");
    return 2;
  }
  std::vector<double> factors;
  for (int i = 4; i < argc; ++i)
    factors.push_back(std::atof(argv[i]));
  DeckText deck;
  write_nodes(lattice, deck);
  write_bricks(lattice, element, deck);
  write_supports(lattice, deck);
  write_steps(lattice, factors, deck);
  std::fputs(deck.take().c_str(), stdout);
  return 0;
}
