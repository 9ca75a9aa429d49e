// An attached node keeps its place over its triangle: closed forms, differences, and an attached pair that is turned.
#include "registration/constraints/attachment.h"
#include "tests/unit/registration/scene.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace pelvireg::registration
{
namespace
{
Eigen::Vector3d random_vector(std::mt19937 &random)
{
  std::uniform_real_distribution<double> uniform(-1, 1);
  return {uniform(random), uniform(random), uniform(random)};
}

Points turned(const Points &points, const Eigen::Matrix3d &rotation, const Eigen::Vector3d &motion)
{
  return (points * rotation.transpose()).rowwise() + motion.transpose();
}

/// Body 0: nodes inside, outside, beside an edge and beside a corner of the surface of body 1, a block.
struct Pair
{
  std::vector<Body> bodies{Body(), scene::block({8, 6, 4}, {2, 2, 1}, true, true)};
  std::vector<AttachedNode> nodes;

  Pair()
  {
    bodies[0].rest_positions.resize(4, 3);
    bodies[0].rest_positions << 3, 1, 4.7, 5, 4.5, 3.2, 8.4, 2, 4.5, -0.3, -0.2, 4.6;
    const TriangleTree tree(bodies[1].outer_triangles, bodies[1].rest_positions);
    nodes = bind_attachment({"nodes on block", 0, {0, 1, 2, 3}, 1, 0}, bodies, tree, 0);
  }
  const Points &rest(int body) const { return bodies[body].rest_positions; }
};

Points shaken(const Points &points, double size, std::mt19937 &random)
{
  Points result = points;
  for (auto point : result.rowwise())
    point += size * random_vector(random).transpose();
  return result;
}

/// d(gap) / d(node of body) by central differences.
Eigen::Matrix3d difference_quotient(const AttachedNode &node, Points positions_a, Points positions_b, int body,
                                    int index)
{
  constexpr double step = 1e-5;
  Eigen::Matrix3d result;
  for (int axis = 0; axis < 3; ++axis)
  {
    double &coordinate = (body == node.body_a ? positions_a : positions_b)(index, axis);
    const double start = coordinate;
    coordinate = start + step;
    const Eigen::Vector3d ahead = attachment_gap(node, positions_a, positions_b);
    coordinate = start - step;
    result.col(axis) = (ahead - attachment_gap(node, positions_a, positions_b)) / (2 * step);
    coordinate = start;
  }
  return result;
}

/// The same from the rows.
Eigen::Matrix3d derivative_in_rows(const ConstraintRows &rows, int body, int index)
{
  Eigen::Matrix3d result = Eigen::Matrix3d::Zero();
  for (int axis = 0; axis < 3; ++axis)
    for (const RowEntry *entry = rows.begin(axis); entry != rows.end(axis); ++entry)
      if (entry->body == body && entry->node == index)
        result.row(axis) += entry->jacobian.transpose();
  return result;
}

void expect_rows_are_the_derivative(const AttachedNode &node, const Points &positions_a, const Points &positions_b)
{
  ConstraintRows rows;
  add_attachment_rows(node, positions_a, positions_b, rows);
  ASSERT_EQ(rows.size(), 3);
  const Eigen::Vector3d gap = attachment_gap(node, positions_a, positions_b);
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_EQ(rows.gap(axis), -gap[axis]);
  const auto expect_equal = [&](int body, int index)
  {
    EXPECT_LE((derivative_in_rows(rows, body, index) - difference_quotient(node, positions_a, positions_b, body, index))
                  .cwiseAbs()
                  .maxCoeff(),
              1e-8)
        << "body " << body << ", node " << index;
  };
  expect_equal(node.body_a, node.node_a);
  for (const int index : node.nodes_b)
    expect_equal(node.body_b, index);
}

/// Force and moment about the origin that a row's unit multiplier leaves on both bodies together.
Eigen::Matrix<double, 6, 1> wrench(const ConstraintRows &rows, int row, const Points &positions_a,
                                   const Points &positions_b)
{
  Eigen::Matrix<double, 6, 1> sum = Eigen::Matrix<double, 6, 1>::Zero();
  for (const RowEntry *entry = rows.begin(row); entry != rows.end(row); ++entry)
  {
    const Eigen::Vector3d place = (entry->body == 0 ? positions_a : positions_b).row(entry->node).transpose();
    sum.head<3>() += entry->jacobian;
    sum.tail<3>() += place.cross(entry->jacobian);
  }
  return sum;
}
} // namespace

TEST(Attachment, RestIsFreeOfForce)
{
  const Pair pair;
  for (const AttachedNode &node : pair.nodes)
    EXPECT_LE(attachment_gap(node, pair.rest(0), pair.rest(1)).norm(), 1e-14);
}

TEST(Attachment, BothBodiesTurnedTogetherLeaveNoGap)
{
  const Pair pair;
  std::mt19937 random(7);
  for (const double angle : {0.5, 1.0, 1.7, 2.0})
  {
    const Eigen::Matrix3d rotation =
        Eigen::AngleAxisd(angle * std::numbers::pi / 2, random_vector(random).normalized()).toRotationMatrix();
    const Eigen::Vector3d motion = 50 * random_vector(random);
    for (const AttachedNode &node : pair.nodes)
      EXPECT_LE(
          attachment_gap(node, turned(pair.rest(0), rotation, motion), turned(pair.rest(1), rotation, motion)).norm(),
          1e-12);
  }
}

TEST(Attachment, RowsAreTheDerivativeOfTheGap)
{
  const Pair pair;
  std::mt19937 random(11);
  for (int trial = 0; trial < 50; ++trial)
    for (const AttachedNode &node : pair.nodes)
      expect_rows_are_the_derivative(node, shaken(pair.rest(0), 1, random), shaken(pair.rest(1), 0.5, random));
}

// With the gap closed the reaction acts on both bodies at one place, so force and moment answer each other.
TEST(Attachment, ReactionsLeaveNeitherForceNorMoment)
{
  const Pair pair;
  std::mt19937 random(13);
  for (int trial = 0; trial < 50; ++trial)
  {
    Points positions_a = shaken(pair.rest(0), 1, random);
    const Points positions_b = shaken(pair.rest(1), 0.5, random);
    for (const AttachedNode &node : pair.nodes)
    {
      positions_a.row(node.node_a) -= attachment_gap(node, positions_a, positions_b).transpose();
      ConstraintRows rows;
      add_attachment_rows(node, positions_a, positions_b, rows);
      for (int row = 0; row < rows.size(); ++row)
        EXPECT_LE(wrench(rows, row, positions_a, positions_b).cwiseAbs().maxCoeff(), 1e-12);
    }
  }
}

TEST(Attachment, DoesNotDependOnTheOrderOfTheTrianglesNodes)
{
  const Pair pair;
  Triangles triangles = pair.bodies[1].outer_triangles;
  for (auto triangle : triangles.rowwise())
    triangle = Eigen::RowVector3i(triangle[1], triangle[2], triangle[0]);
  const std::vector<AttachedNode> reordered =
      bind_attachment({"nodes on block", 0, {0, 1, 2, 3}, 1, 0}, pair.bodies, TriangleTree(triangles, pair.rest(1)), 0);
  std::mt19937 random(17);
  const Points positions_a = shaken(pair.rest(0), 1, random), positions_b = shaken(pair.rest(1), 0.5, random);
  for (std::size_t k = 0; k < reordered.size(); ++k)
    EXPECT_LE((attachment_gap(reordered[k], positions_a, positions_b) -
               attachment_gap(pair.nodes[k], positions_a, positions_b))
                  .norm(),
              1e-13);
}

TEST(Attachment, ANodeOnTheSurfaceHasTheTrianglesWeightsForRows)
{
  Pair pair;
  pair.bodies[0].rest_positions.row(0) = pair.rest(1).row(pair.bodies[1].outer_triangles(0, 1)); // a node of the block
  pair.bodies[0].rest_positions.row(1) << 3, 1, 4;                                               // inside a triangle
  const TriangleTree tree(pair.bodies[1].outer_triangles, pair.rest(1));
  const std::vector<AttachedNode> nodes = bind_attachment({"on block", 0, {0, 1}, 1, 0}, pair.bodies, tree, 0);
  std::mt19937 random(19);
  const Points positions_b = shaken(pair.rest(1), 0.5, random);
  for (const AttachedNode &node : nodes)
  {
    ConstraintRows rows;
    add_attachment_rows(node, pair.rest(0), positions_b, rows);
    for (int axis = 0; axis < 3; ++axis)
      for (const RowEntry *entry = rows.begin(axis) + 1; entry != rows.end(axis); ++entry)
      {
        const auto corner = std::find(node.nodes_b.begin(), node.nodes_b.end(), entry->node) - node.nodes_b.begin();
        EXPECT_GT(node.weights[corner], 0);
        EXPECT_LE((entry->jacobian + node.weights[corner] * Eigen::Vector3d::Unit(axis)).norm(), 1e-15);
      }
  }
  EXPECT_EQ(nodes[0].weights.maxCoeff(), 1);
  EXPECT_EQ(nodes[0].weights.sum(), 1);
}

// A triangle that the motion squeezes flat loses its normal: the offset shrinks with its area, and all stays finite,
// exact to first order and free of moment on the way.
TEST(Attachment, AFlatTriangleGivesFiniteRowsWithoutAJump)
{
  const Pair pair;
  const AttachedNode &node = pair.nodes[0];
  const auto squeezed = [&](double part)
  {
    Points positions_b = pair.rest(1);
    const Eigen::RowVector3d foot = 0.5 * (positions_b.row(node.nodes_b[0]) + positions_b.row(node.nodes_b[1]));
    positions_b.row(node.nodes_b[2]) = foot + part * (positions_b.row(node.nodes_b[2]) - foot);
    return positions_b;
  };
  expect_rows_are_the_derivative(node, pair.rest(0), squeezed(0.01));
  expect_rows_are_the_derivative(node, pair.rest(0), squeezed(0));
  for (const double part : {0.3, 0.1, 0.03, 0.0})
    EXPECT_LE(
        (attachment_gap(node, pair.rest(0), squeezed(part + 1e-9)) - attachment_gap(node, pair.rest(0), squeezed(part)))
            .norm(),
        1e-6)
        << part;
}

TEST(Attachment, PassesOverTrianglesThatAreFlatAtRest)
{
  Pair pair;
  const Eigen::Index n = pair.bodies[1].outer_triangles.rows();
  Triangles triangles(n + 1, 3);
  triangles.row(0) << 0, 1, 2; // three nodes of an edge; having the lowest index, the first of equally near triangles
  triangles.bottomRows(n) = pair.bodies[1].outer_triangles;
  pair.bodies[0].rest_positions.row(0) = pair.rest(1).row(0) + Eigen::RowVector3d(3, -0.2, -0.3);
  const std::vector<AttachedNode> nodes =
      bind_attachment({"on block", 0, {0}, 1, 0}, pair.bodies, TriangleTree(triangles, pair.rest(1)), 0);
  EXPECT_NE(nodes[0].nodes_b, Eigen::Vector3i(0, 1, 2));
  EXPECT_LE(attachment_gap(nodes[0], pair.rest(0), pair.rest(1)).norm(), 1e-14);
}

namespace
{
/// A block held by its lower half and a free plate that floats 1 mm over its top, attached by its lower nodes.
Model block_and_plate()
{
  Model model;
  model.bodies.push_back(scene::block({12, 12, 6}, {3, 3, 2}, true, true));
  model.bodies.push_back(scene::block({8, 8, 2}, {2, 2, 1}, false, false, {2.5, 1.5, 7}));
  model.bodies[0].name = "block";
  model.bodies[1].name = "plate";
  PointAttachment hold{"hold", 0, {}, {}, 0};
  for (int node = 0; node < model.bodies[0].rest_positions.rows(); ++node)
    if (model.bodies[0].rest_positions(node, 2) < 3.5)
      hold.nodes.push_back(node);
  hold.points = model.bodies[0].rest_positions(hold.nodes, Eigen::all);
  Attachment glue{"plate on block", 1, {}, 0, 0};
  for (int node = 0; node < model.bodies[1].rest_positions.rows(); ++node)
    if (model.bodies[1].rest_positions(node, 2) < 7.5)
      glue.nodes_a.push_back(node);
  model.attachments.push_back(glue);
  model.point_attachments.push_back(hold);
  return model;
}
} // namespace

TEST(Attachment, ABlockTurnedByARightAngleTakesThePlateOverItAlong)
{
  const Model model = block_and_plate();
  Registration registration;
  registration.prepare(model, {});
  const Points rest = model.point_attachments[0].points;
  StepSummary summary;
  double angle = 0;
  const auto rotation = [&]
  { return Eigen::AngleAxisd(angle, Eigen::Vector3d(1, 0.3, -0.2).normalized()).toRotationMatrix(); };
  for (int position = 1; position <= 30; ++position)
  {
    angle = position * std::numbers::pi / 60;
    registration.move_points(0, turned(rest, rotation(), Eigen::Vector3d::Zero()));
    summary = registration.update({});
    ASSERT_EQ(summary.status, StepStatus::ok);
    EXPECT_LE(summary.attachment_residual, 0.01); // a step turns by 0.05: 1 mm of offset leaves 0.05^2 / 2 and less
  }
  const Equilibrium equilibrium = registration.settle({}, {.motion_mm = 1e-9, .force_newton = 1e-9, .max_steps = 400});
  EXPECT_TRUE(equilibrium.is_reached) << equilibrium.last_step.largest_motion;
  EXPECT_LE(equilibrium.last_step.attachment_residual, 1e-12); // the rows' error is of second order in the motion
  for (const int body : {0, 1})
    EXPECT_LE(
        (registration.positions(body) - turned(model.bodies[body].rest_positions, rotation(), Eigen::Vector3d::Zero()))
            .rowwise()
            .norm()
            .maxCoeff(),
        1e-6)
        << body;
}
} // namespace pelvireg::registration
