// The stages of the chain, each from files to files in one result directory.
#pragma once

#include "validation/cli/stage_cache.h"
#include "validation/runner/evaluate.h"
#include "validation/runner/register.h"

#include <optional>
#include <string>
#include <vector>

namespace pelvireg::cli
{
/// case.toml, anatomy.h5. `text` is the case file's content.
void make_anatomy(ResultDirectory &directory, const std::string &case_name, const std::string &text);
/// truth.h5. Every step and iteration of the solver becomes a line of `log_file`, when it is not empty. `elsewhere`: a
/// result directory that may hold it already.
void make_truth(ResultDirectory &directory, int jobs, const std::string &log_file = {},
                const std::filesystem::path &elsewhere = {});
/// observations.h5
void make_observations(ResultDirectory &directory);
/// Everything in the directory, judged.
struct Judgement
{
  dataset::Anatomy anatomy;
  dataset::Truth truth;
  std::vector<dataset::Estimate> nominal_runs; ///< of every estimate, for the pictures of it
  runner::Evaluation evaluation;
};

/// Judges a directory when it is first asked to, and keeps the judgement: evaluate and report, in one process with no
/// other stage between them, judge once.
class Judge
{
public:
  explicit Judge(int jobs) : jobs_(jobs) {}
  const Judgement &of(const ResultDirectory &directory, Progress &progress);

private:
  int jobs_;
  std::optional<Judgement> judgement_;
};

/// errors_by_*.csv, curves_by_*.csv, summary.json, error_table.txt, condition_table.txt, from every estimate in the
/// directory
void make_errors(ResultDirectory &directory, Judge &judge);
/// report.html, pictures/*.png, figures/*.svg
void make_report(ResultDirectory &directory, Judge &judge);
/// summary.pdf. Throws InputError when there is no Chromium to print it.
void make_summary_pdf(ResultDirectory &directory, Judge &judge);

/// Step times of the estimates in the directory, as their register stages noted them.
std::vector<runner::StepTiming> recorded_timings(const ResultDirectory &directory);

/// Names of the stages in the order in which they run.
std::vector<std::string> stage_order();

/// File names of the estimates in the directory, sorted.
std::vector<std::string> estimate_files(const ResultDirectory &directory);
} // namespace pelvireg::cli
