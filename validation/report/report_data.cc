#include "validation/report/report_data.h"

#include "validation/report/condition_order.h"
#include "validation/report/payload.h"
#include "validation/report/view_data.h"
#include "validation/runner/aggregate.h"
#include "validation/runner/result_files.h"

#include <nlohmann/json.hpp>

#include <cstddef>

namespace pelvireg::report
{
namespace
{
using dataset::organ_names;
using json = nlohmann::ordered_json;

json numbers(const Eigen::Vector3d &v)
{
  return {v.x(), v.y(), v.z()};
}

json conditions_json(const ReportInputs &inputs, const std::vector<ConditionSurfaces> &conditions)
{
  json list = json::array();
  for (const std::string &name : reading_order(inputs.evaluation))
  {
    json nominal = nullptr; // place in the list of those with a nominal run
    for (std::size_t i = 0; i < conditions.size(); ++i)
      if (conditions[i].condition == name)
        nominal = i;
    list.push_back({{"name", name}, {"title", condition_title(name)}, {"nominal", nominal}});
  }
  return list;
}

/// Figures of metrics_by_step.csv at each position's last step, mean and standard deviation over the runs.
json metrics_json(const runner::Evaluation &evaluation)
{
  json result;
  for (const std::string &condition : evaluation.conditions)
    for (const std::string &organ : organ_names)
      for (const runner::MetricFigure &figure : runner::metric_figures())
      {
        json mean = json::array(), sd = json::array(), n_runs = json::array();
        for (const runner::Aggregate &value : runner::metric_by_position(evaluation, condition, organ, figure))
        {
          mean.push_back(value.mean);
          sd.push_back(value.sd);
          n_runs.push_back(value.n_runs);
        }
        result[condition][organ][figure.name] = {{"mean", mean}, {"sd", sd}, {"n_runs", n_runs}};
      }
  return result;
}

json slices_json(const SliceDrawing &drawing)
{
  json list = json::array();
  for (const SliceContours &slice : drawing.slices)
    list.push_back({{"index", slice.index}, {"estimates", slice.estimates}});
  return list;
}

json worst_json(const std::vector<WorstPlace> &worst)
{
  json list = json::array();
  for (const WorstPlace &place : worst)
    list.push_back({{"condition", place.condition},
                    {"organ", place.organ},
                    {"error_mm", place.error},
                    {"position_mm", numbers(place.position)},
                    {"offset_mm", place.offset}});
  return list;
}
} // namespace

std::string report_data(const ReportInputs &inputs, const std::vector<MovingSurface> &truth,
                        const std::vector<ConditionSurfaces> &conditions, const SliceDrawing &slices,
                        const std::vector<WorstPlace> &worst)
{
  const runner::Evaluation &evaluation = inputs.evaluation;
  Payload payload;
  payload.add("summary.json", runner::summary_json(evaluation, inputs.timings));
  payload.add("curves_by_step.csv", runner::curves_by_step_csv(evaluation));
  payload.add("curves_by_slice.csv", runner::curves_by_slice_csv(evaluation));
  json model = {{"case", evaluation.case_name},
                {"organs", organ_names},
                {"steps", evaluation.n_steps()},
                {"steps_per_increment", evaluation.steps_per_increment},
                {"slices_each_side", evaluation.n_slices_each_side},
                {"slice_pitch_mm", evaluation.slice_pitch},
                {"conditions", conditions_json(inputs, conditions)},
                {"metrics", metrics_json(evaluation)},
                {"slices", slices_json(slices)},
                {"worst", worst_json(worst)},
                {"view", view_data(inputs, truth, conditions, payload)}};
  return payload.encoded(model);
}
} // namespace pelvireg::report
