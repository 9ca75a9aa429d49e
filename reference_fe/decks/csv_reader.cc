#include "reference_fe/decks/decks.h"
#include "reference_fe/decks/number_field.h"
#include "synthetic/dataset/error.h"

#include <fmt/format.h>

#include <array>
#include <fstream>
#include <map>
#include <string>
#include <string_view>

namespace pelvireg::reference_fe
{
namespace
{
constexpr std::string_view header = "increment,node,u1,u2,u3";

struct Row
{
  int increment = 0, node = 0;
  std::array<double, 3> displacement{};
};

/// What is wrong with a line, or nothing.
std::string parse(std::string_view line, Row &row)
{
  std::array<std::string_view, 5> fields;
  for (std::size_t k = 0; k < 5; ++k)
  {
    const auto comma = line.find(',');
    if ((comma == line.npos) != (k == 4))
      return "has not five values";
    fields[k] = line.substr(0, comma);
    line.remove_prefix(k == 4 ? line.size() : comma + 1);
  }
  const auto increment = integer_field(fields[0]), node = integer_field(fields[1]);
  if (!increment || *increment < 1)
    return fmt::format("has the increment '{}', must be an integer from 1", fields[0]);
  if (!node || *node < 1)
    return fmt::format("has the node '{}', must be an integer from 1", fields[1]);
  row.increment = *increment;
  row.node = *node;
  for (std::size_t k = 0; k < 3; ++k)
  {
    const auto value = number_field(fields[k + 2]);
    if (!value)
      return fmt::format("has u{} = '{}', must be a finite number of mm", k + 1, fields[k + 2]);
    row.displacement[k] = *value;
  }
  return "";
}

using Increment = std::map<int, std::array<double, 3>>; ///< id to displacement

NodalResults to_results(const std::vector<Increment> &increments, const std::string &file)
{
  NodalResults results;
  for (const auto &[id, displacement] : increments.front())
    results.ids.push_back(id);
  for (std::size_t i = 0; i < increments.size(); ++i)
  {
    dataset::Points points(static_cast<Eigen::Index>(results.ids.size()), 3);
    Eigen::Index row = 0;
    for (const auto &[id, displacement] : increments[i])
    {
      if (row >= points.rows() || results.ids[static_cast<std::size_t>(row)] != id)
        throw InputError(fmt::format("'{}': increments 1 and {} have not the same nodes (node {}); give the same nodes "
                                     "at every increment",
                                     file, i + 1, id));
      points.row(row++) = Eigen::RowVector3d(displacement[0], displacement[1], displacement[2]);
    }
    if (row != points.rows())
      throw InputError(fmt::format("'{}': increment {} has {} nodes, increment 1 has {}; give the same nodes at every "
                                   "increment",
                                   file, i + 1, row, points.rows()));
    results.times.push_back(static_cast<double>(i + 1));
    results.displacements.push_back(std::move(points));
  }
  return results;
}
} // namespace

NodalResults read_displacement_csv(const std::filesystem::path &file)
{
  std::ifstream in(file, std::ios::binary);
  if (!in || !std::filesystem::is_regular_file(file))
    throw InputError(fmt::format("'{}' cannot be read; give a table of displacements", file.string()));
  std::vector<Increment> increments;
  long number = 0;
  for (std::string line; std::getline(in, line);)
  {
    ++number;
    const auto refuse = [&](const std::string &what)
    { throw InputError(fmt::format("'{}', line {}: it {}; see docs/decks.md", file.string(), number, what)); };
    if (!line.empty() && line.back() == '\r')
      line.pop_back();
    if (number == 1)
    {
      if (line != header)
        refuse(fmt::format("is '{}', must be '{}'", line.substr(0, 40), header));
      continue;
    }
    Row row;
    if (const std::string problem = parse(line, row); !problem.empty())
      refuse(problem);
    const auto last = static_cast<int>(increments.size());
    if (row.increment != last && row.increment != last + 1)
      refuse(fmt::format("has increment {} after increment {}, must be {} or {}", row.increment, last, last, last + 1));
    if (row.increment == last + 1)
      increments.emplace_back();
    if (!increments.back().emplace(row.node, row.displacement).second)
      refuse(fmt::format("has node {} of increment {} a second time", row.node, row.increment));
  }
  if (increments.empty())
    throw InputError(
        fmt::format("'{}' has no displacement; its first line must be '{}' and rows follow it", file.string(), header));
  return to_results(increments, file.string());
}
} // namespace pelvireg::reference_fe
