// report.html: what the evaluation found, for people. One file, no network; whole without its script.
#pragma once

#include "synthetic/dataset/anatomy.h"
#include "synthetic/dataset/estimate.h"
#include "synthetic/dataset/observations.h"
#include "synthetic/dataset/truth.h"
#include "validation/runner/evaluate.h"
#include "validation/runner/register.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace pelvireg::report
{
/// A still to show: the bytes of a JPEG, none when there is no picture, and one sentence on what it shows.
struct ReportPicture
{
  std::string jpeg;
  std::string caption;
};

/// What the tracker did with the images, of a result that has any.
struct TrackingResult
{
  std::string frames_jpeg;   ///< frames with tracked and true outlines
  std::string error_figure;  ///< SVG: contour error by organ and frame
  std::string contour_table; ///< plain text: contour error by tracker and organ
  std::string cost_table;    ///< plain text: the registration's error with exact and with tracked outlines, or empty
};

/// One line of the provenance table: program version, command line, SHA-256 of a file, …
struct ProvenanceEntry
{
  std::string name;
  std::string value;
};

/// How long a stage of the chain took.
struct StageTime
{
  std::string name;
  double seconds = 0;
};

/// Everything that the report shows. The references must outlive the call. Of each estimate the nominal run (sample 0)
/// is drawn.
struct ReportInputs
{
  const runner::Evaluation &evaluation;
  const dataset::Anatomy &anatomy;
  const dataset::Truth &truth;
  const std::vector<dataset::Estimate> &estimates;
  std::vector<runner::StepTiming> timings;
  std::vector<ReportPicture> pictures;
  std::vector<ProvenanceEntry> provenance;
  std::vector<StageTime> stages = {};
  std::vector<std::string> commands = {};              ///< that make the result again
  const dataset::Observations *observations = nullptr; ///< control points of the 3-D view, when known
  std::optional<TrackingResult> tracking = {};
};

/// The page as text. The same inputs give the same bytes; every string is escaped.
std::string report_html(const ReportInputs &inputs);

/// Write the page to a temporary name and rename it. Throws std::runtime_error when the disk refuses.
void write_report(const ReportInputs &inputs, const std::filesystem::path &file);
} // namespace pelvireg::report
