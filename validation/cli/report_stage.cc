#include "validation/cli/stages.h"
#include "validation/cli/track_stage.h"
#include "validation/cli/version.h"
#include "validation/report/pictures.h"
#include "validation/report/report.h"

#include <fmt/format.h>

namespace pelvireg::cli
{
namespace
{
const std::string picture_folder = "pictures";

/// What made the result. It holds nothing of this call, so that the same result gives the same report.
std::vector<report::ProvenanceEntry> provenance_of(const Manifest &manifest)
{
  std::vector<report::ProvenanceEntry> entries = {
      {"program", fmt::format("pelvireg {}, revision {}, {}", version(), revision(), build())}};
  for (const std::string &name : stage_order())
  {
    const auto stage = manifest.stages.find(name);
    if (stage == manifest.stages.end() || name == "report")
      continue;
    entries.push_back({name, fmt::format("{:.1f} s, '{}', revision {}", stage->second.seconds,
                                         stage->second.command_line, stage->second.revision)});
    for (const auto &[file, digest] : stage->second.outputs)
      entries.push_back({"SHA-256 of " + file, digest});
  }
  return entries;
}

std::vector<std::string> picture_files()
{
  std::vector<std::string> files;
  for (const report::Picture &picture : report::picture_list())
    files.push_back(picture_folder + "/" + picture.file);
  return files;
}

std::vector<report::ReportPicture> draw_pictures(const ResultDirectory &directory, Progress &progress)
{
  progress.update(0.3, "drawing the pictures");
  const report::RenderOutcome outcome = report::render_in_child(directory.path(), directory.path() / picture_folder);
  if (!outcome.ok)
    progress.say("no pictures: " + outcome.message);
  std::vector<report::ReportPicture> pictures;
  for (const report::Picture &picture : report::picture_list())
    pictures.push_back({directory.path() / picture_folder / picture.file, picture.caption});
  if (directory.has(tracked_picture))
    pictures.push_back(
        {directory.path() / tracked_picture,
         "Dynamic images at rest, after a third and two thirds of the motion and at its end, with tracked "
         "(solid) and true (dashed) outlines."});
  return pictures;
}
} // namespace

void make_report(ResultDirectory &directory, Judge &judge)
{
  const std::vector<report::ProvenanceEntry> provenance = provenance_of(directory.manifest());
  std::string options;
  for (const report::ProvenanceEntry &entry : provenance)
    options += entry.name + " " + entry.value + "\n";
  std::vector<std::string> inputs = {"anatomy.h5", "truth.h5", "summary.json"};
  for (const std::string &estimate : estimate_files(directory))
    inputs.push_back(estimate);
  if (directory.has(tracked_picture))
    inputs.push_back(tracked_picture);
  directory.run({.name = "report",
                 .code = {"validation/metrics", "validation/runner", "validation/report", "synthetic/dataset"},
                 .options = options,
                 .inputs = inputs,
                 .outputs = {"report.html"},
                 .optional_outputs = picture_files(),
                 .work = [&](Progress &progress) -> Notes
                 {
                   const Judgement &judgement = judge.of(directory, progress);
                   report::write_report({.evaluation = judgement.evaluation,
                                         .anatomy = judgement.anatomy,
                                         .truth = judgement.truth,
                                         .estimates = judgement.estimates,
                                         .timings = recorded_timings(directory),
                                         .pictures = draw_pictures(directory, progress),
                                         .provenance = provenance},
                                        directory.path() / "report.html");
                   return {};
                 }});
}
} // namespace pelvireg::cli
