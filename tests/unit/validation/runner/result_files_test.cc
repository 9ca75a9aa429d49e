#include "validation/runner/result_files.h"

#include "tests/scratch_folder.h"
#include "tests/unit/validation/fixtures/sphere_case.h"
#include "validation/runner/aims.h"
#include "validation/runner/claims.h"
#include "validation/runner/condition_table.h"
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
  const std::string metrics = metrics_by_step_csv(evaluation), by_distance = errors_by_distance_csv(evaluation);
  EXPECT_EQ(metrics.substr(0, metrics.find('\n')),
            "condition,sample,organ,step,n_points,material_mean_mm,material_p95_mm,material_max_mm,normal_mean_mm,"
            "tangential_mean_mm,symmetric_mean_mm,hd95_mm,dice,volume_mm3,volume_change_percent,truth_volume_mm3,"
            "truth_volume_change_percent,rotation_error_rad,truth_rotation_rad");
  EXPECT_EQ(std::count(metrics.begin(), metrics.end(), '\n'), 1 + 2 * 4 * 3);
  EXPECT_EQ(by_distance.substr(0, by_distance.find('\n')),
            "condition,sample,organ,offset_from_mm,offset_to_mm,n_points,mean_mm,sd_mm,p95_mm,max_mm,material_mean_mm");
  for (const std::string &text : {metrics, by_distance})
    EXPECT_EQ(text.find("nan"), std::string::npos);
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
  const test::ScratchFolder folder;
  const std::filesystem::path &directory = folder.path();
  write_result_files(judged(), {}, directory);
  std::vector<std::string> names;
  for (const auto &entry : std::filesystem::directory_iterator(directory))
    names.push_back(entry.path().filename());
  std::sort(names.begin(), names.end());
  EXPECT_EQ(names, (std::vector<std::string>{"curves_by_slice.csv", "curves_by_step.csv", "errors_by_distance.csv",
                                             "errors_by_slice.csv", "errors_by_step.csv", "metrics_by_step.csv",
                                             "summary.json"}));
  std::ifstream stream(directory / "errors_by_step.csv");
  std::stringstream text;
  text << stream.rdbuf();
  EXPECT_EQ(text.str(), errors_by_step_csv(judged()));
  EXPECT_THROW(write_result_files(judged(), {}, directory / "missing"), std::runtime_error);
}

TEST(Summary, HoldsTheNumbersOfTheEvaluation)
{
  const Evaluation evaluation = judged();
  const auto summary =
      nlohmann::json::parse(summary_json(evaluation, {{"full", 6, 1.5, 2.0, 3.0, 1.75, {{"solve", 1.25}}}}));
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
  EXPECT_EQ(summary["timing"][0]["mean_ms"], 1.75);
  EXPECT_EQ(summary["timing"][0]["phases"], nlohmann::json({{{"phase", "solve"}, {"mean_ms", 1.25}}}));
  const StepMetrics &metrics = evaluation.metrics_by_step[12 + 5];
  ASSERT_EQ(metrics.organ, "vagina");
  ASSERT_EQ(metrics.step, 6);
  EXPECT_EQ(summary["metrics_at_last_step"]["full"]["vagina"]["hd95_mm"]["mean"], metrics.symmetric.hd95);
  EXPECT_EQ(summary["metrics_at_last_step"]["full"]["vagina"]["material_mean_mm"]["mean"],
            metrics.material.distance.mean);
  EXPECT_EQ(summary["errors_by_distance"]["full"]["vagina"].size(), 8u) << "-18.3 to 22.4 mm, slabs of 6 mm";
  EXPECT_EQ(summary["truth_sections"].size(), 4u * 6u);
  EXPECT_EQ(summary["truth_sections"][0]["counts_for_slope"], false) << "slice -2";
  EXPECT_EQ(vagina["slope_with_distance"]["n_slices_left_out"], 2);
  EXPECT_EQ(vagina["slope_with_distance_of_all_slices"]["n_slices"], 6);
  EXPECT_EQ(summary["inverse_crime"], false);
}

