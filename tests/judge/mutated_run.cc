#include "tests/judge/mutated_run.h"

#include "validation/runner/evaluate.h"
#include "validation/runner/register.h"
#include "validation/runner/result_files.h"

namespace pelvireg::test
{
MutatedRun::MutatedRun(const std::filesystem::path &result_directory)
    : anatomy_(dataset::load_anatomy(result_directory / "anatomy.h5")),
      truth_(dataset::load_truth(result_directory / "truth.h5")),
      observations_(dataset::load_observations(result_directory / "observations.h5")),
      case_text_(regression::read_text(result_directory / "case.toml", "run the case first"))
{
}

regression::ErrorResult MutatedRun::play(const registration::Mutation &mutation, int n_samples) const
{
  runner::RunnerOptions options;
  options.samples = n_samples;
  options.mutation = &mutation;
  std::vector<dataset::Estimate> estimates;
  for (const std::string &condition : runner::default_conditions())
    estimates.push_back(runner::run_registration(anatomy_, observations_, condition, options));
  const runner::Evaluation evaluation = runner::evaluate(anatomy_, truth_, estimates);

  regression::ErrorResult result;
  result.label = "a mutated registration";
  result.case_name = evaluation.case_name;
  result.case_text = case_text_;
  result.surface_spacing = evaluation.options.surface_spacing;
  result.contour_spacing = evaluation.options.contour_spacing;
  result.curves = regression::read_curves(runner::errors_by_step_csv(evaluation), regression::Axis::step, "by step");
  result.curves.merge(
      regression::read_curves(runner::errors_by_slice_csv(evaluation), regression::Axis::slice, "by slice"));
  for (const runner::RunQuality &run : evaluation.quality)
    result.runs[{run.condition, run.sample}] = {run.n_steps, run.n_failed_steps};
  return result;
}
} // namespace pelvireg::test
