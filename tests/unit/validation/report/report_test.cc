#include "validation/report/report.h"

#include "tests/scratch_folder.h"
#include "tests/unit/validation/fixtures/sphere_case.h"
#include "validation/report/summary_page.h"
#include "validation/report/web_bundle.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <initializer_list>
#include <string>
#include <utility>

namespace pelvireg::report
{
namespace
{
const Eigen::Vector3d translation(2, 5, -6);

struct Case
{
  dataset::Anatomy anatomy = test::sphere_anatomy();
  dataset::Truth truth = test::sphere_truth(translation);
  std::vector<dataset::Estimate> estimates = {test::sphere_estimate("full", translation, 0.9),
                                              test::sphere_estimate("no_boundary_conditions", translation, 0.6)};
  std::vector<runner::StepTiming> timings = {{"full", 6, 1.25, 1.5, 2.0}};
  std::optional<TrackingResult> tracking = {};

  std::string html(const std::vector<ProvenanceEntry> &provenance = {{"Command", "pelvireg run spheres"}}) const
  {
    const runner::Evaluation evaluation = runner::evaluate(anatomy, truth, estimates);
    return report_html({.evaluation = evaluation,
                        .anatomy = anatomy,
                        .truth = truth,
                        .estimates = estimates,
                        .timings = timings,
                        .pictures = {},
                        .provenance = provenance,
                        .tracking = tracking});
  }
};

TEST(Report, PutsVerdictAndErrorsBeforeEverythingElse)
{
  const std::string html = Case().html();
  const std::size_t verdict = html.find(" confirmed</span>"), table = html.find("<table>"),
                    figure = html.find("<figure>");
  ASSERT_NE(verdict, std::string::npos);
  EXPECT_LT(verdict, table);
  EXPECT_LT(table, figure);
  for (const std::string word : {"What this is not", "not a clinical validation", "Definitions", "Provenance",
                                 "pelvireg run spheres", "1.2 / 1.5", "20 mm", "paper: below 4 mm"})
    EXPECT_NE(html.find(word), std::string::npos) << word;
}

/// The page without its style, its script, their licences and its data: what is written anew for each result.
std::string written_for_the_case(std::string html)
{
  for (const auto &[begin, end] : std::initializer_list<std::pair<std::string, std::string>>{
           {"<style>", "</style>"}, {"<footer>", "</footer>"}, {"<script type=", "</html>"}})
  {
    const std::size_t first = html.find(begin), last = html.find(end, first);
    EXPECT_NE(last, std::string::npos) << begin;
    html.erase(first, last - first);
  }
  return html;
}

TEST(Report, NeedsNoNetwork)
{
  const std::string html = Case().html();
  for (const std::string word : {"src=\"/", "@import", "url("})
    EXPECT_EQ(html.find(word), std::string::npos) << word;
  for (const std::string word : {"http:", "https:", "<script", ">nan", " nan", ",nan", ">inf"})
    EXPECT_EQ(written_for_the_case(html).find(word), std::string::npos) << word;
}

TEST(Report, RunsItsOwnScriptAndNoOther)
{
  const std::string html = Case().html();
  EXPECT_NE(html.find("default-src 'none'; style-src 'unsafe-inline'; img-src data:; script-src 'sha256-" +
                      std::string(page_script_digest()) + "'\""),
            std::string::npos);
  EXPECT_NE(html.find("<script>" + std::string(page_script()) + "</script>"), std::string::npos);
}

TEST(Report, EscapesHostileNames)
{
  Case hostile;
  const std::string name = "</script><script>alert(1)</script>\"'&";
  hostile.anatomy.case_name = hostile.truth.case_name = name;
  hostile.truth.source = name;
  for (dataset::Estimate &estimate : hostile.estimates)
    estimate.case_name = name;
  const std::string html = written_for_the_case(hostile.html({{name, name}}));
  EXPECT_EQ(html.find("script>"), std::string::npos);
  EXPECT_NE(html.find("&lt;/script&gt;&lt;script&gt;alert(1)"), std::string::npos);
}

TEST(Report, OnPaperIsOnePageWithoutScript)
{
  const Case spheres;
  const runner::Evaluation evaluation = runner::evaluate(spheres.anatomy, spheres.truth, spheres.estimates);
  const std::string html = summary_page_html(
      {evaluation, spheres.anatomy, spheres.truth, spheres.estimates, {}, {}, {}, {}, {"pelvireg run <spheres>"}});
  EXPECT_EQ(html.find("<script"), std::string::npos);
  EXPECT_EQ(html.find("script-src"), std::string::npos);
  EXPECT_NE(html.find("pelvireg run &lt;spheres&gt;"), std::string::npos);
}

TEST(Report, SaysWhatTheTruthDoesNotKnowOfItself)
{
  const std::string html = Case().html();
  for (const std::string word : {"error of the truth's mesh is not known", "does not say whether its energies"})
    EXPECT_NE(html.find(word), std::string::npos) << word;
}

TEST(Report, ShowsTheTruthsErrorBarAndItsWorstBalance)
{
  Case known;
  const auto n = static_cast<Eigen::Index>(known.truth.increments.size());
  known.truth.balances.resize(known.truth.increments.size());
  known.truth.balances.front().energy_error_percent = -0.73;
  dataset::DiscretisationError error;
  error.n_cells = Eigen::Vector3i(451, 928, 1802);
  error.mean = error.max = error.max_near_bars = Eigen::VectorXd::Constant(n, 0.0412);
  error.mean_by_organ = error.max_by_organ = dataset::Points4::Constant(n, 4, 0.0573);
  error.revision = "abcdef";
  known.truth.discretisation_error = error;
  const std::string html = known.html();
  for (const std::string word : {"451, 928 and 1802", "0.057", "mean at most 0.041", "0.73 %", "(abcdef)"})
    EXPECT_NE(html.find(word), std::string::npos) << word;
}

TEST(Report, SaysWhereTheTruthIsNotBetterKnownThanTheError)
{
  // The registration does 0.9 of a motion of 8.06 mm: a mean surface error of 0.42 mm for every organ.
  Case known;
  const auto n = static_cast<Eigen::Index>(known.truth.increments.size());
  dataset::DiscretisationError error;
  error.n_cells = Eigen::Vector3i(1, 2, 3);
  error.mean = error.max = error.max_near_bars = Eigen::VectorXd::Constant(n, 0.1);
  error.mean_by_organ = error.max_by_organ = dataset::Points4::Constant(n, 4, 0.1);
  known.truth.discretisation_error = error;
  EXPECT_EQ(known.html().find("own error bar is not smaller"), std::string::npos);
  known.truth.discretisation_error->mean_by_organ(n - 1, 2) = 0.5;
  EXPECT_NE(known.html().find("not smaller than the error with all constraints for: <b>uterus</b>"), std::string::npos);
}

/// The section with the times.
std::string times_in(const std::string &html)
{
  const std::size_t begin = html.find("<section id=\"time\">");
  EXPECT_NE(begin, std::string::npos);
  return html.substr(begin, html.find("</section>", begin) - begin);
}

TEST(Report, ShowsWhatWasTrackedInImagesAndSaysThatTheOutlinesAreExactOtherwise)
{
  Case tracked;
  EXPECT_EQ(tracked.html().find("Tracked in images"), std::string::npos);
  EXPECT_NE(tracked.html().find("no tracking error"), std::string::npos);
  tracked.tracking = {"\xFF\xD8\xFF"
                      "foo",
                      "<svg onload=\"x\"/>", "bezier <b>0.09", "full 0.42"};
  const std::string html = tracked.html();
  EXPECT_EQ(html.find("no tracking error"), std::string::npos);
  EXPECT_EQ(html.find("<svg onload"), std::string::npos);
  for (const std::string word : {"Tracked in images", "data:image/jpeg;base64,/9j/Zm9v", "bezier &lt;b&gt;0.09",
                                 "full 0.42", "data:image/svg+xml;base64,PHN2ZyBvbmxvYWQ9IngiLz4="})
    EXPECT_NE(html.find(word), std::string::npos) << word;
}

TEST(Report, ShowsThePhasesThatWereRecordedWithTheirShares)
{
  Case timed;
  timed.timings = {{.condition = "full",
                    .n_steps = 6,
                    .median_ms = 3,
                    .p95_ms = 5,
                    .max_ms = 6,
                    .mean_ms = 4,
                    .phases = {{"match", 1}, {"compliance", 2.5}, {"<later>", 0.5}}},
                   {.condition = "no_boundary_conditions", .n_steps = 6, .median_ms = 1, .p95_ms = 1, .max_ms = 1}};
  const std::string times = times_in(timed.html());
  const auto row = [](const std::string &name, const std::string &mean, const std::string &share)
  { return "<th scope=\"row\">" + name + "</th><td>" + mean + "</td><td>" + share + "</td>"; };
  const std::size_t match = times.find(row("matching", "1.00", "25.0")),
                    compliance = times.find(row("compliance W", "2.50", "62.5")),
                    later = times.find(row("&lt;later&gt;", "0.50", "12.5")),
                    whole = times.find(row("whole step", "4.00", "100.0"));
  ASSERT_NE(whole, std::string::npos) << times;
  EXPECT_LT(match, compliance) << "in the order of a step";
  EXPECT_LT(compliance, later);
  EXPECT_LT(later, whole);
  EXPECT_NE(times.find("width=\"62.50\""), std::string::npos);
  EXPECT_NE(times.find("Not recorded for: no_boundary_conditions."), std::string::npos);
  EXPECT_EQ(times.find("whole step"), times.rfind("whole step")) << "one table, no empty one";
}

TEST(Report, SaysInASentenceThatNoPhaseWasRecorded)
{
  const std::string times = times_in(Case().html());
  EXPECT_NE(times.find("Not recorded for: full."), std::string::npos);
  EXPECT_EQ(times.find("class=\"bars\""), std::string::npos);
}

TEST(Report, IsTheSameOnEveryRun)
{
  EXPECT_EQ(Case().html(), Case().html());
}

TEST(Report, IsWrittenWholeToItsFile)
{
  // PELVIREG_REPORT_SAMPLE keeps the page, to look at it.
  const char *sample = std::getenv("PELVIREG_REPORT_SAMPLE");
  const test::ScratchFolder folder;
  const std::filesystem::path file = sample ? std::filesystem::path(sample) : folder / "report.html";
  const Case spheres;
  const runner::Evaluation evaluation = runner::evaluate(spheres.anatomy, spheres.truth, spheres.estimates);
  const ReportInputs inputs{evaluation, spheres.anatomy, spheres.truth, spheres.estimates, {}, {}, {}};
  write_report(inputs, file);
  EXPECT_EQ(std::filesystem::file_size(file), report_html(inputs).size());
  EXPECT_THROW(write_report(inputs, "/nowhere/report.html"), std::runtime_error);
}
} // namespace
} // namespace pelvireg::report
