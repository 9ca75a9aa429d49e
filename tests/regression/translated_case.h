// A truth without the reference's cost: every node of the deck moves alike.
#pragma once

#include "tests/regression/program.h"

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace pelvireg
{
/// The ids of the nodes of a deck.
inline std::vector<int> node_ids(const std::string &deck)
{
  std::vector<int> ids;
  std::istringstream lines(deck.substr(deck.find("*NODE")));
  std::string line;
  for (std::getline(lines, line); std::getline(lines, line) && line.front() != '*';)
    ids.push_back(std::stoi(line));
  return ids;
}

/// The table of a rigid translation by (0, shift, -0.2) mm an increment.
inline std::string translation(const std::vector<int> &ids, int n_increments, double shift = 0.1)
{
  std::ostringstream table;
  table << "increment,node,u1,u2,u3\n";
  for (int i = 1; i <= n_increments; ++i)
    for (const int id : ids)
      table << i << "," << id << ",0," << shift * i << "," << -0.2 * i << "\n";
  return table.str();
}

/// Programs on the case `quick` whose truth is that translation.
class TranslatedCase : public Program
{
protected:
  /// anatomy.h5, truth.h5 and observations.h5 in `directory`.
  void make_translated(const std::string &directory) const
  {
    ASSERT_EQ(call("anatomy quick --out " + directory).status, 0);
    ASSERT_EQ(call("export " + directory + " --format abaqus --pressure 0.001").status, 0);
    const std::vector<int> ids = node_ids(content_of(folder_ / directory / "abaqus" / "pelvis.inp"));
    std::ofstream(folder_ / "translation.csv") << translation(ids, 8);
    ASSERT_EQ(call("import " + directory + " --from translation.csv --pressure 0.001").status, 0);
    ASSERT_EQ(call("observe " + directory).status, 0);
  }

  /// As it is now, under another name.
  void copy(const std::string &from, const std::string &to) const
  {
    std::filesystem::copy(folder_ / from, folder_ / to, std::filesystem::copy_options::recursive);
  }
};
} // namespace pelvireg
