// A file of curves that is not whole and sound gives a sentence and no curve.
#include "validation/regression/curves.h"

#include "synthetic/dataset/error.h"

#include <gtest/gtest.h>

#include <string>

namespace pelvireg::regression
{
namespace
{
const std::string header = "condition,sample,organ,step,n_points,mean_mm,sd_mm,p95_mm,max_mm\n";
const std::string first = "full,0,vagina,1,40,0.5,0.2,0.9,1.2\n";
const std::string second = "full,0,vagina,2,40,0.6,0.2,1.0,1.3\n";
const std::string slice_header = "condition,sample,organ,slice_index,offset_mm,n_points,mean_mm,sd_mm,p95_mm,max_mm\n";

void expect_refused(const std::string &text, const std::string &words, Axis axis = Axis::step)
{
  try
  {
    read_curves(text, axis, "errors.csv");
    FAIL() << "no refusal, expected: " << words;
  }
  catch (const InputError &error)
  {
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    EXPECT_EQ(std::string(error.what()).find("errors.csv"), 0u) << error.what();
  }
}

TEST(Curves, AreReadByFamilySampleAndStep)
{
  const Curves curves = read_curves(header + first + second, Axis::step, "errors.csv");
  const Curve &curve = curves.at({"full", "vagina", Axis::step}).at(0);
  ASSERT_EQ(curve.size(), 2u);
  EXPECT_EQ(curve[1].abscissa, 2);
  EXPECT_EQ(curve[1].n_points, 40);
  EXPECT_EQ(curve[1].mean, 0.6);
  EXPECT_EQ(curve[1].p95, 1.0);
  const Curves slices =
      read_curves(slice_header + "full,3,rectum,-2,-12,40,0.5,0.2,0.9,1.2\n", Axis::slice, "errors.csv");
  EXPECT_EQ(slices.at({"full", "rectum", Axis::slice}).at(3).front().offset, -12);
}

TEST(Curves, RefuseWhatIsNotANumber)
{
  for (const char *value : {"nan", "-nan", "NaN", "inf", "-inf", "", "0.5x", "0,5", "1e999", " 0.5"})
    expect_refused(header + "full,0,vagina,1,40," + value + ",0.2,0.9,1.2\n", "line 2");
  expect_refused(header + "full,0,vagina,1,40,nan,0.2,0.9,1.2\n", "mean_mm is 'nan', must be finite");
  expect_refused(header + "full,0,vagina,1,40,-0.5,0.2,0.9,1.2\n", "must not be negative");
  expect_refused(header + "full,0,vagina,1,0,0.5,0.2,0.9,1.2\n", "n_points is '0'");
  expect_refused(header + "full,0,vagina,1,40,1.3,0.2,0.9,1.2\n", "must not be above max_mm");
  expect_refused(header + "full,0.5,vagina,1,40,0.5,0.2,0.9,1.2\n", "sample is '0.5'");
}

TEST(Curves, RefuseAnotherHeader)
{
  expect_refused("condition,sample,organ,step,n_points,mean_cm,sd_cm,p95_cm,max_cm\n" + first, "the first line");
  expect_refused("condition,sample,organ,n_points,step,mean_mm,sd_mm,p95_mm,max_mm\n" + first, "the first line");
  expect_refused("", "the first line");
  expect_refused(first, "the first line");
  expect_refused(header + first, "the first line", Axis::slice);
}

TEST(Curves, RefuseWhatIsCutOffOrEmpty)
{
  expect_refused(header, "there is no row");
  expect_refused(header + first + "full,0,vagina,2,40,0.6", "cut off");
  expect_refused(header + first + "full,0,vagina,2,40,0.6\n", "got 6 fields");
  expect_refused(header + first + "\n" + second, "got 1 fields");
  expect_refused(header + ",0,vagina,1,40,0.5,0.2,0.9,1.2\n", "condition is ''");
}

TEST(Curves, RefuseAStepThatIsRepeatedOrLeftOut)
{
  expect_refused(header + first + first, "must be above that of the row before");
  expect_refused(header + second, "step 1 is not there");
  expect_refused(header + first + "full,0,vagina,3,40,0.6,0.2,1.0,1.3\n", "step 2 is not there");
}
} // namespace
} // namespace pelvireg::regression
