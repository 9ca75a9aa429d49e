#include "validation/runner/result_files.h"

#include "synthetic/dataset/geometry.h"
#include "validation/runner/aggregate.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <unistd.h>

namespace pelvireg::runner
{
namespace
{
std::string statistics_fields(const metrics::Statistics &distance)
{
  return fmt::format("{},{:.9g},{:.9g},{:.9g},{:.9g}\n", distance.n, distance.mean, distance.sd, distance.p95,
                     distance.max);
}
} // namespace

std::string errors_by_step_csv(const Evaluation &evaluation)
{
  std::string text = "condition,sample,organ,step,n_points,mean_mm,sd_mm,p95_mm,max_mm\n";
  for (const StepError &row : evaluation.by_step)
    text +=
        fmt::format("{},{},{},{},", row.condition, row.sample, row.organ, row.step) + statistics_fields(row.distance);
  return text;
}

std::string errors_by_slice_csv(const Evaluation &evaluation)
{
  std::string text = "condition,sample,organ,slice_index,offset_mm,n_points,mean_mm,sd_mm,p95_mm,max_mm\n";
  for (const SliceError &row : evaluation.by_slice)
    text += fmt::format("{},{},{},{},{:.9g},", row.condition, row.sample, row.organ, row.slice_index, row.offset) +
            statistics_fields(row.distance);
  return text;
}

std::string metrics_by_step_csv(const Evaluation &evaluation)
{
  std::string text = "condition,sample,organ,step,n_points";
  for (const MetricFigure &figure : metric_figures())
    text += fmt::format(",{}", figure.name);
  text += "\n";
  for (const StepMetrics &row : evaluation.metrics_by_step)
  {
    text += fmt::format("{},{},{},{},{}", row.condition, row.sample, row.organ, row.step, row.material.distance.n);
    for (const MetricFigure &figure : metric_figures())
      text += fmt::format(",{:.9g}", figure.value(row));
    text += "\n";
  }
  return text;
}

std::string errors_by_distance_csv(const Evaluation &evaluation)
{
  std::string text = "condition,sample,organ,offset_from_mm,offset_to_mm,n_points,mean_mm,sd_mm,p95_mm,max_mm,"
                     "material_mean_mm\n";
  for (const DistanceError &row : evaluation.by_distance)
    text += fmt::format("{},{},{},{:.9g},{:.9g},{},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g}\n", row.condition, row.sample,
                        row.organ, (row.bin - 0.5) * evaluation.slice_pitch, (row.bin + 0.5) * evaluation.slice_pitch,
                        row.distance.n, row.distance.mean, row.distance.sd, row.distance.p95, row.distance.max,
                        row.material_mean);
  return text;
}

std::string curves_by_step_csv(const Evaluation &evaluation)
{
  std::string text = "condition,organ,step,n_runs,mean_mm,sd_mm\n";
  for (const std::string &condition : evaluation.conditions)
    for (const std::string &organ : dataset::organ_names)
    {
      int step = 0;
      for (const Aggregate &value : error_by_step(evaluation, condition, organ))
        text +=
            fmt::format("{},{},{},{},{:.9g},{:.9g}\n", condition, organ, ++step, value.n_runs, value.mean, value.sd);
    }
  return text;
}

std::string curves_by_slice_csv(const Evaluation &evaluation)
{
  std::string text = "condition,organ,slice_index,offset_mm,n_runs,mean_mm,sd_mm\n";
  for (const std::string &condition : evaluation.conditions)
    for (const std::string &organ : dataset::organ_names)
    {
      int slice = -evaluation.n_slices_each_side;
      for (const std::optional<Aggregate> &value : error_by_slice(evaluation, condition, organ))
      {
        if (value)
          text += fmt::format("{},{},{},{:.9g},{},{:.9g},{:.9g}\n", condition, organ, slice,
                              slice * evaluation.slice_pitch, value->n_runs, value->mean, value->sd);
        ++slice;
      }
    }
  return text;
}

void write_text_file(const std::filesystem::path &file, const std::string &text)
{
  const std::filesystem::path temporary = file.string() + ".tmp" + std::to_string(::getpid());
  std::FILE *stream = std::fopen(temporary.c_str(), "wb");
  const bool written = stream && std::fwrite(text.data(), 1, text.size(), stream) == text.size() &&
                       std::fflush(stream) == 0 && ::fsync(::fileno(stream)) == 0;
  const int error = errno;
  const bool closed = stream && std::fclose(stream) == 0;
  if (!written || !closed || std::rename(temporary.c_str(), file.c_str()) != 0)
  {
    std::remove(temporary.c_str());
    throw std::runtime_error(fmt::format("cannot write {}: {}", file.string(), std::strerror(error)));
  }
}

void write_result_files(const Evaluation &evaluation, const std::vector<StepTiming> &timings,
                        const std::filesystem::path &directory)
{
  write_text_file(directory / "errors_by_step.csv", errors_by_step_csv(evaluation));
  write_text_file(directory / "errors_by_slice.csv", errors_by_slice_csv(evaluation));
  write_text_file(directory / "metrics_by_step.csv", metrics_by_step_csv(evaluation));
  write_text_file(directory / "errors_by_distance.csv", errors_by_distance_csv(evaluation));
  write_text_file(directory / "curves_by_step.csv", curves_by_step_csv(evaluation));
  write_text_file(directory / "curves_by_slice.csv", curves_by_slice_csv(evaluation));
  write_text_file(directory / "summary.json", summary_json(evaluation, timings));
}
} // namespace pelvireg::runner
