#include "validation/cli/markups.h"

#include "synthetic/dataset/error.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <set>

namespace pelvireg::cli
{
namespace
{
using nlohmann::json;

/// "Bladder-1" and "bladder.mrk" are of the bladder.
std::string first_word(const std::string &text)
{
  std::string word;
  for (const char character : text)
    if (std::isalpha(static_cast<unsigned char>(character)))
      word += static_cast<char>(std::tolower(static_cast<unsigned char>(character)));
    else if (!word.empty())
      break;
  return word;
}

std::string organ_of(const json &curve, const std::filesystem::path &file)
{
  const json &controls = curve.at("controlPoints");
  std::string label;
  if (!controls.empty() && controls.front().contains("label"))
    label = controls.front().at("label").get<std::string>();
  const std::vector<std::string> candidates = {curve.value("name", ""), label, file.filename().string()};
  for (const std::string &candidate : candidates)
  {
    const std::string word = first_word(candidate);
    if (std::find(dataset::organ_names.begin(), dataset::organ_names.end(), word) != dataset::organ_names.end())
      return word;
  }
  const auto named = std::find_if(candidates.begin(), candidates.end(), [](const auto &name) { return !name.empty(); });
  throw InputError(fmt::format("'{}': the curve '{}' is of no known organ; name it bladder, vagina, uterus or rectum",
                               file.string(), named == candidates.end() ? "" : *named));
}

dataset::Points points_of(const json &curve, const std::string &organ, const std::filesystem::path &file)
{
  if (curve.value("coordinateUnits", json("mm")) != json("mm"))
    throw InputError(fmt::format("'{}': the curve of {} is in {}, must be in mm; save it again in mm", file.string(),
                                 organ, curve.at("coordinateUnits").dump()));
  const json &controls = curve.at("controlPoints");
  if (controls.size() < 3)
    throw InputError(
        fmt::format("'{}': the curve of {} has {} points, at least 3 are needed; place more round the organ",
                    file.string(), organ, controls.size()));
  const double sign = curve.value("coordinateSystem", "LPS") == "RAS" ? -1 : 1;
  dataset::Points points(static_cast<Eigen::Index>(controls.size()), 3);
  for (std::size_t i = 0; i < controls.size(); ++i)
  {
    const auto position = controls[i].at("position").get<std::vector<double>>();
    if (position.size() != 3)
      throw InputError(fmt::format("'{}': point {} (0-based) of the curve of {} has {} coordinates, must be 3",
                                   file.string(), i, organ, position.size()));
    points.row(static_cast<Eigen::Index>(i)) << sign * position[0], sign * position[1], position[2];
  }
  return points;
}

std::vector<ClosedCurve> curves_of(const json &content, const std::filesystem::path &file)
{
  std::vector<ClosedCurve> curves;
  std::set<std::string> seen;
  for (const json &markup : content.at("markups"))
  {
    if (markup.at("type") != "ClosedCurve")
      continue;
    const std::string organ = organ_of(markup, file);
    if (!seen.insert(organ).second)
      throw InputError(fmt::format("'{}': {} has two curves, must have one; remove one of them", file.string(), organ));
    curves.push_back({organ, points_of(markup, organ, file)});
  }
  if (curves.empty())
    throw InputError(fmt::format("'{}' holds no closed curve; draw one closed curve an organ in 3D Slicer's Markups "
                                 "module and save it as .mrk.json",
                                 file.string()));
  return curves;
}
} // namespace

std::vector<ClosedCurve> read_curves(const std::filesystem::path &file)
{
  std::ifstream stream(file);
  if (!stream)
    throw InputError(fmt::format("'{}' cannot be read; give a .mrk.json file of 3D Slicer", file.string()));
  try
  {
    return curves_of(json::parse(stream), file);
  }
  catch (const json::exception &problem)
  {
    throw InputError(fmt::format("'{}' is not a markups file of 3D Slicer ({}); save the curves as .mrk.json",
                                 file.string(), problem.what()));
  }
}

std::string curves_text(const std::vector<ClosedCurve> &curves)
{
  json markups = json::array();
  for (const ClosedCurve &curve : curves)
  {
    json controls = json::array();
    for (Eigen::Index i = 0; i < curve.points.rows(); ++i)
      controls.push_back({{"id", std::to_string(i + 1)},
                          {"label", fmt::format("{}-{}", curve.organ, i + 1)},
                          {"position", {curve.points(i, 0), curve.points(i, 1), curve.points(i, 2)}},
                          {"selected", true},
                          {"locked", true},
                          {"visibility", true},
                          {"positionStatus", "defined"}});
    markups.push_back({{"type", "ClosedCurve"},
                       {"name", curve.organ},
                       {"coordinateSystem", "LPS"},
                       {"coordinateUnits", "mm"},
                       {"locked", true},
                       {"labelFormat", "%N-%d"},
                       {"controlPoints", controls},
                       {"display", {{"pointLabelsVisibility", false}}}});
  }
  const json content = {{"@schema", "https://raw.githubusercontent.com/slicer/slicer/master/Modules/Loadable/Markups/"
                                    "Resources/Schema/markups-schema-v1.0.3.json#"},
                        {"markups", markups}};
  return content.dump(1) + "\n";
}
} // namespace pelvireg::cli
