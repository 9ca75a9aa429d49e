#include "validation/cli/manifest.h"

#include "synthetic/dataset/atomic_file.h"
#include "synthetic/dataset/error.h"
#include "synthetic/dataset/store.h"
#include "validation/cli/version.h"

#include <nlohmann/json.hpp>

#include <fstream>

namespace pelvireg::cli
{
namespace
{
using nlohmann::json;
constexpr const char *file_name = "manifest.json";
constexpr const char *format = "pelvireg manifest";

json to_json(const StageRecord &record)
{
  return {{"key", record.key},
          {"inputs", record.inputs},
          {"outputs", record.outputs},
          {"seconds", record.seconds},
          {"command_line", record.command_line},
          {"revision", record.revision},
          {"notes", record.notes}};
}

StageRecord stage_from(const json &entry)
{
  return {.key = entry.at("key"),
          .inputs = entry.at("inputs"),
          .outputs = entry.at("outputs"),
          .seconds = entry.at("seconds"),
          .command_line = entry.at("command_line"),
          .revision = entry.at("revision"),
          .notes = entry.at("notes")};
}
} // namespace

const StageRecord *Manifest::maker_of(const std::string &file, std::string *stage_name) const
{
  for (const auto &[name, record] : stages)
    if (record.outputs.contains(file))
    {
      if (stage_name)
        *stage_name = name;
      return &record;
    }
  return nullptr;
}

void Manifest::forget(const std::string &file)
{
  std::erase_if(stages, [&](const auto &stage) { return stage.second.outputs.contains(file); });
}

Manifest load_manifest(const std::filesystem::path &directory)
{
  const std::filesystem::path file = directory / file_name;
  if (!std::filesystem::exists(file))
    return {};
  try
  {
    std::ifstream in(file);
    const json content = json::parse(in);
    if (content.at("format") != format || content.at("format_version") != dataset::store_format_version)
      throw InputError("'" + file.string() + "' is not a manifest of this version; give an empty directory");
    Manifest manifest;
    for (const auto &[name, entry] : content.at("stages").items())
      manifest.stages[name] = stage_from(entry);
    return manifest;
  }
  catch (const json::exception &error)
  {
    throw InputError("'" + file.string() + "' is damaged; remove it and run the stages again");
  }
}

void save_manifest(const Manifest &manifest, const std::filesystem::path &directory)
{
  json stages = json::object(), files = json::object();
  for (const auto &[name, record] : manifest.stages)
  {
    stages[name] = to_json(record);
    for (const auto &[output, digest] : record.outputs)
      files[output] = {{"sha256", digest}, {"stage", name}};
  }
  const json content = {{"format", format},
                        {"format_version", dataset::store_format_version},
                        {"units", dataset::store_units},
                        {"frame", dataset::store_frame},
                        {"program", {{"name", "pelvireg"}, {"version", version()}, {"build", build()}}},
                        {"stages", stages},
                        {"files", files}};
  dataset::write_text_file(directory / file_name, content.dump(2) + "\n");
}
} // namespace pelvireg::cli
