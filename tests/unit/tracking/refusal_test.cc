#include "tests/unit/tracking/moving_scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace pelvireg::tracking
{
namespace
{
using testing::HasSubstr;

template <class Call> std::string refusal(const Call &call)
{
  try
  {
    call();
  }
  catch (const std::invalid_argument &problem)
  {
    return problem.what();
  }
  return "";
}

struct Started
{
  Scene scene = four_organs();
  Image first = scene.image(0, 1);
  std::vector<InitialOutline> outlines = scene.initial_outlines();
};
} // namespace

TEST(TrackerRefuses, AnOutlineOutsideTheImageByOrganAndPoint)
{
  Started given;
  given.outlines[1].points.row(3) << 500, 20;
  EXPECT_THAT(refusal([&] { make_tracker("bezier")->start(given.first, given.outlines); }),
              testing::AllOf(HasSubstr("vagina"), HasSubstr("point 3"), HasSubstr("outside the image of 128 x 128")));
}

TEST(TrackerRefuses, AnOutlineThatIsNotFinite)
{
  Started given;
  given.outlines[2].points(0, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(refusal([&] { make_tracker("bezier")->start(given.first, given.outlines); }),
              testing::AllOf(HasSubstr("uterus"), HasSubstr("not finite")));
}

TEST(TrackerRefuses, TooFewPointsAndNoOutlineAndOneWithoutExtent)
{
  Started given;
  EXPECT_THAT(refusal([&] { make_tracker("bezier")->start(given.first, {}); }), HasSubstr("no outline"));
  std::vector<InitialOutline> two = given.outlines;
  two[0].points.conservativeResize(2, 2);
  EXPECT_THAT(refusal([&] { make_tracker("bezier")->start(given.first, two); }), HasSubstr("has 2 points"));
  std::vector<InitialOutline> dot = given.outlines;
  dot[0].points.rowwise() = Eigen::RowVector2d(30, 30);
  EXPECT_THAT(refusal([&] { make_tracker("bezier")->start(given.first, dot); }), HasSubstr("smaller than a pixel"));
}

TEST(TrackerRefuses, ANanPixelByPlaceAndLeavesTheTrackerAsItWas)
{
  Started given;
  const auto tracker = make_tracker("bezier"), undisturbed = make_tracker("bezier");
  tracker->start(given.first, given.outlines);
  undisturbed->start(given.first, given.outlines);
  Image broken = given.scene.image(0, 2);
  broken.pixels[128 * 5 + 7] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THAT(refusal([&] { tracker->update(broken); }),
              testing::AllOf(HasSubstr("frame 1"), HasSubstr("column 7, row 5"), HasSubstr("not finite")));
  const Image whole = given.scene.image(0, 3);
  EXPECT_EQ(tracker->update(whole).outlines[0].points, undisturbed->update(whole).outlines[0].points);
}

TEST(TrackerRefuses, AFrameOfAnotherSizeAndAColourImage)
{
  Started given;
  const auto tracker = make_tracker("bezier");
  tracker->start(given.first, given.outlines);
  Scene small = given.scene;
  small.size = 64;
  EXPECT_THAT(refusal([&] { tracker->update(small.image(0, 1)); }), HasSubstr("64 x 64 pixels, must be 128 x 128"));
  Image colour = given.first;
  colour.pixels.resize(3 * colour.pixels.size());
  EXPECT_THAT(refusal([&] { tracker->update(colour); }), HasSubstr("only grey images"));
}

TEST(TrackerRefuses, AnUnknownNameAndOptionsOutOfRange)
{
  EXPECT_THAT(refusal([] { make_tracker("kalman"); }), testing::AllOf(HasSubstr("kalman"), HasSubstr("bezier")));
  EXPECT_THAT(refusal([] { make_tracker("bezier", {.joint_spacing = 1}); }), HasSubstr("joint_spacing"));
  EXPECT_THAT(refusal([] { spline_outline(PixelPoints::Zero(3, 2), 1); }), HasSubstr("are equal"));
}

TEST(TrackerRefuses, FramesBeforeTheFirst)
{
  EXPECT_THROW(make_tracker("bezier")->update(Image{}), std::logic_error);
}
} // namespace pelvireg::tracking
