#include "tests/judge/result_directory.h"

#include "synthetic/dataset/store.h"
#include "validation/cli/sha256.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cstdlib>
#include <fstream>
#include <stdexcept>

namespace pelvireg::test
{
namespace
{
using nlohmann::json;
namespace fs = std::filesystem;

std::string csv(const regression::ErrorResult &result, regression::Axis axis)
{
  const bool is_slice = axis == regression::Axis::slice;
  std::string text = is_slice ? "condition,sample,organ,slice_index,offset_mm,n_points,mean_mm,sd_mm,p95_mm,max_mm\n"
                              : "condition,sample,organ,step,n_points,mean_mm,sd_mm,p95_mm,max_mm\n";
  for (const auto &[name, family] : result.curves)
    if (name.axis == axis)
      for (const auto &[sample, curve] : family)
        for (const regression::CurvePoint &point : curve)
          text += fmt::format("{},{},{},{},{}{},{:.9g},{:.9g},{:.9g},{:.9g}\n", name.condition, sample, name.organ,
                              point.abscissa, is_slice ? fmt::format("{:.9g},", point.offset) : "", point.n_points,
                              point.mean, point.sd, point.p95, point.max);
  return text;
}

std::string summary(const regression::ErrorResult &result)
{
  json content = {{"format", "pelvireg summary"},
                  {"format_version", dataset::store_format_version},
                  {"units", "mm"},
                  {"case", result.case_name},
                  {"surface_spacing_mm", result.surface_spacing},
                  {"contour_spacing_mm", result.contour_spacing},
                  {"runs", json::array()}};
  for (const auto &[run, steps] : result.runs)
    content["runs"].push_back({{"condition", run.first},
                               {"sample", run.second},
                               {"n_steps", steps.n_steps},
                               {"n_failed_steps", steps.n_failed}});
  return content.dump(2) + "\n";
}

std::string content_of(const fs::path &file)
{
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}
} // namespace

void write_result(const regression::ErrorResult &result, const fs::path &directory)
{
  fs::create_directories(directory);
  const std::map<std::string, std::string> files = {{"case.toml", result.case_text},
                                                    {"errors_by_step.csv", csv(result, regression::Axis::step)},
                                                    {"errors_by_slice.csv", csv(result, regression::Axis::slice)},
                                                    {"summary.json", summary(result)}};
  const std::string estimate(64, 'e');
  json manifest = {{"format", "pelvireg manifest"},
                   {"format_version", dataset::store_format_version},
                   {"units", dataset::store_units},
                   {"frame", dataset::store_frame},
                   {"program", {{"build", "by hand"}}},
                   {"files", {{"estimate-full.h5", {{"sha256", estimate}}}}},
                   {"stages",
                    {{"evaluate",
                      {{"command_line", "pelvireg evaluate"},
                       {"revision", "0123456789ab"},
                       {"inputs", {{"estimate-full.h5", estimate}}}}}}}};
  for (const auto &[name, text] : files)
  {
    std::ofstream(directory / name, std::ios::binary) << text;
    manifest["files"][name] = {{"sha256", cli::sha256_of_text(text)}};
  }
  std::ofstream(directory / "manifest.json") << manifest.dump(2);
}

void edit(const fs::path &file, const std::string &pattern, const std::string &replacement, bool in_manifest)
{
  const std::string before = content_of(file);
  const std::size_t place = before.find(pattern);
  if (place == std::string::npos)
    throw std::logic_error("'" + file.string() + "' has no '" + pattern + "'");
  const std::string after = std::string(before).replace(place, pattern.size(), replacement);
  std::ofstream(file, std::ios::binary) << after;
  if (in_manifest)
    edit(file.parent_path() / "manifest.json", cli::sha256_of_text(before), cli::sha256_of_text(after));
}
} // namespace pelvireg::test
