// The report's figures as files, for papers.
#pragma once

#include "validation/report/report.h"

#include <filesystem>
#include <string>
#include <vector>

namespace pelvireg::report
{
/// Names of the files that these conditions can have: error_by_step-LABEL.svg, error_by_slice-LABEL.svg and
/// image_plane-LABEL.svg.
std::vector<std::string> figure_file_names(const std::vector<std::string> &conditions);

/// Write them into `folder`, made when missing: each an SVG that stands alone, with its key. Condition `unregistered`
/// has no image_plane. Throws std::runtime_error when the disk refuses.
void write_figures(const ReportInputs &inputs, const std::filesystem::path &folder);
} // namespace pelvireg::report
