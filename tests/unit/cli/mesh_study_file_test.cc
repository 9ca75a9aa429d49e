// mesh_study.json says everything of an error bar, and of which case and solver it holds.
#include "synthetic/anatomy/case.h"
#include "synthetic/dataset/error.h"
#include "validation/cli/mesh_study_file.h"

#include <gtest/gtest.h>

namespace pelvireg::cli
{
namespace
{
dataset::DiscretisationError example()
{
  dataset::DiscretisationError error;
  error.cell_sizes = {9.3, 6.6, 14.0 / 3};
  error.n_cells = Eigen::Vector3i(450, 928, 1800);
  error.observed_order = 1.7;
  error.used_order = 1.7;
  error.safety_factor = 1.25;
  error.mean = Eigen::Vector2d(0.01, 0.02);
  error.max = Eigen::Vector2d(0.1, 1.0 / 3);
  error.max_near_bars = Eigen::Vector2d(0.2, 0.4);
  error.mean_by_organ = (dataset::Points4(2, 4) << 1, 2, 3, 4, 5, 6, 7, 8).finished();
  error.max_by_organ = 10 * error.mean_by_organ;
  error.bar_distance = 5;
  error.share_near_bars = 0.25;
  error.case_sha256 = std::string(64, 'a');
  error.solver_sha256 = std::string(64, 'b');
  error.revision = std::string(12, 'c');
  return error;
}

TEST(MeshStudyFile, ComesBackExactly)
{
  const dataset::DiscretisationError saved = example(), loaded = read_mesh_study(mesh_study_text("t005", saved));
  EXPECT_EQ(loaded.cell_sizes, saved.cell_sizes);
  EXPECT_EQ(loaded.n_cells, saved.n_cells);
  EXPECT_EQ(loaded.max, saved.max);
  EXPECT_EQ(loaded.max_by_organ, saved.max_by_organ);
  EXPECT_EQ(loaded.mean_by_organ, saved.mean_by_organ);
  EXPECT_EQ(mesh_study_text("t005", loaded), mesh_study_text("t005", saved));
}

TEST(MeshStudyFile, IsRefusedWhenItIsNotOne)
{
  EXPECT_THROW(read_mesh_study("{}"), InputError);
  EXPECT_THROW(read_mesh_study("not a file"), InputError);
}

TEST(CaseDigest, KnowsWhatTheReferenceSeesAndNothingElse)
{
  const std::string text = anatomy::case_text("quick"), digest = case_digest(text, "quick");
  const auto changed = [&](const std::string &key, const std::string &value)
  { return case_digest(anatomy::with_value(text, "quick", key, value), "quick") != digest; };
  EXPECT_FALSE(changed("registration.time_step", "0.01"));
  EXPECT_FALSE(changed("description", "'other words'"));
  EXPECT_FALSE(changed("plane.slice_pitch", "5.0"));
  EXPECT_FALSE(changed("reference.cell_size.vagina", "15.0")); // what it is
  EXPECT_TRUE(changed("reference.cell_size.vagina", "14.0"));
  EXPECT_TRUE(changed("plane.tilt", "2.0"));
  EXPECT_TRUE(changed("cavity.bladder", "{mode = 'open'}"));
  EXPECT_TRUE(changed("materials.fascia.c10", "0.006"));
  EXPECT_EQ(case_digest(text + "# a comment\n", "quick"), digest);
}
} // namespace
} // namespace pelvireg::cli
