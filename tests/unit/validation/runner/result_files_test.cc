#include "validation/runner/result_files.h"

#include "tests/unit/validation/fixtures/sphere_case.h"
#include "validation/runner/claims.h"
#include "validation/runner/error_table.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace pelvireg::runner
{
namespace
{
const Eigen::Vector3d translation(2, 5, -6);

Evaluation judged()
{
  return evaluate(test::sphere_anatomy(), test::sphere_truth(translation),
                  {test::sphere_estimate("full", translation, 0.9)});
}

TEST(ResultFiles, CsvHeadersAreThoseOfTheContract)
{
  const Evaluation evaluation = judged();
  const std::string by_step = errors_by_step_csv(evaluation), by_slice = errors_by_slice_csv(evaluation);
  EXPECT_EQ(by_step.substr(0, by_step.find('\n')), "condition,sample,organ,step,n_points,mean_mm,sd_mm,p95_mm,max_mm");
  EXPECT_EQ(by_slice.substr(0, by_slice.find('\n')),
            "condition,sample,organ,slice_index,offset_mm,n_points,mean_mm,sd_mm,p95_mm,max_mm");
  EXPECT_EQ(std::count(by_step.begin(), by_step.end(), '\n'), 1 + 2 * 4 * 6);
  EXPECT_EQ(by_step.find("nan"), std::string::npos);
}

TEST(ResultFiles, CurvesHoldMeanAndDeviationOverTheRandomisedRuns)
{
  // Shares of the motion 0.9 (nominal), 0.8 and 0.7: the runs' mean errors are known from the rows run by run.
  dataset::Estimate estimate = test::sphere_estimate("full", translation, 0.9);
  for (const int run : {1, 2})
  {
    estimate.samples.push_back(test::sphere_estimate("full", translation, 0.9 - 0.1 * run).samples.front());
    estimate.samples.back().sample = run;
  }
  const Evaluation evaluation = evaluate(test::sphere_anatomy(), test::sphere_truth(translation), {estimate});
  std::vector<double> means;
  for (const StepError &row : evaluation.by_step)
    if (row.condition == "full" && row.organ == "uterus" && row.step == 4 && row.sample > 0)
      means.push_back(row.distance.mean);
  ASSERT_EQ(means.size(), 2u);
  const std::string row = fmt::format("\nfull,uterus,4,2,{:.9g},{:.9g}\n", (means[0] + means[1]) / 2,
                                      std::abs(means[0] - means[1]) / std::sqrt(2.0));
  const std::string by_step = curves_by_step_csv(evaluation), by_slice = curves_by_slice_csv(evaluation);
  EXPECT_NE(by_step.find(row), std::string::npos) << by_step;
  EXPECT_EQ(by_step.substr(0, by_step.find('\n')), "condition,organ,step,n_runs,mean_mm,sd_mm");
  EXPECT_EQ(std::count(by_step.begin(), by_step.end(), '\n'), 1 + 2 * 4 * 6);
  EXPECT_EQ(by_slice.substr(0, by_slice.find('\n')), "condition,organ,slice_index,offset_mm,n_runs,mean_mm,sd_mm");
  EXPECT_NE(by_slice.find("\nfull,uterus,-1,-6,2,"), std::string::npos) << by_slice;
}

TEST(ResultFiles, AllAreWrittenAndNothingElseStays)
{
  const auto directory = std::filesystem::path(::testing::TempDir()) / "pelvireg_result_files_test";
  std::filesystem::remove_all(directory);
  std::filesystem::create_directories(directory);
  write_result_files(judged(), {}, directory);
  std::vector<std::string> names;
  for (const auto &entry : std::filesystem::directory_iterator(directory))
    names.push_back(entry.path().filename());
  std::sort(names.begin(), names.end());
  EXPECT_EQ(names, (std::vector<std::string>{"curves_by_slice.csv", "curves_by_step.csv", "errors_by_slice.csv",
                                             "errors_by_step.csv", "summary.json"}));
  std::ifstream stream(directory / "errors_by_step.csv");
  std::stringstream text;
  text << stream.rdbuf();
  EXPECT_EQ(text.str(), errors_by_step_csv(judged()));
  EXPECT_THROW(write_result_files(judged(), {}, directory / "missing"), std::runtime_error);
  std::filesystem::remove_all(directory);
}

TEST(Summary, HoldsTheNumbersOfTheEvaluation)
{
  const Evaluation evaluation = judged();
  const auto summary = nlohmann::json::parse(summary_json(evaluation, {{"full", 6, 1.5, 2.0, 3.0}}));
  EXPECT_EQ(summary["case"], "spheres");
  EXPECT_EQ(summary["claims"].size(), assess_claims(evaluation, {}).size());
  const StepError &last = evaluation.by_step[24 + 11];
  ASSERT_EQ(last.organ, "vagina");
  ASSERT_EQ(last.step, 6);
  const auto &vagina = summary["errors"]["full"]["vagina"];
  EXPECT_EQ(vagina["last_step"]["mean_mm"], last.distance.mean);
  EXPECT_EQ(vagina["last_step_nominal_run"]["p95_mm"], last.distance.p95);
  EXPECT_NEAR(vagina["reduction_against_unregistered_percent"].get<double>(),
              100 * (1 - last.distance.mean / evaluation.by_step[11].distance.mean), 1e-12);
  EXPECT_NEAR(summary["truth_motion"]["organs"]["uterus"]["mean_off_plane_mm"].get<double>(), 2, 1e-12);
  EXPECT_EQ(summary["timing"][0]["median_ms"], 1.5);
}

TEST(ErrorTable, NamesEveryConditionOrganAndVerdictWithinTheWidth)
{
  const std::string table = error_table(judged());
  for (const std::string word : {"unregistered, last step", "full, last step", "bladder", "vagina", "uterus", "rectum",
                                 "confirmed", "not assessed"})
    EXPECT_NE(table.find(word), std::string::npos) << word;
  std::istringstream lines(table);
  for (std::string line; std::getline(lines, line);)
    EXPECT_LE(line.size(), 110u) << line;
}
} // namespace
} // namespace pelvireg::runner
