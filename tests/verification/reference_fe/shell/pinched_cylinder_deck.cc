// The pinched cylinder of Sze, Liu, Lo (2004, case 3.6) for CalculiX or Abaqus: an unrelated program on the same
// eighth that shell_study follows.
// usage: pinched_cylinder_deck N1 N2 ELEMENT FACTOR [FACTOR ...] > FILE.inp
//        pinched_cylinder_deck N1 N2 ELEMENT --displacement W [W ...] > FILE.inp
// N1 x N2 20-node bricks of type ELEMENT (C3D20R or C3D20), one through the wall. A step each: FACTORs of P_max, whose
// ends are printed; or inward displacements W of a node that a stiff spring ties to the load's point, with every
// increment printed: RF of that node (minus a quarter of the load) and U of the observed points.
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
/// Of the spring that pushes the load's point; the wall's own stiffness there is 20 to 240.
constexpr double spring_stiffness = 1000;

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
  /// The other end of the spring on that node.
  int driver() const { return loaded() + 1; }

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

/// What the steps prescribe, one value a step.
struct Loading
{
  bool by_displacement = false;
  std::vector<double> values; ///< factors of the largest load, or inward displacements of the driver
};

/// CalculiX gives no reaction at a node of an *EQUATION; at the spring's other end it does.
void write_spring(const Lattice &lattice, DeckText &deck)
{
  deck.line("*NODE, NSET=DRIVER\n{},0.,0.,{}", lattice.driver(), radius);
  deck.line("*ELEMENT, TYPE=SPRING2, ELSET=SPRING\n{},{},{}", lattice.n1 * lattice.n2 + 1, lattice.driver(),
            lattice.loaded());
  deck.line("*SPRING, ELSET=SPRING\n3,3\n{}.", spring_stiffness);
  deck.line("*BOUNDARY\n{},1,2", lattice.driver());
}

/// The force acts on the mean through the wall.
void write_steps(const Lattice &lattice, const Loading &loading, DeckText &deck)
{
  deck.line("*EQUATION\n4\n{},3,1.,{},3,4.,{},3,1.,{},3,-6.", lattice.id(0, 0, 0), lattice.id(0, 0, 1),
            lattice.id(0, 0, 2), lattice.loaded());
  deck.line("*NSET, NSET=OBSERVED\n{},{}", lattice.id(0, 0, 1), lattice.id(lattice.i_end(), 0, 1));
  if (loading.by_displacement)
    write_spring(lattice, deck);
  for (const double value : loading.values)
  {
    deck.line("*STEP, NLGEOM, INC=2000\n*STATIC\n0.25,1.,1.E-5,1.");
    deck.line("*CONTROLS, PARAMETERS=FIELD\n1.E-5,1.E-4");
    if (loading.by_displacement)
      deck.line("*BOUNDARY\n{},3,3,{:.12g}\n*NODE PRINT, NSET=DRIVER\nRF\n*NODE PRINT, NSET=OBSERVED\nU",
                lattice.driver(), -value);
    else
      deck.line("*CLOAD\n{},3,{:.12g}\n*NODE PRINT, NSET=OBSERVED, FREQUENCY=2000\nU", lattice.loaded(),
                -quarter_of_largest_load * value);
    deck.line("*END STEP");
  }
}
} // namespace

int main(int argc, char **argv)
{
  Loading loading;
  loading.by_displacement = argc > 4 && std::string(argv[4]) == "--displacement";
  for (int i = loading.by_displacement ? 5 : 4; i < argc; ++i)
    loading.values.push_back(std::atof(argv[i]));
  const bool is_complete = !loading.values.empty();
  const std::string element = is_complete ? argv[3] : "";
  const Lattice lattice{is_complete ? std::atoi(argv[1]) : 0, is_complete ? std::atoi(argv[2]) : 0};
  if (lattice.n1 < 1 || lattice.n2 < 1 || (element != "C3D20R" && element != "C3D20"))
  {
    fmt::print(stderr, "usage: pinched_cylinder_deck N1 N2 C3D20R|C3D20 FACTOR [FACTOR ...] > FILE.inp\n"
                       "       pinched_cylinder_deck N1 N2 C3D20R|C3D20 --displacement W [W ...] > FILE.inp\n"
                       "example: pinched_cylinder_deck 40 40 C3D20R 0.05 0.075 0.1 0.125 > cylinder.inp\n");
    return 2;
  }
  DeckText deck;
  write_nodes(lattice, deck);
  write_bricks(lattice, element, deck);
  write_supports(lattice, deck);
  write_steps(lattice, loading, deck);
  std::fputs(deck.take().c_str(), stdout);
  return 0;
}
