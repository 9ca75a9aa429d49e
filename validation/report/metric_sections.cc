#include "validation/report/metric_sections.h"

#include "synthetic/dataset/geometry.h"
#include "validation/report/condition_order.h"
#include "validation/report/html.h"
#include "validation/runner/aggregate.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <utility>
#include <vector>

namespace pelvireg::report
{
namespace
{
using dataset::organ_names;

/// A column: the figure's name in summary.json, its heading, its digits.
struct Column
{
  const char *figure;
  const char *heading;
  int digits;
};

const std::vector<Column> columns = {{"material_mean_mm", "material point, mean (mm)", 2},
                                     {"material_p95_mm", "95th percentile (mm)", 2},
                                     {"normal_mean_mm", "along the normal (mm)", 2},
                                     {"tangential_mean_mm", "along the surface (mm)", 2},
                                     {"symmetric_mean_mm", "symmetric distance (mm)", 2},
                                     {"hd95_mm", "HD95 (mm)", 2},
                                     {"dice", "Dice", 3},
                                     {"volume_change_percent", "volume change (%)", 2},
                                     {"truth_volume_change_percent", "of the truth (%)", 2},
                                     {"rotation_error_rad", "rotation error (rad)", 4}};

std::string figure_text(const runner::Evaluation &evaluation, const std::string &condition, const std::string &organ,
                        const Column &column)
{
  for (const runner::MetricFigure &figure : runner::metric_figures())
    if (std::string(figure.name) == column.figure)
      if (const auto value = runner::metric_at_last_step(evaluation, condition, organ, figure))
        return fmt::format("{:.{}f}", value->mean, column.digits);
  return "–";
}
} // namespace

std::string metrics_html(const runner::Evaluation &evaluation)
{
  return by_condition(evaluation,
                      [&](const std::string &condition)
                      {
                        std::vector<std::string> heading = {condition};
                        for (const Column &column : columns)
                          heading.emplace_back(column.heading);
                        std::vector<std::vector<std::string>> rows;
                        for (const std::string &organ : organ_names)
                        {
                          rows.push_back({organ});
                          for (const Column &column : columns)
                            rows.back().push_back(figure_text(evaluation, condition, organ, column));
                        }
                        return table(heading, rows);
                      });
}

std::string distance_tables_html(const runner::Evaluation &evaluation)
{
  const auto of_condition = [&](const std::string &condition)
  {
    std::vector<std::string> heading = {"offset of the slab's middle (mm)"};
    std::map<int, std::vector<std::string>> rows;
    for (std::size_t organ = 0; organ < organ_names.size(); ++organ)
    {
      heading.push_back(organ_names[organ]);
      for (const runner::DistanceAggregate &slab : runner::error_by_distance(evaluation, condition, organ_names[organ]))
      {
        auto &row = rows.try_emplace(slab.bin, std::vector<std::string>(organ_names.size() + 1, "–")).first->second;
        row[0] = fmt::format("{:+g}", slab.bin * evaluation.slice_pitch);
        row[organ + 1] = fmt::format("{:.2f} / {:.2f}", slab.surface.mean, slab.material.mean);
      }
    }
    std::vector<std::vector<std::string>> list;
    for (const auto &[bin, row] : rows)
      list.push_back(row);
    return details("Values, " + condition + ": surface / material point (mm)", table(heading, list));
  };
  return by_condition(evaluation, of_condition, "Values, other conditions");
}

std::string elements_html(const runner::Evaluation &evaluation)
{
  struct Worst
  {
    double smallest = std::numeric_limits<double>::infinity();
    int n_inverted = 0;
  };
  std::vector<std::string> bodies;
  std::map<std::string, std::map<std::string, Worst>> worst;
  for (const runner::BodyElements &run : evaluation.elements)
  {
    if (std::find(bodies.begin(), bodies.end(), run.body) == bodies.end())
      bodies.push_back(run.body);
    Worst &entry = worst[run.condition][run.body];
    entry.smallest = std::min(entry.smallest, run.jacobian.smallest);
    entry.n_inverted += run.jacobian.n_inverted;
  }
  if (worst.empty())
    return "<p>The estimates do not hold the nodes inside the organs: their elements cannot be judged.</p>\n";
  std::vector<std::string> heading = {"Smallest volume ratio J"};
  heading.insert(heading.end(), bodies.begin(), bodies.end());
  heading.emplace_back("inverted elements");
  std::vector<std::vector<std::string>> rows;
  for (const std::string &condition : reading_order(evaluation))
    if (worst.contains(condition))
    {
      std::vector<std::string> row = {condition};
      int n_inverted = 0;
      for (const std::string &body : bodies)
      {
        const auto entry = worst[condition].find(body);
        row.push_back(entry == worst[condition].end() ? "–" : fmt::format("{:.2f}", entry->second.smallest));
        n_inverted += entry == worst[condition].end() ? 0 : entry->second.n_inverted;
      }
      row.push_back(std::to_string(n_inverted));
      rows.push_back(row);
    }
  return table(heading, rows);
}

std::string penetrations_html(const runner::Evaluation &evaluation)
{
  std::vector<std::string> heading = {"Deepest penetration (mm), volume inside both (mm³)"};
  std::map<std::string, std::map<std::string, std::pair<double, double>>> worst;
  for (const runner::OrganPenetration &pair : evaluation.penetrations)
  {
    const std::string name = pair.organ_a + "–" + pair.organ_b + (pair.is_attached ? " (attached)" : "");
    auto &[deepest, volume] = worst[pair.condition][name];
    deepest = std::max(deepest, pair.deepest);
    volume = std::max(volume, pair.largest_volume);
    if (std::find(heading.begin(), heading.end(), name) == heading.end())
      heading.push_back(name);
  }
  std::vector<std::vector<std::string>> rows;
  for (const std::string &condition : reading_order(evaluation))
    if (worst.contains(condition))
    {
      std::vector<std::string> row = {condition};
      for (std::size_t i = 1; i < heading.size(); ++i)
        if (const auto entry = worst[condition].find(heading[i]); entry != worst[condition].end())
          row.push_back(fmt::format("{:.2f}, {:.0f}", entry->second.first, entry->second.second));
        else
          row.emplace_back("–");
      rows.push_back(row);
    }
  return rows.empty() ? "" : table(heading, rows);
}
} // namespace pelvireg::report
