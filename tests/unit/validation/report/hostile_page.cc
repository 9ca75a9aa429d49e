// Writes the page of a case whose name, source and provenance would run a script if they were taken for HTML:
// hostile_page FILE
#include "tests/unit/validation/fixtures/sphere_case.h"
#include "validation/report/report.h"

#include <string>

int main(int argc, char **argv)
{
  using namespace pelvireg;
  if (argc != 2)
    return 2;
  const std::string name = "</script><script>window.caught = 1</script><img src=x onerror=\"window.caught = 2\">'\"&";
  const Eigen::Vector3d translation(2, 5, -6);
  dataset::Anatomy anatomy = test::sphere_anatomy();
  dataset::Truth truth = test::sphere_truth(translation);
  std::vector<dataset::Estimate> estimates = {test::sphere_estimate("full", translation, 0.9)};
  anatomy.case_name = truth.case_name = estimates[0].case_name = truth.source = name;
  const runner::Evaluation evaluation = runner::evaluate(anatomy, truth, estimates);
  report::write_report({.evaluation = evaluation,
                        .anatomy = anatomy,
                        .truth = truth,
                        .estimates = estimates,
                        .timings = {{.condition = name, .n_steps = 1, .mean_ms = 1, .phases = {{name, 1.0}}}},
                        .pictures = {},
                        .provenance = {{name, name}},
                        .stages = {{name, 1.0}},
                        .commands = {name}},
                       argv[1]);
}
