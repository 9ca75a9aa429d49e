// The direction of dependence is what makes judge, reference and registration independent; this keeps it so.
#include "tests/architecture/include_rules.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

namespace pelvireg::architecture
{
namespace
{
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::set<std::string> some_files = {
    "registration/registration.h", "registration/solver/step.h",   "reference_fe/reference.h",
    "reference_fe/term.h",         "synthetic/dataset/truth.h",    "synthetic/anatomy/case.h",
    "validation/metrics/cut.h",    "validation/runner/register.h", "tests/unit/samples.h"};

std::vector<std::string> problems(const std::string &file, const std::string &text)
{
  return include_problems(file, text, some_files);
}

std::string content_of(const std::filesystem::path &file)
{
  std::ostringstream out;
  out << std::ifstream(file).rdbuf();
  return out.str();
}
} // namespace

TEST(Includes, OfEverySourceFileGoTheAllowedWay)
{
  const std::filesystem::path root = PELVIREG_SOURCE_ROOT;
  const std::set<std::string> files = source_files(root);
  ASSERT_GT(files.size(), 20u); // a checker that sees no file would pass for ever
  for (const std::string &file : files)
    EXPECT_THAT(include_problems(file, content_of(root / file), files), IsEmpty());
}

TEST(IncludeChecker, FindsEveryForbiddenDirection)
{
  const std::vector<std::pair<std::string, std::string>> forbidden = {
      {"registration/solver/a.cc", "synthetic/dataset/truth.h"},
      {"registration/solver/a.cc", "reference_fe/reference.h"},
      {"reference_fe/a.cc", "registration/registration.h"},
      {"reference_fe/a.cc", "synthetic/anatomy/case.h"},
      {"reference_fe/a.cc", "validation/metrics/cut.h"},
      {"synthetic/dataset/a.cc", "synthetic/anatomy/case.h"},
      {"synthetic/anatomy/a.cc", "reference_fe/reference.h"},
      {"synthetic/observation/a.cc", "registration/registration.h"},
      {"synthetic/observation/a.cc", "validation/metrics/cut.h"},
      {"validation/metrics/a.cc", "registration/registration.h"},
      {"validation/metrics/a.cc", "validation/runner/register.h"},
      {"validation/runner/a.cc", "reference_fe/reference.h"},
      {"validation/runner/a.cc", "synthetic/anatomy/case.h"},
      {"validation/runner/a.cc", "registration/solver/step.h"},
      {"validation/cli/a.cc", "reference_fe/term.h"},
      {"validation/cli/a.cc", "registration/solver/step.h"},
      {"validation/cli/a.cc", "tests/unit/samples.h"}};
  for (const auto &[file, included] : forbidden)
    EXPECT_THAT(problems(file, "#include \"" + included + "\"\n"), ElementsAre(HasSubstr("is out of bounds")))
        << file << " includes " << included;
}

TEST(IncludeChecker, AcceptsEveryAllowedDirection)
{
  const std::vector<std::pair<std::string, std::string>> allowed = {
      {"registration/registration.cc", "registration/solver/step.h"},
      {"reference_fe/reference.cc", "synthetic/dataset/truth.h"},
      {"synthetic/anatomy/case.cc", "synthetic/dataset/truth.h"},
      {"validation/runner/register.cc", "registration/registration.h"},
      {"validation/runner/register.cc", "validation/metrics/cut.h"},
      {"validation/cli/main.cc", "reference_fe/reference.h"},
      {"validation/cli/main.cc", "synthetic/anatomy/case.h"},
      {"tests/unit/a_test.cc", "registration/solver/step.h"}};
  for (const auto &[file, included] : allowed)
    EXPECT_THAT(problems(file, "#include \"" + included + "\"\n"), IsEmpty()) << file << " includes " << included;
}

TEST(IncludeChecker, FindsAnIncludeThatIsNotAFullPathFromTheRoot)
{
  EXPECT_THAT(problems("registration/registration.cc", "#include \"registration.h\"\n"),
              ElementsAre(HasSubstr("registration/registration.cc:1: \"registration.h\" is not the full path")));
  EXPECT_THAT(problems("registration/solver/a.cc", "\n\n  #  include \"../registration.h\" // above\n"),
              ElementsAre(HasSubstr("a.cc:3:")));
  EXPECT_THAT(problems("registration/solver/a.cc", "#include <registration/registration.h>\n"),
              ElementsAre(HasSubstr("write it in quotes")));
}

TEST(IncludeChecker, FindsALibraryOutsideItsFolder)
{
  EXPECT_THAT(problems("validation/runner/a.cc", "#include <deal.II/base/point.h>\n"),
              ElementsAre(HasSubstr("deal.II")));
  EXPECT_THAT(problems("reference_fe/a.cc", "#include <gmsh.h>\n"), ElementsAre(HasSubstr("gmsh")));
  EXPECT_THAT(problems("validation/metrics/a.cc", "#include <vtkCutter.h>\n"), ElementsAre(HasSubstr("VTK")));
  EXPECT_THAT(problems("validation/runner/a.cc", "#include \"hdf5.h\"\n"), ElementsAre(HasSubstr("HDF5")));
  EXPECT_THAT(problems("registration/solver/a.cc", "#include <opencv2/core.hpp>\n"), ElementsAre(HasSubstr("OpenCV")));
}

TEST(IncludeChecker, AcceptsALibraryInItsFolder)
{
  EXPECT_THAT(problems("reference_fe/a.cc", "#include <deal.II/base/point.h>\n"), IsEmpty());
  EXPECT_THAT(problems("synthetic/dataset/a.h", "#include <hdf5.h>\n"), IsEmpty());
  EXPECT_THAT(problems("validation/report/a.cc", "#include <vtkCutter.h>\n#include <vector>\n"), IsEmpty());
}

TEST(IncludeChecker, FindsAFolderWithoutARule)
{
  EXPECT_THAT(problems("elsewhere/a.cc", "#include \"synthetic/dataset/truth.h\"\n"),
              ElementsAre(HasSubstr("no rule covers")));
}
} // namespace pelvireg::architecture
