#include "registration/registration.h"
#include "tests/unit/registration/scene.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <tuple>
#include <vector>

namespace pelvireg::registration
{
namespace
{
const Eigen::Vector3d plane_normal = Eigen::Vector3d(1, 0.04, 0.03).normalized();
const Eigen::Vector3d plane_origin(0.3, 0, 0);

/// The organs' outlines at rest, moved by `motions`; zero motion keeps an organ where it is.
Observation outlines(const Model &model, const std::vector<Eigen::Vector3d> &motions)
{
  Observation observation;
  observation.plane_origin = plane_origin;
  observation.plane_normal = plane_normal;
  for (int body = 0; body < static_cast<int>(motions.size()); ++body)
  {
    observation.outlines.push_back(
        scene::outline(model.bodies[body], body, model.bodies[body].rest_positions, plane_origin, plane_normal, 2));
    const Eigen::Vector3d in_plane = motions[body] - motions[body].dot(plane_normal) * plane_normal;
    observation.outlines.back().points.rowwise() += in_plane.transpose();
  }
  return observation;
}

/// Two hollow organs one above the other, 1 mm apart, the lower one held by a band on its left. The plane cuts both
/// 12 mm beside the axis on which they meet, so contact happens where it sees nothing.
Model two_organs(bool with_contact)
{
  Model model;
  model.bodies.push_back(scene::hollow_ellipsoid({22, 20, 15}, 3, 3, {12, 0, 0}));
  model.bodies.push_back(scene::hollow_ellipsoid({22, 20, 15}, 3, 3, {12, 0, -31}));
  model.bodies.push_back(scene::block({20, 6, 6}, {4, 1, 1}, false, false, {32, -3, -34}));
  model.bodies[0].name = "upper";
  model.bodies[1].name = "lower";
  model.bodies[2].name = "band";
  Attachment attachment{"band on lower", 2, {}, 1, 0};
  for (int node = 0; node < model.bodies[2].rest_positions.rows(); ++node)
    if (model.bodies[2].rest_positions(node, 0) > 51)
      model.bodies[2].fixed_nodes.push_back(node);
    else if (model.bodies[2].rest_positions(node, 0) < 33)
      attachment.nodes_a.push_back(node);
  model.attachments.push_back(attachment);
  if (with_contact)
    model.contact_pairs.push_back({0, 1});
  return model;
}

/// The same with a band on either side of each organ, as every organ of `full` is held.
Model two_held_organs()
{
  Model model = two_organs(true);
  for (const auto &[organ, height, x] : {std::tuple(0, 0.0, 32.0), {0, 0.0, -28.0}, {1, -31.0, -28.0}})
  {
    const int band = static_cast<int>(model.bodies.size());
    model.bodies.push_back(scene::block({20, 6, 6}, {4, 1, 1}, false, false, {x, -3, height - 3}));
    model.bodies.back().name = "band " + std::to_string(band);
    Attachment attachment{"band " + std::to_string(band), band, {}, organ, 0};
    for (int node = 0; node < model.bodies[band].rest_positions.rows(); ++node)
    {
      const double far = (model.bodies[band].rest_positions(node, 0) - 12) * (x > 0 ? 1 : -1);
      if (far > 39)
        model.bodies[band].fixed_nodes.push_back(node);
      else if (far < 21)
        attachment.nodes_a.push_back(node);
    }
    model.attachments.push_back(attachment);
  }
  return model;
}

double mean_motion(const Registration &registration, const Model &model, int body, int axis)
{
  return (registration.positions(body) - model.bodies[body].rest_positions).col(axis).mean();
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

TEST(ContactStep, KeepsOrgansApartWhereThePlaneSeesNothing)
{
  for (const bool with_contact : {false, true})
  {
    const Model model = two_organs(with_contact);
    Registration registration;
    registration.prepare(model, {});
    for (int position = 1; position <= 8; ++position)
      for (int step = 0; step < 3; ++step)
      {
        const StepSummary summary = registration.update(outlines(model, {{0, 0, -0.5 * position}}));
        ASSERT_EQ(summary.status, StepStatus::ok);
        EXPECT_EQ(summary.n_open_rays, 0);
        EXPECT_LE(summary.cone_violation, 1e-12);
        EXPECT_LE(summary.contact_motion_residual, 1e-5);
        // Two paraboloids that touch in a point: a cell's mean depth is zero when they are 0.58 of the margin deep.
        EXPECT_TRUE(step < 2 || summary.penetration_depth <= 0.6 * Options().contact_margin)
            << summary.penetration_depth;
        if (step == 2 && position == 8)
        {
          EXPECT_EQ(summary.n_contacts > 0, with_contact);
          EXPECT_EQ(summary.contact_force > 0.01, with_contact);
          EXPECT_LE(summary.mean_in_plane_residual, 0.1);
        }
      }
    // Pushed down by 4 mm over a gap of 1 mm: the lower organ gives way, or is run through.
    EXPECT_EQ(mean_motion(registration, model, 1, 2) < -1, with_contact);
  }
}

TEST(ContactStep, SaysWhichPairTouchesAndHowHard)
{
  const Model model = two_held_organs();
  Registration registration;
  registration.prepare(model, {});
  for (int step = 1; step <= 10; ++step)
    registration.update(outlines(model, {{0, 0, -0.4 * step}}));
  ASSERT_EQ(registration.penetrations().size(), 1u);
  EXPECT_GT(registration.penetrations()[0].force.z(), 0.05); // the upper organ is pushed up
  EXPECT_EQ(registration.penetrations()[0].body_a, 0);
  EXPECT_EQ(registration.penetrations()[0].body_b, 1);
  EXPECT_GT(registration.penetrations()[0].n_contacts, 1);
}

TEST(ContactStep, RecoversFromADeepOverlapAtABoundedRate)
{
  Model model = two_organs(true);
  model.bodies[0].rest_positions.col(2).array() -= 7; // 6 mm deep at rest
  Options options;
  options.friction_coefficient = 0;
  Registration registration;
  registration.prepare(model, options);
  EXPECT_NEAR(registration.penetrations()[0].depth, 6, 0.5);
  double last_depth = registration.penetrations()[0].depth;
  const Observation observation = outlines(model, {Eigen::Vector3d::Zero()});
  for (int step = 0; step < 40; ++step)
  {
    const StepSummary summary = registration.update(observation);
    ASSERT_EQ(summary.status, StepStatus::ok) << step;
    // Every cell recovers max_recovery in the mean; its deepest ray somewhat more.
    EXPECT_LE(last_depth - summary.penetration_depth, 1.3 * options.max_recovery) << step;
    last_depth = summary.penetration_depth;
  }
  EXPECT_LE(last_depth, 0.4);
}

TEST(ContactStep, DrivesOutABodyThatLiesInsideTheOther)
{
  Model model;
  model.bodies.push_back(scene::hollow_ellipsoid({22, 22, 22}, 3, 3));
  model.bodies.push_back(scene::hollow_ellipsoid({5, 5, 5}, 2, 2, {2, 3, 12}));
  model.bodies[0].name = "outer";
  model.bodies[1].name = "inner";
  model.contact_pairs.push_back({0, 1});
  Registration registration;
  registration.prepare(model, {});
  const Observation observation = outlines(model, {Eigen::Vector3d::Zero()});
  StepSummary summary;
  for (int step = 0; step < 60; ++step)
  {
    summary = registration.update(observation);
    ASSERT_EQ(summary.status, StepStatus::ok) << step;
  }
  EXPECT_LE(summary.penetration_depth, 0.5);
  EXPECT_GT((registration.positions(1).colwise().mean() - registration.positions(0).colwise().mean()).norm(), 24);
}

// Three slabs, 0.3 mm into each other at rest, the outer ones held at their far faces. The middle one is seen by
// nothing and rests where both push it alike.
TEST(ContactStep, PassesForcesThroughAStack)
{
  Model model;
  for (const auto &[half, height, low] : {std::tuple(12.0, 9.0, -9.0), {10.0, 9.0, -0.3}, {12.0, 9.0, 8.4}})
  {
    model.bodies.push_back(scene::block({2 * half, 2 * half, height}, {4, 4, 2}, true, true, {-half, -half, low}));
    Body &slab = model.bodies.back();
    slab.name = "slab " + std::to_string(model.bodies.size());
    for (int node = 0; node < slab.rest_positions.rows(); ++node)
      if (std::abs(slab.rest_positions(node, 2) - 4.2) > 13)
        slab.fixed_nodes.push_back(node);
  }
  model.contact_pairs = {{0, 1}, {2, 1}};
  Registration registration;
  registration.prepare(model, {});
  const Observation observation = outlines(model, {Eigen::Vector3d::Zero()});
  Equilibrium equilibrium =
      registration.settle(observation, {.motion_mm = 1e-3, .force_newton = 5e-3, .max_steps = 200});
  ASSERT_EQ(equilibrium.last_step.status, StepStatus::ok);
  EXPECT_TRUE(equilibrium.is_reached) << equilibrium.last_step.largest_motion << " "
                                      << equilibrium.last_step.unbalanced_force;
  const Eigen::Vector3d below = registration.penetrations()[0].force, above = registration.penetrations()[1].force;
  EXPECT_LT(below.z(), -1);
  EXPECT_LE((below + above).norm(), 0.02 * below.norm());
  // The lower slab's outline is held as well, so it gives way less than the upper one.
  EXPECT_GT(mean_motion(registration, model, 1, 2), 0);
  EXPECT_LT(mean_motion(registration, model, 1, 2), 0.1);
  EXPECT_LE(equilibrium.last_step.penetration_depth, 0.1);
}

// Paper, section 5.2: h does not influence the converged configurations. With friction neither: slip counts from where
// the organs lay when the image changed, not from step to step, so how many steps it took does not matter.
TEST(ContactStep, ConvergesToTheSameConfigurationForEveryTimeStep)
{
  const Model model = two_held_organs();
  for (const double friction : {0.0, 0.1, 0.6, 1.0})
  {
    std::vector<Points> first;
    double worst = 0;
    for (const double h : {0.005, 0.02, 0.05})
    {
      Options options;
      options.time_step = h;
      options.friction_coefficient = friction;
      Registration registration;
      registration.prepare(model, options);
      for (int position = 1; position <= 2; ++position)
      {
        const Equilibrium equilibrium =
            registration.settle(outlines(model, {{0, 0.5 * position, -2.0 * position}}),
                                {.motion_mm = 1e-4, .force_newton = 2e-3, .max_steps = 300});
        EXPECT_TRUE(equilibrium.is_reached)
            << h << " " << friction << " " << position << ": " << equilibrium.last_step.largest_motion << " mm, "
            << equilibrium.last_step.unbalanced_force << " N";
        RecordProperty("steps_" + std::to_string(h) + "_" + std::to_string(friction) + "_" + std::to_string(position),
                       equilibrium.n_steps);
      }
      for (std::size_t body = 0; body < model.bodies.size(); ++body)
        if (first.size() < model.bodies.size())
          first.push_back(registration.positions(static_cast<int>(body)));
        else
          worst = std::max(worst,
                           (registration.positions(static_cast<int>(body)) - first[body]).rowwise().norm().maxCoeff());
    }
    RecordProperty("worst_" + std::to_string(friction), std::to_string(worst));
    EXPECT_LE(worst, friction == 0 ? 0.005 : 0.01) << friction; // of 4 mm
  }
}

// Pressed together, then moved along each other: the lower organ, which only its bands and the contact move, comes
// along the more the rougher they are, and never by more than mu times the pressing force pulls.
TEST(ContactStep, DragsAnOrganAlongByFriction)
{
  const Model model = two_held_organs();
  std::vector<double> dragged;
  for (const double friction : {0.0, 0.1, 0.6})
  {
    Options options;
    options.friction_coefficient = friction;
    Registration registration;
    registration.prepare(model, options);
    for (int step = 1; step <= 20; ++step)
    {
      const StepSummary summary =
          registration.update(outlines(model, {{0, 0.15 * std::max(0, step - 8), -0.4 * std::min(step, 8)}}));
      ASSERT_EQ(summary.status, StepStatus::ok);
      EXPECT_LE(summary.cone_violation, 1e-12);
    }
    dragged.push_back(mean_motion(registration, model, 1, 1));
  }
  EXPECT_GT(dragged[1], dragged[0] + 0.02);
  EXPECT_GT(dragged[2], dragged[1] + 0.05);
}

TEST(ContactStep, GivesTheSameBytesForOneAndTwoThreads)
{
  const Model model = two_organs(true);
  std::vector<Points> first;
  for (const int n_threads : {1, 2, 2})
  {
    Options options;
    options.n_threads = n_threads;
    Registration registration;
    registration.prepare(model, options);
    StepSummary summary;
    for (int step = 1; step <= 8; ++step)
      summary = registration.update(outlines(model, {{0, 0.1 * step, -0.5 * step}}));
    ASSERT_EQ(summary.status, StepStatus::ok);
    EXPECT_GT(summary.contact_force, 0);
    for (int body = 0; body < 3; ++body)
      if (n_threads == 1)
        first.push_back(registration.positions(body));
      else
        EXPECT_EQ(std::memcmp(first[body].data(), registration.positions(body).data(),
                              sizeof(double) * static_cast<std::size_t>(first[body].size())),
                  0);
  }
}

TEST(ContactStep, LeavesOutWhatIsAttached)
{
  // The lower organ's top is glued into the upper one, 3 mm deep: overlap by design.
  Model model = two_organs(true);
  model.bodies[0].rest_positions.col(2).array() -= 4;
  Attachment glue{"lower on upper", 1, {}, 0, 0};
  for (int node = 0; node < model.bodies[1].rest_positions.rows() / 2; ++node)
    if (model.bodies[1].rest_positions(node, 2) > -22)
      glue.nodes_a.push_back(node);
  model.attachments.push_back(glue);
  Registration registration;
  registration.prepare(model, {});
  EXPECT_EQ(registration.penetrations()[0].n_contacts, 0);
  EXPECT_EQ(registration.penetrations()[0].volume, 0);
  const StepSummary summary = registration.update(outlines(model, {Eigen::Vector3d::Zero()}));
  EXPECT_EQ(summary.status, StepStatus::ok);
  EXPECT_LE(summary.largest_motion, 1e-6);
}

TEST(ContactStep, SaysWhatIsWrongWithAContactPair)
{
  Model bad = two_organs(false);
  bad.contact_pairs = {{0, 7}};
  EXPECT_NE(prepare_message(bad).find("contact pair 0: body 7 does not exist"), std::string::npos);
  bad.contact_pairs = {{1, 1}};
  EXPECT_NE(prepare_message(bad).find("joins body 1 to itself"), std::string::npos);
  bad.contact_pairs = {{0, 2}};
  EXPECT_NE(prepare_message(bad).find("'band' has no outer triangles"), std::string::npos);
  bad.contact_pairs = {{0, 1}, {1, 0}};
  EXPECT_NE(prepare_message(bad).find("contact pair 1: bodies 1 and 0 are paired twice"), std::string::npos);
}

TEST(ContactStep, RefusesOptionsOutOfRange)
{
  const auto message_with = [](const auto &change)
  {
    Options options;
    change(options);
    return prepare_message(two_organs(true), options);
  };
  const double nan = std::nan("");
  EXPECT_NE(message_with([&](Options &o) { o.friction_coefficient = -0.1; }).find("friction_coefficient"),
            std::string::npos);
  EXPECT_NE(message_with([&](Options &o) { o.contact_pixel = 0.04; }).find("contact_pixel"), std::string::npos);
  EXPECT_NE(message_with([&](Options &o) { o.contact_cell = 0.5; }).find("contact_cell"), std::string::npos);
  EXPECT_NE(message_with([&](Options &o) { o.contact_margin = 0; }).find("contact_margin"), std::string::npos);
  EXPECT_NE(message_with([&](Options &o) { o.contact_compliance = nan; }).find("contact_compliance"),
            std::string::npos);
  EXPECT_NE(message_with([&](Options &o) { o.max_recovery = 0; }).find("max_recovery"), std::string::npos);
  EXPECT_NE(message_with([&](Options &o) { o.tolerance_newton = nan; }).find("tolerance_newton"), std::string::npos);
  EXPECT_NE(message_with([&](Options &o) { o.reserved_contacts = -1; }).find("reserved_contacts"), std::string::npos);
  EXPECT_NE(message_with([&](Options &o) { o.reserved_control_points = -1; }).find("reserved_control_points"),
            std::string::npos);
}

TEST(Settle, StopsAtAFailedStepAndRefusesItsTolerances)
{
  const Model model = two_organs(true);
  Registration registration;
  registration.prepare(model, {});
  Observation nothing;
  const Equilibrium equilibrium = registration.settle(nothing);
  EXPECT_FALSE(equilibrium.is_reached);
  EXPECT_EQ(equilibrium.n_steps, 1);
  EXPECT_EQ(equilibrium.last_step.status, StepStatus::no_control_points);
  EXPECT_THROW(registration.settle(nothing, {.motion_mm = 0}), std::invalid_argument);
  EXPECT_THROW(registration.settle(nothing, {.force_newton = std::nan("")}), std::invalid_argument);
  EXPECT_THROW(registration.settle(nothing, {.max_steps = 0}), std::invalid_argument);
  EXPECT_THROW(Registration().settle(nothing), std::logic_error);
}

TEST(ContactStep, ASolutionThatThrowsAnOrganAwayIsAStatusAndChangesNothing)
{
  const Model model = two_organs(true);
  Options options;
  options.max_match_distance = 1e6;
  options.time_step = 1; // nothing holds the upper organ
  Registration registration;
  registration.prepare(model, options);
  const StepSummary summary = registration.update(outlines(model, {{0, 0, 5000}}));
  EXPECT_EQ(summary.status, StepStatus::diverged);
  EXPECT_EQ(registration.positions(0), model.bodies[0].rest_positions);
  EXPECT_EQ(registration.update(outlines(model, {{0, 0, 0}})).status, StepStatus::ok);
}
} // namespace pelvireg::registration
