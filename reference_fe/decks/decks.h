// The public entry of the decks: input decks for Abaqus and CalculiX out, their results in.
#pragma once

#include "synthetic/dataset/anatomy.h"
#include "synthetic/dataset/truth.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace pelvireg::reference_fe
{
/// Follower pressures at the end of each step of a deck; between the ends they rise linearly.
struct DeckLoads
{
  std::vector<double> pressure; ///< abdominal pressure on the peritoneal faces, MPa; one *STEP a value
  /// Fluid pressure on the inner faces of shells, MPa, by the shell's name; as many values as `pressure`. Shells that
  /// are not named carry none: neither program is given the incompressible fluid itself.
  std::map<std::string, std::vector<double>> cavity_pressure = {};
};

struct DeckOptions
{
  int layers = 1;       ///< bricks through each wall, 1 … 8
  bool springs = false; ///< bars as SPRINGA with a table of force and elongation instead of T3D2
};

/// The pressures of a truth: the abdominal one of every increment, and the fluids' when `with_cavities`.
DeckLoads loads_of(const dataset::Truth &truth, bool with_cavities);

/// The anatomy with the named parts of the reference alone: bars to parts that are left out end in space at rest, ties
/// and contacts with them are gone. Throws InputError for a name that is no part.
dataset::Anatomy cut_parts(const dataset::Anatomy &anatomy, const std::vector<std::string> &parts);

/// The reference model as the text of an Abaqus input deck that CalculiX 2.20 runs too: shells as C3D20R through the
/// wall, solids as C3D10, bars as T3D2 or springs, ties, supports, follower pressure, one *STEP an increment with
/// NLGEOM. Contact and fluid cavities are left out, and the header says so. Units mm, N, MPa; frame LPS; ids begin
/// at 1.
///
/// Node n (0-based) of part i has the id 1 + n + (number of nodes of the parts before it), shells before solids, for
/// every number of layers: of a shell this is the node of the outer surface. Centre nodes of the quadrilaterals do not
/// exist in the deck: their ids are left out.
/// Throws InputError for loads that are empty, not finite or of different lengths, and for a number of layers out of
/// range.
std::string abaqus_deck(const dataset::Anatomy &anatomy, const DeckLoads &loads, const DeckOptions &options);

/// Displacements of nodes at the end of each increment, as another program gives them.
struct NodalResults
{
  std::vector<int> ids;                       ///< ascending, unique
  std::optional<dataset::Points> rest;        ///< n x 3, mm, when the file has them
  std::vector<double> times;                  ///< total time of each result; increment i ends at time i
  std::vector<dataset::Points> displacements; ///< one n x 3 a time, mm
};

/// CalculiX' result file in its ASCII form (ccx' default), DISP results of every step or increment that it holds.
/// Throws InputError with file and line for what is not such a file, is cut off, or holds a number that is not finite.
NodalResults read_frd(const std::filesystem::path &file);

/// A table "increment,node,u1,u2,u3" (that header; increments 1 … I in ascending order, ids of the deck, mm).
/// Throws InputError with file and line.
NodalResults read_displacement_csv(const std::filesystem::path &file);

/// The truth that nodal results of the deck of `anatomy` make: the same surfaces as the reference's own, displaced.
/// @param source  who moved the pelvis, written into the file
/// @param pressure  abdominal pressure at the last increment, MPa, rising evenly; 0 when not known
/// What the other program does not hand over (residual, energy, iterations, cuts, penetration) is recorded as -1, and
/// no cavity is listed. Throws InputError when a node of an outer surface is missing or lies elsewhere at rest (1e-3
/// mm), or when the results are not one an increment.
dataset::Truth imported_truth(const dataset::Anatomy &anatomy, const NodalResults &results, const std::string &source,
                              double pressure);
} // namespace pelvireg::reference_fe
