#include "reference_fe/decks/decks.h"
#include "reference_fe/decks/number_field.h"
#include "synthetic/dataset/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <string>
#include <utility>

namespace pelvireg::reference_fe
{
namespace
{
/// The lines of a file, with the sentence for what is wrong in one.
class FrdLines
{
public:
  explicit FrdLines(const std::filesystem::path &file) : file_(file), in_(file, std::ios::binary)
  {
    if (!in_ || !std::filesystem::is_regular_file(file))
      throw InputError(fmt::format("'{}' cannot be read; give the .frd file that ccx wrote", file.string()));
  }

  bool next()
  {
    ++number_;
    if (!std::getline(in_, line_))
      return false;
    if (!line_.empty() && line_.back() == '\r')
      line_.pop_back();
    return true;
  }

  void next_of(const std::string &block)
  {
    if (!next())
      refuse(fmt::format("the file ends inside {}: ccx still runs, or the file is cut off; copy it again", block));
  }

  const std::string &line() const { return line_; }
  bool begins(const std::string &key) const { return line_.rfind(key, 0) == 0; }
  std::string field(std::size_t begin, std::size_t length) const
  {
    return begin < line_.size() ? line_.substr(begin, length) : "";
  }

  [[noreturn]] void refuse(const std::string &what) const
  {
    throw InputError(fmt::format("'{}', line {}: {}", file_.string(), number_, what));
  }

  int integer(std::size_t begin, std::size_t length, const std::string &what) const
  {
    if (const auto value = integer_field(field(begin, length)))
      return *value;
    refuse(fmt::format("{} is '{}', must be an integer; give an undamaged .frd file", what, field(begin, length)));
  }

  double number(std::size_t begin, std::size_t length, const std::string &what) const
  {
    if (const auto value = number_field(field(begin, length)))
      return *value;
    refuse(fmt::format("{} is '{}', must be a finite number; give the result of a converged run", what,
                       field(begin, length)));
  }

private:
  std::filesystem::path file_;
  std::ifstream in_;
  std::string line_;
  long number_ = 0;
};

struct NodeTable
{
  std::vector<int> ids;
  std::vector<std::array<double, 3>> values;
};

/// Lines " -1", id, three numbers (and, in a result, what its components are called) until " -3".
NodeTable read_table(FrdLines &lines, int n_rows, int form, const std::string &block)
{
  if (form != 0 && form != 1)
    lines.refuse(fmt::format("{} is binary (format {}); let ccx write ASCII, as it does by default", block, form));
  const std::size_t width = form == 1 ? 10 : 5;
  NodeTable table;
  for (lines.next_of(block); !lines.begins(" -3"); lines.next_of(block))
  {
    if (lines.begins(" -5"))
      continue;
    if (!lines.begins(" -1"))
      lines.refuse(fmt::format("{} holds '{}', must hold lines that begin with -1; give an undamaged .frd file", block,
                               lines.field(0, 20)));
    const int id = lines.integer(3, width, "a node of " + block);
    if (!table.ids.empty() && id <= table.ids.back())
      lines.refuse(fmt::format("node {} follows node {} in {}, must ascend; give an undamaged .frd file", id,
                               table.ids.back(), block));
    table.ids.push_back(id);
    std::array<double, 3> &values = table.values.emplace_back();
    for (std::size_t k = 0; k < 3; ++k)
      values[k] = lines.number(3 + width + 12 * k, 12, fmt::format("value {} of node {} in {}", k + 1, id, block));
  }
  if (static_cast<int>(table.ids.size()) != n_rows)
    lines.refuse(fmt::format("{} has {} nodes but announced {}; the file is damaged: write it again", block,
                             table.ids.size(), n_rows));
  return table;
}

dataset::Points to_points(const NodeTable &table)
{
  dataset::Points points(static_cast<Eigen::Index>(table.values.size()), 3);
  for (std::size_t i = 0; i < table.values.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      points(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) = table.values[i][k];
  return points;
}

int format_of(const FrdLines &lines, const std::string &block)
{
  return lines.integer(73, 2, "the format of " + block);
}

/// A result block whose first line has just been read; kept when it holds displacements.
void read_result(FrdLines &lines, NodalResults &results)
{
  const double time = lines.number(12, 12, "the time of a result");
  const int n_rows = lines.integer(24, 12, "the number of nodes of a result");
  const std::string block = fmt::format("the result at time {:g}", time);
  const int form = format_of(lines, block);
  lines.next_of(block);
  if (lines.field(5, 8) != "DISP    ")
  {
    while (!lines.begins(" -3"))
      lines.next_of(block);
    return;
  }
  const NodeTable table = read_table(lines, n_rows, form, block);
  if (table.ids != results.ids)
    lines.refuse(fmt::format("{} has other nodes than the mesh ({} against {}); ask for U of all nodes, *NODE FILE "
                             "without NSET and OUTPUT=3D",
                             block, table.ids.size(), results.ids.size()));
  results.times.push_back(time);
  results.displacements.push_back(to_points(table));
}
} // namespace

NodalResults read_frd(const std::filesystem::path &file)
{
  FrdLines lines(file);
  NodalResults results;
  constexpr const char *no_nodes =
      "the file has no nodes (no line that begins with 2C) before its results; give the .frd file that ccx wrote";
  bool has_mesh = false, is_complete = false;
  while (!is_complete && lines.next())
    if (lines.begins("    2C") && !has_mesh)
    {
      const int n_rows = lines.integer(24, 12, "the number of nodes");
      const NodeTable table = read_table(lines, n_rows, format_of(lines, "the mesh"), "the mesh");
      results.ids = table.ids;
      results.rest = to_points(table);
      has_mesh = true;
    }
    else if (lines.begins("  100C"))
    {
      if (!has_mesh)
        lines.refuse(no_nodes);
      read_result(lines, results);
    }
    else
      is_complete = lines.begins(" 9999");
  if (!has_mesh)
    lines.refuse(no_nodes);
  if (!is_complete)
    lines.refuse("the file has no last line 9999, so ccx stopped before its last step, still runs, or the file is cut "
                 "off; see what ccx printed");
  return results;
}
} // namespace pelvireg::reference_fe