TEST(ErrorTable, ShowsTheResidualBesideEveryConditionAndMarksOneThatDoesNotFollowTheImage)
{
  dataset::Estimate lost = test::sphere_estimate("no_contact", translation, 0.5);
  lost.samples[0].steps.back().in_plane_residual = 0.47;
  const std::string table = error_table(evaluate(test::sphere_anatomy(), test::sphere_truth(translation),
                                                 {test::sphere_estimate("full", translation, 0.9), lost}));
  EXPECT_NE(table.find("        0.060\n  largest over"), std::string::npos) << table;
  EXPECT_NE(table.find("        0.470 !\n  largest over"), std::string::npos) << table;
  EXPECT_NE(table.find("it gives no ratio"), std::string::npos);
}

TEST(InverseCrime, IsSaidByEveryTable)
{
  dataset::Truth truth = test::sphere_truth(translation);
  truth.source = dataset::truth_of_registration + " (full) of case spheres_large";
  const Evaluation evaluation =
      evaluate(test::sphere_anatomy(), truth, {test::sphere_estimate("full", translation, 0.9)});
  const std::string table = error_table(evaluation), conditions = condition_table(evaluation);
  EXPECT_EQ(table.find("INVERSE CRIME") != std::string::npos, true);
  EXPECT_NE(inverse_crime_notice(evaluation).find("floor: bladder 0."), std::string::npos)
      << inverse_crime_notice(evaluation);
  EXPECT_EQ(conditions.find("INVERSE CRIME") != std::string::npos, true);
  std::size_t n_marks = 0;
  for (std::size_t at = table.find("[inverse crime"); at != std::string::npos;
       at = table.find("[inverse crime", at + 1))
    ++n_marks;
  EXPECT_EQ(n_marks, 3 + assess_claims(evaluation, {}).size() + assess_aims(evaluation).size())
      << "three blocks of figures, every claim and aim";
  const auto summary = nlohmann::json::parse(summary_json(evaluation));
  EXPECT_EQ(summary["inverse_crime"], true);
  for (const auto &claim : summary["claims"])
    EXPECT_EQ(claim["ours"].get<std::string>().rfind("[inverse crime]", 0), 0u) << claim["id"];
  EXPECT_EQ(error_table(judged()).find("inverse crime"), std::string::npos);
}

TEST(ErrorTable, NamesEveryConditionOrganAndVerdictWithinTheWidth)
{
  const std::string table = error_table(judged());
  for (const std::string word : {"unregistered, last step", "full, last step", "95 % Hausdorff", "bladder", "vagina",
                                 "uterus", "rectum", "confirmed", "not assessed"})
    EXPECT_NE(table.find(word), std::string::npos) << word;
  std::istringstream lines(table);
  for (std::string line; std::getline(lines, line);)
    EXPECT_LE(line.size(), 110u) << line;
}

TEST(Summary, HoldsTheNodesOfEveryBodyBesideTableOne)
{
  Evaluation evaluation = judged();
  evaluation.registration_nodes = {{"bladder", 806},   {"vagina", 1789},       {"uterus", 523},       {"rectum", 2205},
                                   {"ligaments", 233}, {"fascia_pelvis", 352}, {"fascia_sacrum", 326}};
  const auto summary = nlohmann::json::parse(summary_json(evaluation));
  EXPECT_EQ(summary.at("n_registration_nodes"), 6234);
  const auto &nodes = summary.at("registration_nodes");
  EXPECT_EQ(nodes.at("table_1_data_set"), "T007");
  EXPECT_EQ(nodes.at("bodies").at(0).at("table_1"), 772);
  EXPECT_NEAR(nodes.at("bodies").at(0).at("difference_percent"), 100.0 * 34 / 772, 1e-12);
  evaluation.registration_nodes.resize(2);
  EXPECT_TRUE(nlohmann::json::parse(summary_json(evaluation))
                  .at("/registration_nodes/bodies/0/table_1"_json_pointer)
                  .is_null());
}
} // namespace
} // namespace pelvireg::runner
