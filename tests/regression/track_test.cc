// From images to outlines to errors, and a user's own images, through the program.
#include "synthetic/dataset/observations.h"
#include "tests/regression/program.h"

#include <fmt/format.h>

#include <map>

namespace pelvireg
{
namespace
{
using ::testing::HasSubstr;

/// A Slicer file with a few clicks on each rest outline, moved by `shift` mm along y.
std::string clicks(const std::filesystem::path &observations, double shift = 0, const std::string &first_name = "")
{
  std::string markups;
  for (const dataset::OrganOutline &outline : dataset::load_observations(observations).rest.outlines)
  {
    const dataset::Points &points = outline.contours[0].points;
    std::string controls;
    for (Eigen::Index i = 0; i < points.rows(); i += std::max<Eigen::Index>(1, points.rows() / 20))
      controls += fmt::format("{}{{\"position\": [{}, {}, {}]}}", controls.empty() ? "" : ", ", points(i, 0),
                              points(i, 1) + shift, points(i, 2));
    markups += fmt::format("{}{{\"type\": \"ClosedCurve\", \"name\": \"{}\", \"controlPoints\": [{}]}}",
                           markups.empty() ? "" : ", ",
                           markups.empty() && !first_name.empty() ? first_name : outline.organ, controls);
  }
  return "{\"@schema\": \"markups\", \"markups\": [" + markups + "]}";
}

/// Largest mean_mm of a tracker in contour_errors.csv, by organ.
std::map<std::string, double> worst_means(const std::filesystem::path &file, const std::string &tracker)
{
  std::map<std::string, double> worst;
  std::istringstream rows(content_of(file));
  for (std::string row; std::getline(rows, row);)
  {
    std::istringstream fields(row);
    std::string name, organ, skipped, mean;
    std::getline(fields, name, ',');
    std::getline(fields, organ, ',');
    std::getline(fields, skipped, ',');
    std::getline(fields, skipped, ',');
    std::getline(fields, mean, ',');
    if (name == tracker)
      worst[organ] = std::max(worst[organ], std::stod(mean));
  }
  return worst;
}
} // namespace

TEST_F(Program, TracksImagesOfACaseRegistersFromThemAndTakesAUsersOwn)
{
  const Outcome run = call("run quick --out r --from images --snr 20 --conditions full --jobs 1");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("What tracking costs"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "r/estimate-full_images.h5"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "r/pictures/tracked_frames.png"));
  for (const auto &[organ, mean] : worst_means(folder_ / "r/contour_errors.csv", "bezier"))
    EXPECT_LE(mean, 1.5) << organ; // a pixel, in every frame
  EXPECT_EQ(worst_means(folder_ / "r/contour_errors.csv", "snake").size(), 4u);

  const std::string tracked = content_of(folder_ / "r/tracked.h5");
  EXPECT_THAT(call("track r --all").out, HasSubstr("up to date"));
  ASSERT_EQ(call("track r --tracker lk_joints").status, 0);
  EXPECT_NE(content_of(folder_ / "r/tracked.h5"), tracked);
  ASSERT_EQ(call("track r").status, 0);
  EXPECT_EQ(content_of(folder_ / "r/tracked.h5"), tracked);

  std::ofstream(folder_ / "organs.mrk.json") << clicks(folder_ / "r/observations.h5");
  const Outcome own = call("track --nrrd r/images/dyn.nrrd --contours organs.mrk.json --out own");
  ASSERT_EQ(own.status, 0) << own.err;
  EXPECT_THAT(content_of(folder_ / "own/outlines/frame_0001.mrk.json"), HasSubstr("\"ClosedCurve\""));
  // Outlines go in as they come out.
  EXPECT_EQ(call("track --nrrd r/images/dyn.nrrd --contours own/outlines/frame_0000.mrk.json --out again").status, 0);

  std::ofstream(folder_ / "away.mrk.json") << clicks(folder_ / "r/observations.h5", 900);
  std::ofstream(folder_ / "liver.mrk.json") << clicks(folder_ / "r/observations.h5", 0, "liver");
  expect_refused("track --nrrd r/images/dyn.nrrd --contours liver.mrk.json --out bad", "liver");
  expect_refused("track --nrrd r/images/dyn.nrrd --contours away.mrk.json --out bad", "bladder");
  expect_refused("track --nrrd r/images/dyn.nrrd --contours none.mrk.json --out bad", "cannot be read");
  expect_refused("track --nrrd r/images/dyn.nrrd --out bad", "--contours is missing");
  expect_refused("track --nrrd r/truth.h5 --contours organs.mrk.json --out bad", "truth.h5");
  expect_refused("track r --nrrd r/images/dyn.nrrd", "either a result directory");
  expect_refused("track r --tracker kalman", "kalman");
  expect_refused("register r --outlines images --samples 3", "--samples");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "bad"));
}
} // namespace pelvireg
