#include "reference_fe/constraints/cavity.h"
#include "reference_fe/constraints/displacement_probe.h"
#include "reference_fe/constraints/follower_pressure.h"
#include "reference_fe/constraints/tie.h"
#include "reference_fe/outer_surface.h"
#include "tests/unit/reference_fe/terms/difference_quotients.h"
#include "tests/unit/reference_fe/terms/sample_parts.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pelvireg::reference_fe
{
namespace
{
const auto same = [](const Eigen::Vector3d &p) { return p; };
const auto radial = [](const Eigen::Vector3d &p) { return Eigen::Vector3d(p.normalized()); };

std::vector<SurfaceFace> faces_of(const dataset::ReferenceShell &shell, int side)
{
  std::vector<SurfaceFace> faces;
  for (Eigen::Index c = 0; c < shell.cells.rows(); ++c)
    faces.push_back(shell_face(shell, 0, c, side));
  return faces;
}

int n_unknowns(const dataset::ReferenceShell &shell)
{
  return 7 * static_cast<int>(shell.midsurface.rows()) + 1;
}

Eigen::VectorXd total_residual(const Term &term, const Eigen::VectorXd &solution)
{
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(solution.size());
  LocalSystem local;
  for (int item = 0; item < term.n_items(); ++item)
  {
    term.evaluate(item, solution, local);
    for (std::size_t i = 0; i < local.unknowns.size(); ++i)
      sum[local.unknowns[i]] += local.residual[static_cast<Eigen::Index>(i)];
  }
  return sum;
}

TEST(FollowerPressure, TangentIsTheDerivativeOfTheResidualWithItsPressureColumn)
{
  const dataset::ReferenceShell cube = cube_shell(1, same, radial, 0.2);
  const int n = n_unknowns(cube);
  const FollowerPressure term(faces_of(cube, +1), n - 1);
  Eigen::VectorXd solution = 0.1 * scattered(n, 1);
  solution[n - 1] = 0.7;
  EXPECT_LT(tangent_error(term, 2, solution, 1e-5), 1e-8);
}

TEST(FollowerPressure, OnAClosedSurfaceIsSelfEquilibratedAndConjugateToItsVolume)
{
  const dataset::ReferenceShell cube = cube_shell(2, same, radial, 0.2);
  const int n = n_unknowns(cube);
  const FollowerPressure pressure(faces_of(cube, +1), n - 1);
  const Cavity volume("outside", faces_of(cube, +1), n - 1);
  Eigen::VectorXd solution = 0.05 * scattered(n, 2);
  solution[n - 1] = 1;
  const Eigen::VectorXd by_pressure = total_residual(pressure, solution), by_volume = total_residual(volume, solution);
  EXPECT_LT((by_pressure + by_volume).head(n - 1).cwiseAbs().maxCoeff(), 1e-12);
  for (int k = 0; k < 3; ++k)
  {
    double sum = 0;
    for (int node = 0; node < (n - 1) / 7; ++node)
      sum += by_pressure[7 * node + k];
    EXPECT_NEAR(sum, 0, 1e-12);
  }
}

/// Pressure 1 on a sphere of radius 3, set in around the equator: share 1/2 + 3/2 c - 2 c^3 of the height c = z/3
/// between -1/2 and 1/2, 0 below, 1 above.
Eigen::Vector3d force_on_the_upper_half(int n)
{
  const dataset::ReferenceShell sphere = sphere_shell(n, 3, 0);
  std::vector<Eigen::VectorXd> shares;
  for (Eigen::Index c = 0; c < sphere.cells.rows(); ++c)
  {
    Eigen::VectorXd share(9);
    for (int k = 0; k < 9; ++k)
    {
      const double height = std::clamp(sphere.midsurface(sphere.cells(c, k), 2) / 3, -0.5, 0.5);
      share[k] = 0.5 + 1.5 * height - 2 * height * height * height;
    }
    shares.push_back(share);
  }
  const int pressure = n_unknowns(sphere) - 1;
  Eigen::VectorXd solution = Eigen::VectorXd::Zero(pressure + 1);
  solution[pressure] = 1;
  return FollowerPressure(faces_of(sphere, +1), pressure, shares).resultant(solution);
}

TEST(FollowerPressure, PressesByItsShareOnKnownAreasOnEveryMesh)
{
  // -2 pi R^2 int share(c) c dc = -2 pi 9 (0.1 + 0.375)
  const double exact = -2 * std::numbers::pi * 9 * 0.475;
  EXPECT_NEAR(force_on_the_upper_half(3).z() / exact, 1, 4e-3);
  EXPECT_NEAR(force_on_the_upper_half(6).z() / exact, 1, 4e-4);
  EXPECT_LT(force_on_the_upper_half(6).head<2>().norm(), 1e-10);
}

TEST(FollowerPressure, TangentIsExactWithShares)
{
  const dataset::ReferenceShell cube = cube_shell(1, same, radial, 0.2);
  const int n = n_unknowns(cube);
  const std::vector<Eigen::VectorXd> shares(static_cast<std::size_t>(cube.cells.rows()),
                                            Eigen::VectorXd::LinSpaced(9, 0, 1));
  const FollowerPressure term(faces_of(cube, +1), n - 1, shares);
  Eigen::VectorXd solution = 0.1 * scattered(n, 1);
  solution[n - 1] = 0.7;
  EXPECT_LT(tangent_error(term, 2, solution, 1e-5), 1e-8);
}

TEST(Cavity, TangentIsTheDerivativeOfTheResidualAndSymmetric)
{
  const dataset::ReferenceShell cup = cube_shell(1, same, radial, 0.2, true);
  const int n = n_unknowns(cup);
  std::vector<SurfaceNode> rim;
  for (const int node : oriented_rim(cup, cup.rims[0]))
    rim.push_back(shell_node(cup, 0, node, -1));
  std::vector<SurfaceFace> faces = faces_of(cup, -1);
  for (const SurfaceFace &cap : rim_caps(rim))
    faces.push_back(cap);
  const Cavity term("cup", faces, n - 1);
  Eigen::VectorXd solution = 0.1 * scattered(n, 3);
  solution[n - 1] = 0.7;
  LocalSystem local;
  for (const int item : {0, term.n_items() - 2})
  {
    EXPECT_LT(tangent_error(term, item, solution, 1e-5), 1e-8) << "item " << item;
    term.evaluate(item, solution, local);
    EXPECT_LT((local.tangent - local.tangent.transpose()).cwiseAbs().maxCoeff(), 1e-14);
  }
}

TEST(Cavity, LeakingOrHeldAtAPressureHasAnExactTangentToo)
{
  const dataset::ReferenceShell cube = cube_shell(1, same, radial, 0.2);
  const int n = n_unknowns(cube);
  Cavity term("cube", faces_of(cube, -1), n - 1);
  Eigen::VectorXd solution = 0.1 * scattered(n, 3);
  term.leak(7e5);
  term.begin_step(0.25);
  for (const double pressure : {-2e-6, 4e-6, 3e-5}) // under suction, where the outflow sets in, beyond
  {
    solution[n - 1] = pressure;
    for (const int item : {0, 1})
      EXPECT_LT(tangent_error(term, item, solution, 1e-7), 1e-6) << "pressure " << pressure << ", item " << item;
  }
  term.prescribe_pressure(0.3);
  for (const int item : {0, 1})
    EXPECT_LT(tangent_error(term, item, solution, 1e-5), 1e-8) << "item " << item;
}

TEST(Cavity, ACubeWithACapHasItsExactVolumeWhereverItLies)
{
  for (const bool open : {false, true})
  {
    const auto far = [](const Eigen::Vector3d &p) { return Eigen::Vector3d(2 * p + Eigen::Vector3d(100, -50, 30)); };
    const dataset::ReferenceShell cube = cube_shell(2, far, radial, 1e-3, open);
    std::vector<SurfaceFace> faces;
    for (Eigen::Index c = 0; c < cube.cells.rows(); ++c)
      faces.push_back(shell_face(cube, 0, c, 0));
    if (open)
    {
      std::vector<SurfaceNode> rim;
      for (const int node : oriented_rim(cube, cube.rims[0]))
        rim.push_back(shell_node(cube, 0, node, 0));
      for (const SurfaceFace &cap : rim_caps(rim))
        faces.push_back(cap);
    }
    EXPECT_NEAR(Cavity("cube", faces, 0).rest_volume(), 64, 1e-9) << (open ? "open" : "closed");
  }
}

TEST(Cavity, ACapClosesTheSurfaceForForcesToo)
{
  // Without net force under its pressure, for a rim that has been bent out of its plane.
  const dataset::ReferenceShell cup = cube_shell(2, same, radial, 0.2, true);
  const int n = n_unknowns(cup);
  std::vector<SurfaceNode> rim;
  for (const int node : oriented_rim(cup, cup.rims[0]))
    rim.push_back(shell_node(cup, 0, node, -1));
  std::vector<SurfaceFace> faces = faces_of(cup, -1);
  for (const SurfaceFace &cap : rim_caps(rim))
    faces.push_back(cap);
  Eigen::VectorXd solution = 0.1 * scattered(n, 4);
  solution[n - 1] = 1;
  const Eigen::VectorXd force = total_residual(Cavity("cup", faces, n - 1), solution);
  for (int k = 0; k < 3; ++k)
  {
    double sum = 0;
    for (int node = 0; node < (n - 1) / 7; ++node)
      sum += force[7 * node + k];
    EXPECT_NEAR(sum, 0, 1e-12);
  }
}

TEST(Cavity, ASphereOfQuadraticCellsApproachesItsVolumeAtFourthOrder)
{
  // A parabola through three points of a circular arc of half angle t encloses a sector too small by t^4/30 (its
  // leading term). A cell of a sphere has it in both directions, so its volume is too small by 3/2 (t1^4/30 + t2^4/30);
  // cells at the middle of a side are the widest, t = pi/4 over the cells of half a side: t^4/10 bounds the sphere's
  // error.
  double error[2];
  for (int level = 0; level < 2; ++level)
  {
    const int n = 2 << level;
    const dataset::ReferenceShell sphere = sphere_shell(n, 3, 0.2);
    const double exact = 4 * std::numbers::pi / 3 * std::pow(2.9, 3);
    error[level] = 1 - Cavity("sphere", faces_of(sphere, -1), 0).rest_volume() / exact;
    const double bound = std::pow(std::numbers::pi / 4 / n, 4) / 10;
    EXPECT_LT(error[level], bound) << n;
    EXPECT_GT(error[level], 0.5 * bound) << n;
  }
  EXPECT_NEAR(std::log2(error[0] / error[1]), 4, 0.1);
}

TEST(Tie, TangentAndEnergyAgreeAndARigidTranslationCostsNothing)
{
  const dataset::ReferenceShell cube = cube_shell(1, same, radial, 0.2);
  const dataset::ReferenceSolid block = block_solid(1, {2, 2, 2});
  const int first = n_unknowns(cube) - 1, n = first + 3 * static_cast<int>(block.points.rows());
  std::vector<SurfaceFace> faces;
  for (Eigen::Index f = 0; f < block.faces.rows(); ++f)
    faces.push_back(solid_face(block, first, f));
  const Tie tie("tie", {shell_face(cube, 0, 0, +1)}, faces);
  const Eigen::VectorXd solution = 0.1 * scattered(n, 5);
  EXPECT_LT(tangent_error(tie, 4, solution, 1e-5), 1e-8);
  EXPECT_LT(residual_error(tie, 4, solution, 1e-5), 1e-8);

  Eigen::VectorXd translated = Eigen::VectorXd::Zero(n);
  for (int node = 0; node < first / 7; ++node)
    translated.segment<3>(7 * node) << 1, 2, 3;
  for (int i = first; i < n; i += 3)
    translated.segment<3>(i) << 1, 2, 3;
  EXPECT_LT(tie.opening(translated), 1e-12);
  translated.tail(n - first) *= 2;
  EXPECT_NEAR(tie.opening(translated), std::sqrt(14.), 1e-12);
}

class Probe : public ::testing::Test
{
protected:
  Probe()
  {
    plane.origin = {0.1, 0, 0};
    plane.normal = Eigen::Vector3d(1, 0.2, -0.1).normalized();
    const OuterSurface outer = outer_surface(sphere, 0);
    points = probe_points(outer.vertices, outer.triangles, outer.region, plane);
  }
  dataset::ReferenceShell sphere = sphere_shell(4, 10, 1);
  dataset::Plane plane;
  std::vector<ProbePoint> points;
};

TEST_F(Probe, PointsLieInThePlaneOnTheOuterSurfaceAndTheirSharesSumToOne)
{
  double sum = 0;
  for (const ProbePoint &point : points)
  {
    const Eigen::Vector3d x =
        point.weights[0] * point.nodes[0].rest_position() + point.weights[1] * point.nodes[1].rest_position();
    EXPECT_NEAR((x - plane.origin).dot(plane.normal), 0, 1e-12);
    EXPECT_NEAR(x.norm(), 10.5, 0.1);
    sum += point.share;
  }
  EXPECT_NEAR(sum, 1, 1e-12);
}

TEST_F(Probe, ARigidTranslationIsMeasuredByItsInPlanePart)
{
  const int n = n_unknowns(sphere);
  const DisplacementProbe probe(points, plane.normal, n - 1);
  const Eigen::Vector3d move(3, -1, 2);
  Eigen::VectorXd solution = Eigen::VectorXd::Zero(n);
  for (int node = 0; node < n / 7; ++node)
    solution.segment<3>(7 * node) = move;
  EXPECT_NEAR(probe.mean_displacement(solution), (move - move.dot(plane.normal) * plane.normal).norm(), 1e-12);
}

TEST_F(Probe, ItsRowIsTheDerivativeOfTheMeanDisplacement)
{
  const int n = n_unknowns(sphere);
  DisplacementProbe probe(points, plane.normal, n - 1);
  probe.prescribe_displacement(0.5);
  const Eigen::VectorXd solution = 0.1 * scattered(n, 6);
  EXPECT_NEAR(total_residual(probe, solution)[n - 1], probe.mean_displacement(solution) - 0.5, 1e-14);
  LocalSystem local;
  for (const int item : {0, 7, probe.n_items() - 1})
  {
    probe.evaluate(item, solution, local);
    EXPECT_EQ(local.residual.head(local.residual.size() - 1).cwiseAbs().sum(), 0);
    for (std::size_t j = 0; j < local.unknowns.size(); ++j)
    {
      LocalSystem plus, minus;
      Eigen::VectorXd moved = solution;
      moved[local.unknowns[j]] += 1e-5;
      probe.evaluate(item, moved, plus);
      moved[local.unknowns[j]] -= 2e-5;
      probe.evaluate(item, moved, minus);
      const Eigen::Index last = local.residual.size() - 1;
      EXPECT_NEAR(local.tangent(last, static_cast<Eigen::Index>(j)),
                  (plus.residual[last] - minus.residual[last]) / 2e-5, 1e-9);
    }
  }
}

TEST_F(Probe, APrescribedPressureIsARowOfItsOwn)
{
  const int n = n_unknowns(sphere);
  DisplacementProbe probe(points, plane.normal, n - 1);
  probe.prescribe_pressure(0.25);
  Eigen::VectorXd solution = Eigen::VectorXd::Zero(n);
  solution[n - 1] = 1;
  EXPECT_DOUBLE_EQ(total_residual(probe, solution)[n - 1], 0.75);
}
} // namespace
} // namespace pelvireg::reference_fe
