#include "validation/cli/stages.h"
#include "validation/cli/track_stage.h"
#include "validation/cli/version.h"
#include "validation/regression/result.h"
#include "validation/report/figure_files.h"
#include "validation/report/jpeg.h"
#include "validation/report/pictures.h"
#include "validation/report/print_pdf.h"
#include "validation/report/report.h"
#include "validation/report/summary_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

namespace pelvireg::cli
{
namespace
{
const std::string picture_folder = "pictures", figure_folder = "figures";

/// The stages of the chain as they are recorded, in order, without the report itself.
std::vector<std::pair<std::string, StageRecord>> recorded_stages(const Manifest &manifest)
{
  std::vector<std::pair<std::string, StageRecord>> stages;
  for (const std::string &name : stage_order())
    if (const auto stage = manifest.stages.find(name); stage != manifest.stages.end() && name != "report")
      stages.emplace_back(name, stage->second);
  return stages;
}

/// The command lines behind the stages, each once.
std::vector<std::string> commands_of(const Manifest &manifest)
{
  std::vector<std::string> commands;
  for (const auto &[name, stage] : recorded_stages(manifest))
    if (std::find(commands.begin(), commands.end(), stage.command_line) == commands.end())
      commands.push_back(stage.command_line);
  return commands;
}

/// What made the result. It holds nothing of this call, so that the same result gives the same report.
std::vector<report::ProvenanceEntry> provenance_of(const Manifest &manifest)
{
  std::vector<report::ProvenanceEntry> entries = {
      {"program", fmt::format("pelvireg {}, revision {}, {}", version(), revision(), build())}};
  const bool one_command = commands_of(manifest).size() == 1; // which the page shows by itself
  for (const auto &[name, stage] : recorded_stages(manifest))
  {
    entries.push_back({name, fmt::format("{:.1f} s, {}revision {}", stage.seconds,
                                         one_command ? "" : "'" + stage.command_line + "', ", stage.revision)});
    for (const auto &[file, digest] : stage.outputs)
      entries.push_back({"SHA-256 of " + file, digest});
  }
  return entries;
}

std::vector<report::StageTime> times_of(const Manifest &manifest)
{
  std::vector<report::StageTime> times;
  for (const auto &[name, stage] : recorded_stages(manifest))
    times.push_back({name, stage.seconds});
  return times;
}

std::optional<dataset::Observations> observations_of(const ResultDirectory &directory)
{
  if (!directory.has("observations.h5"))
    return std::nullopt;
  return dataset::load_observations(directory.path() / "observations.h5");
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
    pictures.push_back({report::jpeg_of_png(directory.path() / picture_folder / picture.file), picture.caption});
  return pictures;
}

const std::vector<std::string> tracking_files = {tracked_picture, contour_error_figure, "contour_table.txt"};

std::optional<report::TrackingResult> tracking_of(const ResultDirectory &directory)
{
  for (const std::string &file : tracking_files)
    if (!directory.has(file))
      return std::nullopt;
  const auto text_of = [&](const std::string &file)
  { return regression::read_text(directory.path() / file, "run 'pelvireg track' again"); };
  return report::TrackingResult{report::jpeg_of_png(directory.path() / tracked_picture), text_of(contour_error_figure),
                                text_of("contour_table.txt"), tracking_cost_table(directory)};
}

/// What both stages read.
std::vector<std::string> inputs_of(const ResultDirectory &directory)
{
  std::vector<std::string> inputs = {"anatomy.h5", "truth.h5", "summary.json"};
  for (const std::string &estimate : estimate_files(directory))
    inputs.push_back(estimate);
  if (directory.has("observations.h5"))
    inputs.push_back("observations.h5");
  for (const std::string &file : tracking_files)
    if (directory.has(file))
      inputs.push_back(file);
  return inputs;
}

std::string options_of(const std::vector<report::ProvenanceEntry> &provenance)
{
  std::string options;
  for (const report::ProvenanceEntry &entry : provenance)
    options += entry.name + " " + entry.value + "\n";
  return options;
}

/// figures/*.svg that the estimates in the directory can have.
std::vector<std::string> figure_files(const ResultDirectory &directory)
{
  std::vector<std::string> conditions = {runner::unregistered};
  for (const std::string &file : estimate_files(directory))
    conditions.push_back(
        file.substr(std::string("estimate-").size(), file.size() - std::string("estimate-.h5").size()));
  std::vector<std::string> files;
  for (const std::string &name : report::figure_file_names(conditions))
    files.push_back(figure_folder + "/" + name);
  return files;
}

report::ReportInputs report_inputs(const ResultDirectory &directory, const Judgement &judgement,
                                   const std::optional<dataset::Observations> &observations)
{
  return {.evaluation = judgement.evaluation,
          .anatomy = judgement.anatomy,
          .truth = judgement.truth,
          .estimates = judgement.nominal_runs,
          .timings = recorded_timings(directory),
          .pictures = {},
          .provenance = provenance_of(directory.manifest()),
          .stages = times_of(directory.manifest()),
          .commands = commands_of(directory.manifest()),
          .observations = observations ? &*observations : nullptr,
          .tracking = tracking_of(directory)};
}

const std::vector<std::string> code_of_report = {"validation/metrics", "validation/runner", "validation/report",
                                                 "synthetic/dataset"};
} // namespace

void make_report(ResultDirectory &directory, Judge &judge)
{
  std::vector<std::string> optional_outputs = picture_files();
  for (const std::string &figure : figure_files(directory))
    optional_outputs.push_back(figure);
  directory.run({.name = "report",
                 .code = code_of_report,
                 .options = options_of(provenance_of(directory.manifest())),
                 .inputs = inputs_of(directory),
                 .outputs = {"report.html"},
                 .optional_outputs = optional_outputs,
                 .work = [&](Progress &progress) -> Notes
                 {
                   const auto observations = observations_of(directory);
                   report::ReportInputs inputs = report_inputs(directory, judge.of(directory, progress), observations);
                   inputs.pictures = draw_pictures(directory, progress);
                   report::write_figures(inputs, directory.path() / figure_folder);
                   report::write_report(inputs, directory.path() / "report.html");
                   return {};
                 }});
}

void make_summary_pdf(ResultDirectory &directory, Judge &judge)
{
  directory.run({.name = "report pdf",
                 .code = code_of_report,
                 .options = options_of(provenance_of(directory.manifest())),
                 .inputs = inputs_of(directory),
                 .outputs = {"summary.pdf"},
                 .work = [&](Progress &progress) -> Notes
                 {
                   const auto observations = observations_of(directory);
                   const std::string page =
                       report::summary_page_html(report_inputs(directory, judge.of(directory, progress), observations));
                   progress.update(0.6, "printing");
                   report::print_pdf(page, directory.path() / "summary.pdf");
                   return {};
                 }});
}
} // namespace pelvireg::cli
