#include "synthetic/dataset/error.h"
#include "validation/cli/case_overview.h"

#include <gtest/gtest.h>

#include <fstream>

namespace pelvireg::cli
{
namespace
{
namespace fs = std::filesystem;

fs::path directory_with(const std::string &name, const std::string &summary)
{
  const fs::path directory = fs::path(testing::TempDir()) / ("case_overview_" + name);
  fs::create_directories(directory);
  std::ofstream(directory / "summary.json") << summary;
  return directory;
}

std::string summary(const std::string &name, const std::string &verdict, bool inverse_crime)
{
  std::string errors;
  for (const std::string condition : {"no_boundary_conditions", "full"})
  {
    errors += (errors.empty() ? "\"" : ",\"") + condition + "\": {";
    for (const std::string organ : {"bladder", "vagina", "uterus"})
      errors += (organ == "bladder" ? "\"" : ",\"") + organ +
                "\": {\"last_step\": {\"mean_mm\": " + (condition == "full" ? "0.5" : "1.25") + "}}";
    errors += "}";
  }
  return R"({"case": ")" + name + R"(", "inverse_crime": )" + (inverse_crime ? "true" : "false") +
         R"(, "claims": [{"id": "first", "verdict": "confirmed"}, {"id": "second", "verdict": ")" + verdict +
         R"("}], "errors": {)" + errors + "}}";
}

TEST(CaseOverview, HasErrorsAndVerdictsOfEveryCaseAndMarksTheInverseCrime)
{
  const std::string text = case_overview({directory_with("a", summary("one", "refuted", false)),
                                          directory_with("b", summary("two", "not assessed", true))});
  EXPECT_NE(text.find("one         1.25 / 0.50    1.25 / 0.50    1.25 / 0.50          - / -\n"), std::string::npos)
      << text;
  EXPECT_NE(text.find("- / -  (inverse crime)\n"), std::string::npos) << text;
  EXPECT_NE(text.find("one        +   x\n"), std::string::npos) << text;
  EXPECT_NE(text.find("two        +   .\n1 first, 2 second\n"), std::string::npos) << text;
}

TEST(CaseOverview, RefusesASummaryThatIsMissingOrBroken)
{
  EXPECT_THROW(case_overview({fs::path(testing::TempDir()) / "no_such_folder"}), InputError);
  EXPECT_THROW(case_overview({directory_with("c", "{\"case\": \"x\"")}), InputError);
  EXPECT_THROW(case_overview({directory_with("d", "{\"case\": \"x\"}")}), InputError);
}
} // namespace
} // namespace pelvireg::cli
