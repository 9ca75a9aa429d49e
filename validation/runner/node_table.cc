#include "validation/runner/node_table.h"

#include "validation/runner/table_one.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

namespace pelvireg::runner
{
namespace
{
constexpr std::size_t title_width = 22, least_column = 8;

int sum_of(const std::vector<BodySize> &bodies)
{
  int sum = 0;
  for (const BodySize &body : bodies)
    sum += body.n_nodes;
  return sum;
}

/// Percent, signed; marked when it is beyond the tolerance.
std::string difference(int n_nodes, int table_one_nodes)
{
  return fmt::format("{}{:+.1f}", is_of_size(n_nodes, table_one_nodes) ? "" : "! ",
                     100.0 * (n_nodes - table_one_nodes) / table_one_nodes);
}

std::string sizes_known()
{
  std::string text;
  for (const TableOneColumn &column : table_one)
    text += fmt::format("{}{} ({})", text.empty() ? "" : " or ", column.n_nodes(), column.data_set);
  return text;
}
} // namespace

std::vector<BodySize> body_sizes(const dataset::RegistrationModel &model)
{
  std::vector<BodySize> sizes;
  for (const dataset::RegistrationBody &body : model.bodies)
    sizes.push_back({body.name, static_cast<int>(body.points.rows())});
  return sizes;
}

int table_one_nodes(const std::vector<BodySize> &bodies, const std::string &body)
{
  const TableOneColumn *column = table_one_column(sum_of(bodies));
  for (std::size_t i = 0; column && i < table_one_bodies.size(); ++i)
    if (table_one_bodies[i] == body)
      return column->nodes[i];
  return 0;
}

std::string node_table(const std::vector<BodySize> &bodies)
{
  const int sum = sum_of(bodies);
  const TableOneColumn *column = table_one_column(sum);
  std::string names = fmt::format("{:<{}}", "Registration, nodes", title_width),
              ours = fmt::format("{:<{}}", "this case", title_width),
              paper = fmt::format("{:<{}}", column ? fmt::format("Table 1, {}", column->data_set) : "", title_width),
              differences = fmt::format("{:<{}}", "difference, %", title_width);
  const auto add = [&](const std::string &name, int n_nodes, int wanted)
  {
    const std::size_t width = std::max(name.size() + 2, least_column);
    names += fmt::format("{:>{}}", name, width);
    ours += fmt::format("{:>{}}", n_nodes, width);
    paper += fmt::format("{:>{}}", wanted > 0 ? fmt::format("{}", wanted) : "-", width);
    differences += fmt::format("{:>{}}", wanted > 0 ? difference(n_nodes, wanted) : "-", width);
  };
  for (const BodySize &body : bodies)
    add(body.body, body.n_nodes, table_one_nodes(bodies, body.body));
  add("all", sum, column ? column->n_nodes() : 0);
  return names + "\n" + ours + "\n" +
         (column ? paper + "\n" + differences + "\n"
                 : fmt::format("not within 5 % of Table 1's {} nodes\n", sizes_known()));
}
} // namespace pelvireg::runner
