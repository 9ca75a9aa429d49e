// errors_by_*.csv, curves_by_*.csv and summary.json (DESIGN 4; docs/result_format.md).
#pragma once

#include "validation/runner/evaluate.h"
#include "validation/runner/register.h"

#include <filesystem>
#include <string>
#include <vector>

namespace pelvireg::runner
{
/// Content of the two CSV files: header line, one row a (condition, sample, organ, step or slice), nine significant
/// digits, the same bytes on every run. A slice that misses the organ in truth or estimate has no row.
std::string errors_by_step_csv(const Evaluation &evaluation);
std::string errors_by_slice_csv(const Evaluation &evaluation);

/// Content of metrics_by_step.csv: one row a (condition, sample, organ, last step of a position), the figures of
/// metric_figures() as columns. Of errors_by_distance.csv: one row a (condition, sample, organ, slab that holds a
/// sample).
std::string metrics_by_step_csv(const Evaluation &evaluation);
std::string errors_by_distance_csv(const Evaluation &evaluation);

/// Content of curves_by_step.csv and curves_by_slice.csv: mean and standard deviation over the runs of what the two
/// files above hold run by run (aggregate.h), one row a (condition, organ, step or slice).
std::string curves_by_step_csv(const Evaluation &evaluation);
std::string curves_by_slice_csv(const Evaluation &evaluation);

/// Content of summary.json: figures by organ and condition, aggregates over the runs, motion of the truth, quality of
/// the runs, timing when given, verdicts on the paper's claims.
std::string summary_json(const Evaluation &evaluation, const std::vector<StepTiming> &timings = {});

/// Write all of them into `directory`, each to a temporary name and renamed. Throws std::runtime_error when the disk
/// refuses.
void write_result_files(const Evaluation &evaluation, const std::vector<StepTiming> &timings,
                        const std::filesystem::path &directory);

/// Write text to a temporary name beside `file`, fsync, rename. Throws std::runtime_error when the disk refuses.
void write_text_file(const std::filesystem::path &file, const std::string &text);
} // namespace pelvireg::runner
