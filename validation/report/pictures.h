// Off-screen stills of a result: rest anatomy, truth, estimate coloured by its error.
// VTK ends the process when it finds no X display, so pictures are always made in a child process.
#pragma once

#include "synthetic/dataset/anatomy.h"
#include "synthetic/dataset/estimate.h"
#include "synthetic/dataset/truth.h"

#include <filesystem>
#include <string>
#include <vector>

namespace pelvireg::report
{
/// One still: file name inside the pictures' folder, and what it shows.
struct Picture
{
  std::string file;    ///< "anatomy_oblique.png"
  std::string caption; ///< one sentence, plain text
};

/// Every still that can exist, in the order of the report. A still whose data do not exist is not written.
std::vector<Picture> picture_list();

/// Draw the stills into `folder` (made when missing). Needs a display: call it only in the child.
/// The error pictures use the estimate of condition "full", sample 0, last step; without it they are left out.
/// Throws std::runtime_error when a file cannot be written.
void render_pictures(const dataset::Anatomy &anatomy, const dataset::Truth &truth,
                     const std::vector<dataset::Estimate> &estimates, const std::filesystem::path &folder);

/// What `pelvireg render RESULT FOLDER` (hidden) does: load anatomy.h5, truth.h5 and what estimate-*.h5 there are,
/// then render_pictures().
void render_result(const std::filesystem::path &result, const std::filesystem::path &folder);

struct RenderOutcome
{
  bool ok = false;
  std::string message; ///< why there are no pictures, to follow "no pictures: "; empty when ok
};

/// Start `program render RESULT FOLDER` on an X server of its own (or on DISPLAY when Xvfb is missing) and wait, at
/// most `time_limit_s`; an empty `program` is the running one. Pictures of an earlier call are removed first. Never
/// throws and never ends the caller: a report without pictures is still a report.
RenderOutcome render_in_child(const std::filesystem::path &result, const std::filesystem::path &folder,
                              const std::filesystem::path &program = {}, double time_limit_s = 180);
} // namespace pelvireg::report
