#include "tests/unit/tracking/moving_scene.h"

#include <gtest/gtest.h>

#include <string>

namespace pelvireg::tracking
{
namespace
{
/// Tracked outlines of organs in the last of `n` frames after the first.
TrackedFrame follow(const Scene &scene, const std::string &name, int n)
{
  const auto tracker = make_tracker(name);
  tracker->start(scene.image(0, 1), scene.initial_outlines());
  TrackedFrame last;
  for (int frame = 1; frame <= n; ++frame)
    last = tracker->update(scene.image(static_cast<double>(frame) / n, static_cast<unsigned>(frame) + 1));
  return last;
}

OutlineError mean_error(const Scene &scene, const TrackedFrame &frame, double time)
{
  OutlineError mean;
  const double n = static_cast<double>(scene.organs.size());
  for (std::size_t i = 0; i < scene.organs.size(); ++i)
  {
    const OutlineError error = error_of(frame.outlines[i].points, scene.outline(i, time));
    mean.mean += error.mean / n;
    mean.max = std::max(mean.max, error.max);
    mean.normal += error.normal / n;
    mean.tangential += error.tangential / n;
  }
  return mean;
}

/// How close neighbouring points have come, as a share of their true distance: the least.
double least_spacing(const PixelPoints &tracked, const PixelPoints &truth)
{
  double least = 1;
  for (Eigen::Index i = 0, n = truth.rows(); i < n; ++i)
    least = std::min(least, (tracked.row((i + 1) % n) - tracked.row(i)).norm() /
                                (truth.row((i + 1) % n) - truth.row(i)).norm());
  return least;
}

/// 12 px of shift, 12 degrees of rotation, stretch and bending.
Scene moving_organs(double noise)
{
  Scene scene = four_organs();
  scene.noise = noise;
  scene.displacement = [](const Eigen::Vector2d &x)
  {
    const Eigen::Vector2d q = x - Eigen::Vector2d(64, 64);
    return Eigen::Vector2d(7 - 0.20 * q.y() + 0.05 * q.x() + 1.5 * std::sin(0.07 * x.y()),
                           9 + 0.20 * q.x() - 0.08 * q.y() + 1.5 * std::sin(0.06 * x.x()));
  };
  return scene;
}
} // namespace

TEST(BezierTracker, FollowsMovingOrgansToHalfAPixelAndTheirBordersToASixth)
{
  const Scene scene = moving_organs(0.05);
  const OutlineError error = mean_error(scene, follow(scene, "bezier", 30), 1);
  EXPECT_LT(error.mean, 0.5);
  EXPECT_LT(error.normal, 1.0 / 6);
  EXPECT_LT(error.max, 1.5);
}

TEST(BezierTracker, IsBetterThanEveryBaselineOnAKnownMotion)
{
  const Scene scene = moving_organs(0.05);
  const double ours = mean_error(scene, follow(scene, "bezier", 30), 1).mean;
  for (const std::string &name : tracker_names())
  {
    if (name == "bezier")
      continue;
    EXPECT_LT(ours, mean_error(scene, follow(scene, name, 30), 1).mean) << name;
  }
}

TEST(BezierTracker, DoesNotDriftInTwoHundredStillNoisyFrames)
{
  Scene scene = four_organs();
  scene.noise = 0.05;
  const auto tracker = make_tracker("bezier");
  tracker->start(scene.image(0, 1), scene.initial_outlines());
  double early = 0, late = 0; // mean deviation of frames 51-100 and 151-200, px
  for (int frame = 1; frame <= 200; ++frame)
  {
    const TrackedFrame tracked = tracker->update(scene.image(0, static_cast<unsigned>(frame) + 1));
    for (std::size_t i = 0; i < scene.organs.size(); ++i)
    {
      const OutlineError error = error_of(tracked.outlines[i].points, scene.outline(i, 0));
      EXPECT_LT(error.mean, 0.25) << "frame " << frame << ", " << scene.organs[i].name;
      early += frame > 50 && frame <= 100 ? error.mean / 200 : 0;
      late += frame > 150 ? error.mean / 200 : 0;
    }
    EXPECT_EQ(tracked.n_lost_joints, 0) << "frame " << frame;
  }
  RecordProperty("early_px", std::to_string(early));
  RecordProperty("late_px", std::to_string(late));
  EXPECT_LT(late, 1.1 * early);
}

TEST(BezierTracker, DoesNotTakeNoiseForTexture)
{
  Scene scene = moving_organs(0.05);
  scene.texture = 0; // along a smooth border nothing tells where a point is
  const auto tracker = make_tracker("bezier");
  tracker->start(scene.image(0, 1), scene.initial_outlines());
  for (int frame = 1; frame <= 120; ++frame)
  {
    const double time = std::min(1.0, frame / 30.0);
    const TrackedFrame tracked = tracker->update(scene.image(time, static_cast<unsigned>(frame) + 1));
    EXPECT_LT(mean_error(scene, tracked, time).normal, 0.25) << "frame " << frame;
    for (std::size_t i = 0; i < scene.organs.size(); ++i)
      EXPECT_GT(least_spacing(tracked.outlines[i].points, scene.outline(i, time)), 0.5) << "frame " << frame;
  }
}

TEST(BezierTracker, OfStillFramesWithoutNoiseStaysWhereItIs)
{
  const Scene scene = four_organs();
  EXPECT_LT(mean_error(scene, follow(scene, "bezier", 10), 0).max, 0.02);
}

TEST(BezierTracker, ReportsWhatIsHiddenAndFindsItAgain)
{
  const Scene scene = moving_organs(0.05);
  const auto tracker = make_tracker("bezier");
  tracker->start(scene.image(0, 1), scene.initial_outlines());
  int lost_while_hidden = 0, reacquired = 0, n_lost = 0;
  for (int frame = 1; frame <= 30; ++frame)
  {
    const double time = frame / 30.0;
    Image image = scene.image(time, static_cast<unsigned>(frame) + 1);
    const bool is_hidden = frame >= 10 && frame < 16;
    if (is_hidden) // the front of the bladder
      for (int row = 60; row < 100; ++row)
        std::fill_n(image.pixels.begin() + row * 128, 26, 0.05F);
    const TrackedFrame tracked = tracker->update(image);
    const TrackedOutline &bladder = tracked.outlines[0];
    for (Eigen::Index i = 0; i < bladder.points.rows(); ++i)
      if (is_hidden && bladder.is_lost[static_cast<std::size_t>(i)] && bladder.points(i, 0) < 27)
        ++lost_while_hidden;
    reacquired += tracked.n_reacquired_joints;
    n_lost = tracked.n_lost_joints;
  }
  EXPECT_GT(lost_while_hidden, 50);
  EXPECT_GT(reacquired, 3);
  EXPECT_EQ(n_lost, 0);
  const TrackedFrame after = tracker->update(scene.image(1, 99));
  EXPECT_LT(error_of(after.outlines[0].points, scene.outline(0, 1)).mean, 1); // found again: within a pixel
}

TEST(BezierTracker, OfTheSameFramesGivesTheSameBytes)
{
  const Scene scene = moving_organs(0.05);
  const TrackedFrame once = follow(scene, "bezier", 6), again = follow(scene, "bezier", 6);
  for (std::size_t i = 0; i < once.outlines.size(); ++i)
  {
    EXPECT_EQ(once.outlines[i].points, again.outlines[i].points);
    EXPECT_EQ(once.outlines[i].confidence, again.outlines[i].confidence);
  }
}

TEST(BezierTracker, WithFlowAloneFollowsToHalfAPixel)
{
  const Scene scene = moving_organs(0.05);
  std::vector<InitialOutline> outlines = scene.initial_outlines();
  for (InitialOutline &outline : outlines)
    outline.flow_only = true;
  const auto tracker = make_tracker("bezier");
  tracker->start(scene.image(0, 1), outlines);
  TrackedFrame last;
  for (int frame = 1; frame <= 30; ++frame)
    last = tracker->update(scene.image(frame / 30.0, static_cast<unsigned>(frame) + 1));
  EXPECT_LT(mean_error(scene, last, 1).mean, 0.5);
}

TEST(BezierTracker, CarriesABorderlessPartWithItsNeighbours)
{
  Scene scene = moving_organs(0.05);
  std::vector<InitialOutline> outlines = scene.initial_outlines();
  std::vector<char> &has_border = outlines[0].has_border;
  has_border.assign(static_cast<std::size_t>(outlines[0].points.rows()), 1);
  std::fill_n(has_border.begin(), 12, 0);
  const auto tracker = make_tracker("bezier");
  tracker->start(scene.image(0, 1), outlines);
  TrackedFrame last;
  for (int frame = 1; frame <= 30; ++frame)
    last = tracker->update(scene.image(frame / 30.0, static_cast<unsigned>(frame) + 1));
  EXPECT_LT(error_of(last.outlines[0].points, scene.outline(0, 1)).mean, 0.4);
}
} // namespace pelvireg::tracking
