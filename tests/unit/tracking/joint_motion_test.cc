#include "registration/tracking/joint_motion.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace pelvireg::tracking
{
namespace
{
using Eigen::Vector2d;

const Eigen::Matrix2d certain = 100 * Eigen::Matrix2d::Identity(); // standard deviation 0.1 px

std::vector<Vector2d> circle(int n)
{
  std::vector<Vector2d> joints;
  for (int i = 0; i < n; ++i)
  {
    const double angle = 2 * std::numbers::pi * i / n;
    joints.emplace_back(50 + 20 * std::cos(angle), 50 + 20 * std::sin(angle));
  }
  return joints;
}

/// Turn by 0.2, stretch by 1.1, shift.
std::vector<Vector2d> moved(const std::vector<Vector2d> &joints)
{
  const Eigen::Matrix2d map = 1.1 * Eigen::Rotation2Dd(0.2).toRotationMatrix();
  std::vector<Vector2d> all;
  for (const Vector2d &joint : joints)
    all.push_back(Vector2d(57, 46) + map * (joint - Vector2d(50, 50)));
  return all;
}

std::vector<JointMeasurement> seen(const std::vector<Vector2d> &positions)
{
  std::vector<JointMeasurement> measured;
  for (const Vector2d &position : positions)
    measured.push_back({position, certain, true});
  return measured;
}
} // namespace

TEST(MeanDeformation, OfAnAffineMapIsItsLinearPart)
{
  Eigen::Matrix2d map;
  map << 1.2, 0.3, -0.1, 0.9;
  std::vector<Vector2d> after;
  for (const Vector2d &joint : circle(16))
    after.push_back(map * joint + Vector2d(3, -4));
  EXPECT_LT((mean_deformation(circle(16), after) - map).norm(), 1e-4); // 1e-6 keeps flat outlines defined
}

TEST(MoveJoints, FollowsATurnAStretchAndAShiftExactly)
{
  const std::vector<Vector2d> rest = circle(16), truth = moved(rest);
  const std::vector<Vector2d> joints = move_joints(rest, rest, seen(truth), {});
  for (std::size_t i = 0; i < rest.size(); ++i)
    EXPECT_LT((joints[i] - truth[i]).norm(), 0.03); // the stretch since rest costs a little: 1.1 is 10 % off
}

TEST(MoveJoints, CarriesAJointThatIsNotSeenWithItsNeighbours)
{
  const std::vector<Vector2d> rest = circle(16), truth = moved(rest);
  std::vector<JointMeasurement> measured = seen(truth);
  measured[5].precision.setZero();
  measured[5].position.setZero();
  EXPECT_LT((move_joints(rest, rest, measured, {})[5] - truth[5]).norm(), 0.1);
}

TEST(MoveJoints, DoesNotBelieveOneJointAgainstItsNeighbours)
{
  const std::vector<Vector2d> rest = circle(16), truth = moved(rest);
  std::vector<JointMeasurement> measured = seen(truth);
  measured[5].position += Vector2d(6, -3);
  const std::vector<Vector2d> joints = move_joints(rest, rest, measured, {});
  EXPECT_LT((joints[5] - truth[5]).norm(), 1);
  EXPECT_LT((joints[9] - truth[9]).norm(), 0.05);
}

TEST(MoveJoints, TakesThePlaceAlongAStraightBorderFromTheNeighbours)
{
  const std::vector<Vector2d> rest = circle(16), truth = moved(rest);
  std::vector<JointMeasurement> measured = seen(truth);
  // Seen across the border alone; along it, 3 px wrong and with next to no weight.
  const Vector2d across = (truth[5] - Vector2d(57, 46)).normalized(), along(-across.y(), across.x());
  measured[5].precision = 100 * across * across.transpose() + 1e-3 * along * along.transpose();
  measured[5].position += 3 * along;
  EXPECT_LT((move_joints(rest, rest, measured, {})[5] - truth[5]).norm(), 0.1);
}

TEST(MoveJoints, StaysWhereItIsWhenNothingIsSeen)
{
  const std::vector<Vector2d> rest = circle(16);
  std::vector<JointMeasurement> measured(16);
  const std::vector<Vector2d> joints = move_joints(rest, rest, measured, {});
  for (std::size_t i = 0; i < rest.size(); ++i)
    EXPECT_LT((joints[i] - rest[i]).norm(), 1e-3);
}
} // namespace pelvireg::tracking
