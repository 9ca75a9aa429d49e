// A user's own images through the program, and what it says without images.
#include "synthetic/observation/images/image_files.h"
#include "tests/regression/program.h"
#include "tests/unit/tracking/moving_scene.h"

#include <fmt/format.h>

namespace pelvireg
{
namespace
{
using ::testing::HasSubstr;

/// Four organs that move by 6 pixels of 1 mm in eight frames, in the plane x = 0.
tracking::Scene scene()
{
  tracking::Scene organs = tracking::four_organs();
  organs.noise = 0.03;
  organs.displacement = [](const Eigen::Vector2d &) { return Eigen::Vector2d(5, 3); };
  return organs;
}

void write_images(const std::filesystem::path &file)
{
  dataset::ImageSeries series;
  series.geometry.columns = series.geometry.rows = scene().size;
  series.slice_thickness_mm = 7;
  series.description = "scene";
  for (int frame = 0; frame <= 8; ++frame)
  {
    series.times_s.push_back(0.4 * frame);
    const tracking::Image image = scene().image(frame / 8.0, static_cast<unsigned>(frame) + 1);
    series.pixels.insert(series.pixels.end(), image.pixels.begin(), image.pixels.end());
  }
  observation::write_nrrd(series, file);
}

/// A Slicer file with a few clicks on each outline at rest, moved by `shift` mm.
std::string clicks(double shift = 0, const std::string &first_name = "")
{
  std::string markups;
  for (const tracking::InitialOutline &outline : scene().initial_outlines())
  {
    std::string controls;
    for (Eigen::Index i = 0; i < outline.points.rows(); i += 4)
      controls += fmt::format("{}{{\"position\": [0, {}, {}]}}", controls.empty() ? "" : ", ",
                              outline.points(i, 0) + shift, -outline.points(i, 1));
    markups += fmt::format("{}{{\"type\": \"ClosedCurve\", \"name\": \"{}\", \"controlPoints\": [{}]}}",
                           markups.empty() ? "" : ", ",
                           markups.empty() && !first_name.empty() ? first_name : outline.organ, controls);
  }
  return "{\"@schema\": \"markups\", \"markups\": [" + markups + "]}";
}
} // namespace

TEST_F(Program, FollowsOutlinesThroughAUsersOwnImages)
{
  write_images(folder_ / "dyn.nrrd");
  std::ofstream(folder_ / "organs.mrk.json") << clicks();
  const Outcome own = call("track --nrrd dyn.nrrd --contours organs.mrk.json --out own");
  ASSERT_EQ(own.status, 0) << own.err;
  EXPECT_THAT(content_of(folder_ / "own/outlines/frame_0008.mrk.json"), HasSubstr("\"ClosedCurve\""));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "own/tracked_frames.png"));
  // Outlines go in as they come out, and the same images give the same bytes.
  EXPECT_EQ(call("track --nrrd dyn.nrrd --contours own/outlines/frame_0000.mrk.json --out again").status, 0);
  ASSERT_EQ(call("track --nrrd dyn.nrrd --contours organs.mrk.json --out twice").status, 0);
  EXPECT_EQ(content_of(folder_ / "own/tracked_points.csv"), content_of(folder_ / "twice/tracked_points.csv"));
}

TEST_F(Program, RefusesToTrackWhatIsNotThere)
{
  write_images(folder_ / "dyn.nrrd");
  std::ofstream(folder_ / "organs.mrk.json") << clicks();
  std::ofstream(folder_ / "away.mrk.json") << clicks(900);
  std::ofstream(folder_ / "liver.mrk.json") << clicks(0, "liver");
  expect_refused("track --nrrd dyn.nrrd --contours liver.mrk.json --out bad", "liver");
  expect_refused("track --nrrd dyn.nrrd --contours away.mrk.json --out bad", "outside the image");
  expect_refused("track --nrrd dyn.nrrd --contours none.mrk.json --out bad", "cannot be read");
  expect_refused("track --nrrd dyn.nrrd --out bad", "--contours is missing");
  expect_refused("track --nrrd organs.mrk.json --contours organs.mrk.json --out bad", "organs.mrk.json");
  expect_refused("track --nrrd dyn.nrrd --contours organs.mrk.json --tracker kalman --out bad", "kalman");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "bad"));
  expect_refused("run quick --snr 10 --out bad", "--snr 10 is the noise of images");
  expect_refused("run quick --from exact --snr 10 --out bad", "--snr 10 is the noise of images");
  expect_refused("run quick --from images --snr 0.5 --out bad", "signal-to-noise ratio is 0.5");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "bad"));
  ASSERT_EQ(call("anatomy quick --out r").status, 0);
  expect_refused("track r --nrrd dyn.nrrd", "either a result directory");
  expect_refused("register r --outlines images --samples 3", "--samples");
}
} // namespace pelvireg
