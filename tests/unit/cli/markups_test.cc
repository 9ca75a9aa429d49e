#include "validation/cli/markups.h"

#include "synthetic/dataset/error.h"
#include "tests/scratch_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace pelvireg::cli
{
namespace
{
using testing::HasSubstr;

class Markups : public testing::Test
{
protected:
  void write(const std::string &text) const { std::ofstream(file_) << text; }

  /// A file as Slicer writes it, as far as it matters, with one curve.
  static std::string curve(const std::string &attributes, const std::string &label = "C-1")
  {
    return R"({"@schema": "markups-schema-v1.0.3.json#", "markups": [{"type": "ClosedCurve", )" + attributes +
           R"( "controlPoints": [{"id": "1", "label": ")" + label + R"(", "position": [1.5, -20, 3]},
               {"id": "2", "position": [1.5, 20, 3]}, {"id": "3", "position": [1.5, 0, 30]}]}]})";
  }

  std::string refusal() const
  {
    try
    {
      read_curves(file_);
    }
    catch (const InputError &problem)
    {
      return problem.what();
    }
    return "";
  }

  const test::ScratchFolder folder_;
  const std::filesystem::path file_ = folder_ / "curve.mrk.json";
};
} // namespace

TEST_F(Markups, ComeBackAsTheyWereWritten)
{
  dataset::Points bladder(3, 3), rectum(4, 3);
  bladder << 3.05, 1.0 / 3, 2, 3, 4, 5, 6, 7, -8.25;
  rectum << 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11;
  write(curves_text({{"bladder", bladder}, {"rectum", rectum}}));
  const std::vector<ClosedCurve> curves = read_curves(file_);
  ASSERT_EQ(curves.size(), 2u);
  EXPECT_EQ(curves[0].organ, "bladder");
  EXPECT_EQ(curves[0].points, bladder);
  EXPECT_EQ(curves[1].organ, "rectum");
  EXPECT_EQ(curves[1].points, rectum);
}

TEST_F(Markups, InRasAreTurnedIntoLps)
{
  write(curve(R"("name": "vagina", "coordinateSystem": "RAS",)"));
  EXPECT_EQ(Eigen::RowVector3d(read_curves(file_)[0].points.row(0)), Eigen::RowVector3d(-1.5, 20, 3));
  write(curve(R"("name": "vagina", "coordinateSystem": "LPS",)"));
  EXPECT_EQ(Eigen::RowVector3d(read_curves(file_)[0].points.row(0)), Eigen::RowVector3d(1.5, -20, 3));
  write(curve(R"("name": "vagina",)")); // the schema's default
  EXPECT_EQ(Eigen::RowVector3d(read_curves(file_)[0].points.row(0)), Eigen::RowVector3d(1.5, -20, 3));
}

TEST_F(Markups, TakeTheOrganFromNameOrLabel)
{
  write(curve(R"("name": "Bladder_1",)"));
  EXPECT_EQ(read_curves(file_)[0].organ, "bladder");
  write(curve("", "Uterus-1"));
  EXPECT_EQ(read_curves(file_)[0].organ, "uterus");
}

TEST_F(Markups, AreRefusedWhenTheOrganIsUnknown)
{
  write(curve(R"("name": "liver",)"));
  EXPECT_THAT(refusal(), testing::AllOf(HasSubstr("liver"), HasSubstr("bladder, vagina, uterus or rectum")));
}

TEST_F(Markups, AreRefusedWithoutClosedCurveOrTooFewPoints)
{
  write(R"({"@schema": "x", "markups": [{"type": "Curve", "controlPoints": []}]})");
  EXPECT_THAT(refusal(), HasSubstr("holds no closed curve"));
  write(R"({"@schema": "x", "markups": [{"type": "ClosedCurve", "name": "bladder", "controlPoints": []}]})");
  EXPECT_THAT(refusal(), HasSubstr("has 0 points"));
}

TEST_F(Markups, AreRefusedInAnotherUnit)
{
  write(curve(R"("name": "bladder", "coordinateUnits": "um",)"));
  EXPECT_THAT(refusal(), testing::AllOf(HasSubstr("um"), HasSubstr("must be in mm")));
}

TEST_F(Markups, AreRefusedWhenTheFileIsNone)
{
  EXPECT_THAT(refusal(), HasSubstr("cannot be read"));
  write("not json");
  EXPECT_THAT(refusal(), HasSubstr("is not a markups file"));
  write(R"({"markups": [{"type": "ClosedCurve", "name": "bladder", "controlPoints":
          [{"position": [NaN, 0, 0]}, {"position": [1, 0, 0]}, {"position": [0, 1, 0]}]}]})");
  EXPECT_THAT(refusal(), HasSubstr("is not a markups file")); // JSON has no NaN
}

TEST_F(Markups, AreRefusedWithTwoCurvesOfOneOrgan)
{
  dataset::Points triangle(3, 3);
  triangle << 0, 0, 0, 1, 0, 0, 0, 1, 0;
  write(curves_text({{"bladder", triangle}, {"bladder", triangle}}));
  EXPECT_THAT(refusal(), HasSubstr("bladder has two curves"));
}
} // namespace pelvireg::cli
