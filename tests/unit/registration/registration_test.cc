#include "registration/registration.h"
#include "tests/unit/registration/scene.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cstring>
#include <limits>
#include <set>
#include <stdexcept>
#include <string>

namespace pelvireg::registration
{
namespace
{
/// Two hollow organs, one above the other, and a band of hexahedra from the upper one to a fixed end on its left.
Model two_organs_and_a_band()
{
  Model model;
  model.bodies.push_back(scene::hollow_ellipsoid({25, 30, 20}, 3, 3));
  model.bodies.push_back(scene::hollow_ellipsoid({20, 20, 20}, 3, 2, {0, 0, -40}));
  model.bodies.push_back(scene::block({30, 6, 6}, {6, 1, 1}, false, false, {25, -3, -3}));
  model.bodies[0].name = "upper";
  model.bodies[1].name = "lower";
  model.bodies[2].name = "band";
  model.bodies[2].youngs_modulus = 0.05;
  Attachment attachment{"band on upper", 2, {}, 0, 0};
  for (int node = 0; node < model.bodies[2].rest_positions.rows(); ++node)
  {
    if (model.bodies[2].rest_positions(node, 0) > 54)
      model.bodies[2].fixed_nodes.push_back(node);
    if (model.bodies[2].rest_positions(node, 0) < 26)
      attachment.nodes_a.push_back(node);
  }
  model.attachments.push_back(attachment);
  return model;
}

const Eigen::Vector3d tilted_normal = Eigen::Vector3d(1, 0.08, 0.05).normalized();

/// The outlines of the rest state, every second segment, moved by `motion`.
Observation moved_outlines(const Model &model, const Eigen::Vector3d &motion, const std::vector<int> &bodies = {0, 1})
{
  Observation observation;
  observation.plane_origin = Eigen::Vector3d(-3, 0, 0);
  observation.plane_normal = tilted_normal;
  for (const int body : bodies)
  {
    observation.outlines.push_back(scene::outline(model.bodies[body], body, model.bodies[body].rest_positions,
                                                  observation.plane_origin, observation.plane_normal));
    observation.outlines.back().points.rowwise() += motion.transpose();
  }
  return observation;
}

/// 2 mm in the tilted plane.
Eigen::Vector3d in_plane(double y, double z)
{
  const Eigen::Vector3d v(0, y, z);
  return v - v.dot(tilted_normal) * tilted_normal;
}

std::string prepare_message(const Model &model, const Options &options = {})
{
  try
  {
    Registration().prepare(model, options);
  }
  catch (const std::invalid_argument &error)
  {
    return error.what();
  }
  return "";
}
} // namespace

TEST(Registration, SlidingRowsPushInThePlaneAndNotAcrossIt)
{
  const Model model = two_organs_and_a_band();
  Registration registration;
  registration.prepare(model, {});
  const StepSummary summary = registration.update(moved_outlines(model, in_plane(1, 2)));
  ASSERT_EQ(summary.status, StepStatus::ok);
  EXPECT_GE(summary.accepted_control_points, 60);
  EXPECT_GT(summary.in_plane_force, 1e-3);
  EXPECT_LE(summary.out_of_plane_force, 1e-14 * summary.in_plane_force);
}

TEST(Registration, FollowsATranslatedOutlineInThePlane)
{
  Model model;
  model.bodies.push_back(scene::hollow_ellipsoid({25, 30, 20}, 3, 3));
  Registration registration;
  registration.prepare(model, {});
  const Eigen::Vector3d motion = in_plane(4, -3);
  StepSummary summary;
  for (int position = 1; position <= 5; ++position)
    for (int repeat = 0; repeat < 3; ++repeat)
      summary = registration.update(moved_outlines(model, position / 5.0 * motion, {0}));
  EXPECT_LE(summary.mean_in_plane_residual, 0.05);
  EXPECT_LE(summary.max_in_plane_residual, 0.3);
  for (int rest = 0; rest < 60; ++rest) // the walls far from the plane follow as the elastic forces fade
    summary = registration.update(moved_outlines(model, motion, {0}));
  const Points motion_of_nodes = registration.positions(0) - model.bodies[0].rest_positions;
  const Eigen::Vector3d mean = motion_of_nodes.colwise().mean().transpose();
  // Facets of 4 mm with 6 degrees between them: the matched points may settle on other facets than they started from.
  EXPECT_LE((mean - motion).norm(), 0.1);
  const auto in_plane_error = [&](int node)
  {
    const Eigen::Vector3d error = motion_of_nodes.row(node).transpose() - motion;
    return (error - error.dot(tilted_normal) * tilted_normal).norm();
  };
  for (int node = 0; node < motion_of_nodes.rows(); ++node)
    EXPECT_LE(in_plane_error(node), 1);
}

// An attached node turns with its triangle and rows are linear: a step leaves a gap of second order in its motion, the
// next one closes it.
TEST(Registration, HoldsTheAttachmentsToSecondOrderInAStepsMotion)
{
  const Model model = two_organs_and_a_band();
  const auto gap_after_one_step = [&](double part)
  {
    Registration registration;
    registration.prepare(model, {});
    return registration.update(moved_outlines(model, part * in_plane(1, 1))).attachment_residual;
  };
  EXPECT_NEAR(gap_after_one_step(0.01) / gap_after_one_step(0.1), 0.01, 0.001);

  Registration registration;
  registration.prepare(model, {});
  for (int step = 1; step <= 9; ++step)
  {
    const StepSummary summary = registration.update(moved_outlines(model, (step + 2) / 3 * in_plane(1, 1)));
    ASSERT_EQ(summary.status, StepStatus::ok);
    EXPECT_LE(summary.attachment_residual, 1e-4); // 1.4 mm a position
  }
  const Points band_motion = registration.positions(2) - model.bodies[2].rest_positions;
  EXPECT_GT(band_motion.rowwise().norm().maxCoeff(), 1);
  for (const int node : model.bodies[2].fixed_nodes)
    EXPECT_EQ(band_motion.row(node).norm(), 0);
}

TEST(Registration, BringsNodesToThePointsThatHoldThemAndFollowsThePoints)
{
  Model model;
  model.bodies.push_back(scene::hollow_ellipsoid({25, 30, 20}, 3, 3));
  PointAttachment held{"handles", 0, {0, 3, 5}, Points(3, 3), 0};
  for (int k = 0; k < 3; ++k)
    held.points.row(k) = model.bodies[0].rest_positions.row(held.nodes[k]) + Eigen::RowVector3d(1, -2, 3);
  model.point_attachments.push_back(held);
  Registration registration;
  registration.prepare(model, {});
  for (int step = 0; step < 400; ++step) // no outline: the points alone drive the step
    ASSERT_EQ(registration.update(Observation()).status, StepStatus::ok);
  const Points moved = model.bodies[0].rest_positions.rowwise() + Eigen::RowVector3d(1, -2, 3);
  EXPECT_LE((registration.positions(0) - moved).rowwise().norm().maxCoeff(), 1e-3); // three points: a rigid motion

  held.points.row(1) += Eigen::RowVector3d(0, 0, 1);
  registration.move_points(0, held.points);
  const StepSummary summary = registration.update(Observation());
  EXPECT_LE(summary.attachment_residual, 1e-6);
  for (int k = 0; k < 3; ++k)
    EXPECT_LE((registration.positions(0).row(held.nodes[k]) - held.points.row(k)).norm(), 1e-6);
}

TEST(Registration, LeavesPointAttachmentsOutWithTheOtherAnatomicalConstraints)
{
  Model model = two_organs_and_a_band();
  Points far(1, 3);
  far << 0, 0, 100;
  model.point_attachments.push_back({"far", 0, {0}, far, 0});
  Options options;
  options.use_attachments = false;
  Registration registration;
  registration.prepare(model, options);
  EXPECT_EQ(registration.update(moved_outlines(model, in_plane(1, 1))).attachment_residual, 0);
  registration.move_points(0, far); // known, though not in use
}

TEST(Registration, NamesTheFaultOfPoints)
{
  Model model = two_organs_and_a_band();
  model.point_attachments.push_back({"handle", 0, {0, 1}, Points::Zero(1, 3), 0});
  EXPECT_NE(prepare_message(model).find("point attachment 'handle': has 1 points for 2 nodes"), std::string::npos);
  model.point_attachments[0].points = Points::Constant(2, 3, std::numeric_limits<double>::infinity());
  EXPECT_NE(prepare_message(model).find("a point is not finite"), std::string::npos);
  model.point_attachments[0].points.setZero();
  model.point_attachments[0].body = 3;
  EXPECT_NE(prepare_message(model).find("body 3 does not exist"), std::string::npos);
  model.point_attachments[0].body = 0;
  model.point_attachments[0].nodes[1] = -1;
  EXPECT_NE(prepare_message(model).find("nodes: index -1"), std::string::npos);
  model.point_attachments[0].nodes[1] = 1;
  model.point_attachments[0].compliance = -1;
  EXPECT_NE(prepare_message(model).find("compliance is -1"), std::string::npos);
  model.point_attachments[0].compliance = 0;
  Registration registration;
  registration.prepare(model, {});
  EXPECT_THROW(registration.move_points(1, Points::Zero(2, 3)), std::invalid_argument);
  EXPECT_THROW(registration.move_points(0, Points::Zero(3, 3)), std::invalid_argument);
}

TEST(Registration, LeavesTheBandsAtRestWithoutAttachments)
{
  const Model model = two_organs_and_a_band();
  Options options;
  options.use_attachments = false;
  Registration registration;
  registration.prepare(model, options);
  for (int step = 0; step < 45; ++step)
  {
    const StepSummary summary = registration.update(moved_outlines(model, (step / 3 + 1) * in_plane(0.5, 0.5)));
    ASSERT_EQ(summary.status, StepStatus::ok);
    EXPECT_EQ(summary.attachment_residual, 0);
    if (step % 3 == 2)
    {
      EXPECT_LE(summary.mean_in_plane_residual, 0.3);
      EXPECT_GE(summary.accepted_control_points, 0.9 * summary.offered_control_points);
    }
  }
  EXPECT_EQ(registration.positions(2), model.bodies[2].rest_positions);
  EXPECT_GT((registration.positions(0) - model.bodies[0].rest_positions).rowwise().norm().minCoeff(), 5);
}

TEST(Registration, HoldsAnOrgansFixedNodesUnlessItIsToRunWithoutAttachments)
{
  Model model = two_organs_and_a_band();
  for (int node = 0; node < model.bodies[1].rest_positions.rows(); ++node)
    if (model.bodies[1].rest_positions(node, 2) < -50)
      model.bodies[1].fixed_nodes.push_back(node);
  ASSERT_GE(model.bodies[1].fixed_nodes.size(), 3u);
  for (const bool use_attachments : {true, false})
  {
    Options options;
    options.use_attachments = use_attachments;
    Registration registration;
    registration.prepare(model, options);
    for (int step = 0; step < 9; ++step)
      ASSERT_EQ(registration.update(moved_outlines(model, in_plane(1, 1), {0, 1})).status, StepStatus::ok);
    for (const int node : model.bodies[1].fixed_nodes)
    {
      const double motion = (registration.positions(1) - model.bodies[1].rest_positions).row(node).norm();
      EXPECT_EQ(motion == 0, use_attachments) << node;
    }
  }
}

TEST(Registration, TellsFacingWallsOfASlabApart)
{
  // Top and bottom outline of a slab 4 mm thick have moved down by 3 mm: each is nearest to the other wall.
  Model model;
  model.bodies.push_back(scene::block({30, 40, 4}, {6, 8, 1}, true, true));
  Observation observation;
  observation.plane_origin = {14, 0, 0};
  OutlineObservation outline;
  outline.points.resize(14, 3);
  outline.normals.resize(14, 3);
  for (int k = 0; k < 7; ++k)
  {
    outline.points.row(2 * k) << 14, 5 + 5 * k, 4 - 3;
    outline.points.row(2 * k + 1) << 14, 5 + 5 * k, 0 - 3;
    outline.normals.row(2 * k) << 0, 0, 1;
    outline.normals.row(2 * k + 1) << 0, 0, -1;
  }
  observation.outlines.push_back(outline);
  Registration registration;
  registration.prepare(model, {});
  StepSummary summary;
  for (int step = 0; step < 20; ++step)
    summary = registration.update(observation);
  EXPECT_EQ(summary.accepted_control_points, 14);
  const Points motion = registration.positions(0) - model.bodies[0].rest_positions;
  EXPECT_NEAR(motion.col(2).mean(), -3, 0.1);
}

TEST(Registration, SharesTheGapBetweenAntagonistControlPoints)
{
  Model model;
  model.bodies.push_back(scene::hollow_ellipsoid({25, 30, 20}, 3, 3));
  const Eigen::Vector3d motion = in_plane(0, 2);
  Observation observation = moved_outlines(model, motion, {0});
  OutlineObservation &outline = observation.outlines[0];
  const Eigen::Index n = outline.points.rows();
  outline.points.conservativeResize(n + 3, 3); // at one place: 0.2 mm in, 0.2 mm out, and the same point once more
  outline.normals.conservativeResize(n + 3, 3);
  for (int k = 0; k < 3; ++k)
  {
    outline.points.row(n + k) = outline.points.row(10) + 0.2 * (k - 1) * outline.normals.row(10);
    outline.normals.row(n + k) = outline.normals.row(10);
  }
  Registration registration;
  Options options;
  options.sliding_compliance = 0.2; // outlines this contradictory are trusted less
  registration.prepare(model, options);
  for (int step = 0; step < 30; ++step)
  {
    const StepSummary summary = registration.update(observation);
    ASSERT_EQ(summary.status, StepStatus::ok);
    EXPECT_EQ(summary.accepted_control_points, n + 3);
    EXPECT_NEAR(summary.max_in_plane_residual, 0.2, 0.1); // of the pair that cannot be satisfied
    EXPECT_LE(summary.mean_in_plane_residual, 0.1);
  }
  const Points moved = registration.positions(0) - model.bodies[0].rest_positions;
  EXPECT_TRUE(moved.allFinite());
}

TEST(Registration, GivesTheSameBytesForOneAndTwoThreadsAndOnARerun)
{
  const Model model = two_organs_and_a_band();
  std::vector<Points> first;
  for (const int n_threads : {1, 2, 2, 1})
  {
    Options options;
    options.n_threads = n_threads;
    Registration registration;
    registration.prepare(model, options);
    for (int step = 1; step <= 5; ++step)
      ASSERT_EQ(registration.update(moved_outlines(model, step * in_plane(0.5, 0.3))).status, StepStatus::ok);
    for (int body = 0; body < 3; ++body)
      if (n_threads == 1 && first.size() < 3)
        first.push_back(registration.positions(body));
      else
        EXPECT_EQ(std::memcmp(first[body].data(), registration.positions(body).data(),
                              sizeof(double) * static_cast<std::size_t>(first[body].size())),
                  0);
  }
}

TEST(Registration, KeepsTheLastStateWhenAnObservationIsUnusable)
{
  const Model model = two_organs_and_a_band();
  Registration registration;
  registration.prepare(model, {});
  const Observation good = moved_outlines(model, in_plane(1, 0));
  ASSERT_EQ(registration.update(good).status, StepStatus::ok);
  const Points before = registration.positions(0);
  const auto status_of = [&](const Observation &bad)
  {
    const StepStatus status = registration.update(bad).status;
    EXPECT_EQ(registration.positions(0), before);
    return status;
  };

  EXPECT_EQ(status_of(Observation()), StepStatus::no_control_points);
  Observation bad = good;
  bad.outlines[0].points(3, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(status_of(bad), StepStatus::not_finite);
  bad = good;
  bad.plane_normal = {0, std::numeric_limits<double>::infinity(), 0};
  EXPECT_EQ(status_of(bad), StepStatus::not_finite);
  bad = good;
  bad.outlines[1].body = 3;
  EXPECT_EQ(status_of(bad), StepStatus::invalid_observation);
  bad.outlines[1].body = -1;
  EXPECT_EQ(status_of(bad), StepStatus::invalid_observation);
  bad.outlines[1].body = 2; // the band has no outer surface
  EXPECT_EQ(status_of(bad), StepStatus::invalid_observation);
  bad = good;
  bad.plane_normal *= 1.1;
  EXPECT_EQ(status_of(bad), StepStatus::invalid_observation);
  bad = good;
  bad.outlines[0].normals.conservativeResize(4, 3);
  EXPECT_EQ(status_of(bad), StepStatus::invalid_observation);
  bad = good;
  bad.plane_origin.x() += 200; // misses both organs
  EXPECT_EQ(status_of(bad), StepStatus::no_control_points);
  EXPECT_EQ(registration.update(good).status, StepStatus::ok);
}

TEST(Registration, ThePhasesOfAStepTakeNoLongerThanTheStep)
{
  const Model model = two_organs_and_a_band();
  Registration registration;
  registration.prepare(model, {});
  for (int step = 1; step <= 5; ++step)
  {
    const auto start = std::chrono::steady_clock::now();
    ASSERT_EQ(registration.update(moved_outlines(model, step * in_plane(0.5, 0.3))).status, StepStatus::ok);
    const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - start;
    double sum = 0;
    for (const StepPhase &phase : step_phases)
    {
      EXPECT_GE(registration.phase_times().*phase.time, 0) << phase.name;
      sum += registration.phase_times().*phase.time;
    }
    EXPECT_LE(sum, elapsed.count());
    for (const double PhaseTimes::*work : {&PhaseTimes::match, &PhaseTimes::factorise, &PhaseTimes::compliance})
      EXPECT_GT(registration.phase_times().*work, 0);
  }
  EXPECT_EQ(registration.update({}).status, StepStatus::no_control_points);
  EXPECT_EQ(registration.phase_times().factorise, 0) << "of a step that ended before, not of the one before it";
}

TEST(StepPhases, AreAllOfPhaseTimesUnderDifferentNames)
{
  PhaseTimes times;
  std::set<std::string> names;
  for (std::size_t k = 0; k < step_phases.size(); ++k)
  {
    times.*step_phases[k].time = 1;
    names.insert(step_phases[k].name);
  }
  EXPECT_EQ(names.size(), step_phases.size());
  EXPECT_EQ(sizeof(PhaseTimes), step_phases.size() * sizeof(double));
  std::array<double, step_phases.size()> values;
  std::memcpy(values.data(), &times, sizeof times);
  for (const double value : values)
    EXPECT_EQ(value, 1) << "a time that no phase has";
}

TEST(Registration, CountsRefusedControlPoints)
{
  const Model model = two_organs_and_a_band();
  Options options;
  options.max_match_distance = 5;
  Registration registration;
  registration.prepare(model, options);
  Observation observation = moved_outlines(model, Eigen::Vector3d::Zero());
  const Eigen::Index n_upper = observation.outlines[0].points.rows();
  observation.outlines[0].points.rowwise() += Eigen::RowVector3d(0, 0, 100);
  const StepSummary summary = registration.update(observation);
  EXPECT_EQ(summary.status, StepStatus::ok);
  EXPECT_EQ(summary.offered_control_points - summary.accepted_control_points, n_upper);
}

TEST(Registration, StaysAtRestWhenTheOutlinesDo)
{
  const Model model = two_organs_and_a_band();
  Registration registration;
  registration.prepare(model, {});
  for (int step = 0; step < 3; ++step)
    registration.update(moved_outlines(model, Eigen::Vector3d::Zero()));
  EXPECT_LE((registration.positions(0) - model.bodies[0].rest_positions).rowwise().norm().maxCoeff(), 1e-10);
}

TEST(Prepare, NamesTheFaultOfAModelInOneSentence)
{
  const Model good = two_organs_and_a_band();
  EXPECT_EQ(prepare_message(good), "");

  Model bad = good;
  std::swap(bad.bodies[0].tets(5, 0), bad.bodies[0].tets(5, 1));
  EXPECT_NE(prepare_message(bad).find("body 'upper': tetrahedron 5 has volume -"), std::string::npos);

  bad = good;
  bad.bodies[2].hexes.row(2).head<4>().swap(bad.bodies[2].hexes.row(2).tail<4>());
  EXPECT_NE(prepare_message(bad).find("body 'band': hexahedron 2 has the Jacobian"), std::string::npos);

  bad = good;
  bad.bodies[1].outer_triangles.conservativeResize(bad.bodies[1].outer_triangles.rows() - 1, 3);
  bad.bodies[1].is_wall.pop_back();
  EXPECT_NE(prepare_message(bad).find("the outer surface is open at edge"), std::string::npos);

  bad = good;
  bad.bodies[1].outer_triangles.col(0).swap(bad.bodies[1].outer_triangles.col(1));
  EXPECT_NE(prepare_message(bad).find("turn its triangles outward"), std::string::npos);

  bad = good;
  bad.bodies[0].rest_positions.conservativeResize(bad.bodies[0].rest_positions.rows() + 1, 3);
  bad.bodies[0].rest_positions.bottomRows<1>().setZero();
  EXPECT_NE(prepare_message(bad).find("belongs to no element"), std::string::npos);

  bad = good;
  bad.bodies[0].tets(0, 2) = 100000;
  EXPECT_NE(prepare_message(bad).find("index 100000 is out of range"), std::string::npos);

  bad = good;
  bad.bodies[0].youngs_modulus = 0;
  EXPECT_NE(prepare_message(bad).find("Young's modulus is 0 MPa"), std::string::npos);

  bad = good;
  bad.bodies[0].poisson_ratio = 0.5;
  EXPECT_NE(prepare_message(bad).find("Poisson's ratio is 0.5"), std::string::npos);

  bad = good;
  bad.attachments[0].body_b = 7;
  EXPECT_NE(prepare_message(bad).find("attachment 'band on upper': body 7"), std::string::npos);

  bad = good;
  bad.bodies[0].is_wall.assign(bad.bodies[0].is_wall.size(), 0);
  EXPECT_NE(prepare_message(bad).find("has no wall triangle"), std::string::npos);

  EXPECT_NE(prepare_message(Model()).find("no body"), std::string::npos);
}

TEST(Prepare, RefusesAnOrganInTwoPieces)
{
  Model model;
  Body first = scene::hollow_ellipsoid({10, 10, 10}, 2, 1);
  const Body second = scene::hollow_ellipsoid({10, 10, 10}, 2, 1, {40, 0, 0});
  const auto append = [](auto &to, const auto &from, int shift)
  {
    const Eigen::Index n = to.rows();
    to.conservativeResize(n + from.rows(), to.cols());
    to.bottomRows(from.rows()) = from.array() + shift;
  };
  const int n_nodes = static_cast<int>(first.rest_positions.rows());
  append(first.rest_positions, second.rest_positions, 0);
  append(first.tets, second.tets, n_nodes);
  append(first.outer_triangles, second.outer_triangles, n_nodes);
  first.is_wall.insert(first.is_wall.end(), second.is_wall.begin(), second.is_wall.end());
  model.bodies.push_back(first);
  EXPECT_NE(prepare_message(model).find("falls into 2 parts"), std::string::npos);
}

TEST(Prepare, RefusesOptionsOutOfRange)
{
  const Model model = two_organs_and_a_band();
  Options options;
  options.time_step = 0;
  EXPECT_NE(prepare_message(model, options).find("time_step"), std::string::npos);
  options = {};
  options.n_threads = 0;
  EXPECT_NE(prepare_message(model, options).find("n_threads"), std::string::npos);
  options = {};
  options.min_normal_agreement = 1 + 1e-12;
  EXPECT_NE(prepare_message(model, options).find("min_normal_agreement"), std::string::npos);
  options.min_normal_agreement = 1;
  options.tolerance_mm = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(prepare_message(model, options).find("tolerance_mm"), std::string::npos);
}

// A ligament 75 mm long, 10 mm wide, 1.5 mm thick, drawn out by 2.25 mm while its end goes 10 mm sideways. Without the
// stiffness of tension its middle swings by millimetres for ever.
TEST(Registration, ATautBandComesToRest)
{
  Model model;
  model.bodies.push_back(scene::block({75, 10, 1.5}, {5, 2, 1}, false));
  Body &band = model.bodies[0];
  band.name = "band";
  PointAttachment pull{"pull", 0, {}, {}, 0};
  for (int node = 0; node < band.rest_positions.rows(); ++node)
    if (band.rest_positions(node, 0) < 1e-9)
      band.fixed_nodes.push_back(node);
    else if (band.rest_positions(node, 0) > 75 - 1e-9)
      pull.nodes.push_back(node);
  pull.points.resize(static_cast<Eigen::Index>(pull.nodes.size()), 3);
  const auto pull_by = [&](double part)
  {
    for (std::size_t k = 0; k < pull.nodes.size(); ++k)
      pull.points.row(static_cast<Eigen::Index>(k)) =
          band.rest_positions.row(pull.nodes[k]) + part * Eigen::RowVector3d(1.6, 1, 10);
  };
  pull_by(0);
  model.point_attachments.push_back(pull);
  Registration registration;
  registration.prepare(model, {});
  for (int position = 1; position <= 5; ++position)
  {
    pull_by(0.2 * position);
    registration.move_points(0, pull.points);
    for (int step = 0; step < 3; ++step)
      ASSERT_EQ(registration.update({}).status, StepStatus::ok);
  }
  const Equilibrium equilibrium = registration.settle({}, {.motion_mm = 1e-3, .force_newton = 1e-3, .max_steps = 60});
  EXPECT_TRUE(equilibrium.is_reached) << equilibrium.last_step.largest_motion << " mm, "
                                      << equilibrium.last_step.unbalanced_force << " N";
}
} // namespace pelvireg::registration
