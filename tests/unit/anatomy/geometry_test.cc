// What the generated meshes must be: separate, closed, outward, positive (issue A, item 2).
#include "tests/unit/anatomy/cases.h"
#include "tests/unit/anatomy/surfaces.h"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <numbers>
#include <set>

namespace pelvireg::test
{
namespace
{
using dataset::SurfaceMesh;
using dataset::SurfaceRegion;
using Eigen::Vector3d;

constexpr double least_gap = 0.5; // mm, issue A
constexpr auto patch_region = static_cast<std::int32_t>(SurfaceRegion::cervix_patch);
INSTANTIATE_TEST_SUITE_P(Anatomy, EveryCase, testing::Values("t005", "t007", "quick"),
                         [](const auto &instance) { return instance.param; });

void expect_separate(const std::map<std::string, SurfaceMesh> &surfaces)
{
  for (auto a = surfaces.begin(); a != surfaces.end(); ++a)
    for (auto b = std::next(a); b != surfaces.end(); ++b)
    {
      if (a->first == "uterus" && b->first == "vagina") // they share the patch: see the next test
        continue;
      const Gap gap = gap_between(a->second, b->second);
      EXPECT_TRUE(gap.distance >= least_gap)
          << a->first << " and " << b->first << ": " << gap.distance << " mm at " << gap.where.transpose();
    }
}

TEST_P(EveryCase, KeepsHalfAMillimetreBetweenOrgansAndFloor)
{
  // Surfaces that do not meet and lie outside of each other's boxes somewhere do not overlap.
  expect_separate(reference_surfaces(anatomy().reference));
  expect_separate(registration_surfaces(anatomy().registration));
}

TEST_P(EveryCase, HasUterusAndVaginaOnTheTwoSidesOfTheirSharedPlanarPatch)
{
  for (const auto &surfaces : {reference_surfaces(anatomy().reference), registration_surfaces(anatomy().registration)})
  {
    const SurfaceMesh &uterus = surfaces.at("uterus"), &vagina = surfaces.at("vagina");
    std::set<std::int32_t> on_patch;
    Vector3d normal = Vector3d::Zero();
    for (Eigen::Index t = 0; t < uterus.triangles.rows(); ++t)
      if (uterus.region[t] == patch_region)
      {
        on_patch.insert(uterus.triangles.row(t).begin(), uterus.triangles.row(t).end());
        const Vector3d a = uterus.points.row(uterus.triangles(t, 0)), b = uterus.points.row(uterus.triangles(t, 1));
        const Vector3d c = uterus.points.row(uterus.triangles(t, 2));
        normal += (b - a).cross(c - a) / 2;
      }
    ASSERT_GT(on_patch.size(), 10u);
    const double area = normal.norm();
    normal.normalize(); // out of the uterus
    const Vector3d origin = uterus.points.row(*on_patch.begin());
    EXPECT_GT(area, std::numbers::pi * 10 * 10 * 0.9) << "a patch 20 to 24 mm across";
    EXPECT_LT(area, std::numbers::pi * 12 * 12 * 1.1);
    for (Eigen::Index i = 0; i < uterus.points.rows(); ++i)
    {
      const double height = normal.dot(Vector3d(uterus.points.row(i)) - origin);
      EXPECT_LE(height, 1e-9) << "uterus node " << i;
      if (on_patch.count(static_cast<std::int32_t>(i)) > 0)
      {
        EXPECT_NEAR(height, 0, 1e-9);
      }
    }
    double nearest = 1e9;
    for (Eigen::Index i = 0; i < vagina.points.rows(); ++i)
    {
      const double height = normal.dot(Vector3d(vagina.points.row(i)) - origin);
      EXPECT_GE(height, -1e-9) << "vagina node " << i;
      nearest = std::min(nearest, height);
    }
    EXPECT_NEAR(nearest, 0, 1e-9) << "the vagina must reach the patch";
  }
}

TEST_P(EveryCase, LeavesUterusAndVaginaApartAwayFromThePatch)
{
  const auto surfaces = reference_surfaces(anatomy().reference);
  EXPECT_GE(gap_between(surfaces.at("uterus"), surfaces.at("vagina"), 3).distance, least_gap);
}

TEST_P(EveryCase, MarksThePatchOnTheVaginaWhereTheUterusEnds)
{
  const auto surfaces = reference_surfaces(anatomy().reference);
  const auto area_and_centre = [](const SurfaceMesh &mesh)
  {
    double area = 0;
    Vector3d centre = Vector3d::Zero();
    for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t)
      if (mesh.region[t] == patch_region)
      {
        const Vector3d a = mesh.points.row(mesh.triangles(t, 0)), b = mesh.points.row(mesh.triangles(t, 1));
        const Vector3d c = mesh.points.row(mesh.triangles(t, 2));
        const double piece = (b - a).cross(c - a).norm() / 2;
        area += piece;
        centre += piece * (a + b + c) / 3;
      }
    return std::pair{area, Vector3d(centre / area)};
  };
  const auto [uterus_area, uterus_centre] = area_and_centre(surfaces.at("uterus"));
  const auto [vagina_area, vagina_centre] = area_and_centre(surfaces.at("vagina"));
  // Whole cells are marked: the area may be off by half a cell along the patch's perimeter, the centre by half a cell.
  const double cell = GetParam() == "quick" ? 15 : 6.6, perimeter = 2 * std::sqrt(std::numbers::pi * uterus_area);
  EXPECT_LT((uterus_centre - vagina_centre).norm(), cell / 2);
  EXPECT_LT(std::abs(vagina_area - uterus_area), perimeter * cell / 2);
}

/// Every directed edge once, its opposite once.
void expect_closed_manifold(const SurfaceMesh &mesh, const std::string &name)
{
  std::map<std::pair<int, int>, int> edges;
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t)
    for (int k = 0; k < 3; ++k)
      ++edges[{mesh.triangles(t, k), mesh.triangles(t, (k + 1) % 3)}];
  for (const auto &[edge, n] : edges)
  {
    EXPECT_EQ(n, 1) << name << " edge " << edge.first << " " << edge.second;
    EXPECT_EQ(edges.count({edge.second, edge.first}), 1u)
        << name << " is open at edge " << edge.first << " " << edge.second;
  }
  // Euler characteristic of a sphere: one piece without handles (a second sheet would add 2).
  std::set<int> nodes;
  for (Eigen::Index i = 0; i < mesh.triangles.size(); ++i)
    nodes.insert(mesh.triangles.data()[i]);
  EXPECT_EQ(static_cast<long>(nodes.size()) - static_cast<long>(edges.size()) / 2 + mesh.triangles.rows(), 2) << name;
}

TEST_P(EveryCase, HasClosedManifoldOutwardSurfaces)
{
  const bool is_t007 = std::string(GetParam()) == "t007"; // the larger pelvis with the fuller bladder
  const std::map<std::string, std::pair<double, double>> millilitres = {
      {"bladder", is_t007 ? std::pair(150., 190.) : std::pair(90., 120.)},
      {"vagina", is_t007 ? std::pair(25., 40.) : std::pair(18., 30.)},
      {"uterus", {45, 75}},
      {"rectum", {55, 90}}};
  for (const auto &[name, surface] : registration_surfaces(anatomy().registration))
  {
    expect_closed_manifold(surface, name);
    const double volume = enclosed_volume(surface) / 1000;
    EXPECT_GT(volume, millilitres.at(name).first) << name << " (a negative volume is an inward surface)";
    EXPECT_LT(volume, millilitres.at(name).second) << name;
  }
  for (const dataset::ReferenceSolid &solid : anatomy().reference.solids)
  {
    expect_closed_manifold(outer_surface(solid), solid.name);
    EXPECT_GT(enclosed_volume(outer_surface(solid)), 45000);
  }
  const SurfaceMesh bladder = outer_surface(shell_of(anatomy(), "bladder"));
  expect_closed_manifold(bladder, "bladder shell");
  EXPECT_GT(enclosed_volume(bladder), 90000);
}

TEST_P(EveryCase, CapsOnlyTheOpenEndsOfTheTubesWithRimNodes)
{
  const std::map<std::string, std::size_t> open_ends = {{"bladder", 0}, {"vagina", 1}, {"uterus", 0}, {"rectum", 2}};
  for (const auto &[name, n_ends] : open_ends)
  {
    const dataset::RegistrationBody &body = body_of(anatomy(), name);
    std::set<std::int32_t> wall, cap;
    for (Eigen::Index t = 0; t < body.outer_triangles.rows(); ++t)
    {
      auto &nodes = body.outer_region[t] == static_cast<std::int32_t>(SurfaceRegion::cap) ? cap : wall;
      nodes.insert(body.outer_triangles.row(t).begin(), body.outer_triangles.row(t).end());
    }
    EXPECT_EQ(cap.empty(), n_ends == 0) << name;
    for (const std::int32_t node : cap)
      EXPECT_EQ(wall.count(node), 1u) << name << ": a cap has a node of its own";
    if (name != "uterus")
    {
      EXPECT_EQ(shell_of(anatomy(), name).rims.size(), n_ends);
    }
  }
}

double volume(const dataset::Points &x, Eigen::RowVector4i tet)
{
  Eigen::Matrix3d edges;
  edges << x.row(tet[1]) - x.row(tet[0]), x.row(tet[2]) - x.row(tet[0]), x.row(tet[3]) - x.row(tet[0]);
  return edges.determinant() / 6;
}

TEST_P(EveryCase, HasPositiveTetrahedraThatFillTheWallOnce)
{
  for (const dataset::RegistrationBody &body : anatomy().registration.bodies)
  {
    if (body.tets.rows() == 0)
      continue;
    double total = 0;
    std::map<std::array<int, 3>, int> faces;
    for (Eigen::Index t = 0; t < body.tets.rows(); ++t)
    {
      const double v = volume(body.points, body.tets.row(t));
      EXPECT_GT(v, 0) << body.name << " tetrahedron " << t;
      total += v;
      for (int k = 0; k < 4; ++k)
      {
        std::array<int, 3> face = {body.tets(t, (k + 1) % 4), body.tets(t, (k + 2) % 4), body.tets(t, (k + 3) % 4)};
        std::sort(face.begin(), face.end());
        EXPECT_LE(++faces[face], 2) << body.name << ": three tetrahedra on one face";
      }
    }
    // Conforming: every wall triangle of the outer surface bounds exactly one tetrahedron.
    for (Eigen::Index t = 0; t < body.outer_triangles.rows(); ++t)
    {
      std::array<int, 3> face = {body.outer_triangles(t, 0), body.outer_triangles(t, 1), body.outer_triangles(t, 2)};
      std::sort(face.begin(), face.end());
      EXPECT_EQ(faces[face], body.outer_region[t] == static_cast<std::int32_t>(SurfaceRegion::cap) ? 0 : 1)
          << body.name;
    }
    const double enclosed = enclosed_volume({body.points, body.outer_triangles, body.outer_region});
    if (body.name == "uterus")
    {
      EXPECT_NEAR(total / enclosed, 1, 1e-9);
    }
    else
    {
      EXPECT_LT(total, 0.8 * enclosed) << body.name << " is not hollow";
    }
  }
}

TEST_P(EveryCase, HasHexahedraPositiveAtEveryCorner)
{
  static const int next[8][3] = {{1, 3, 4}, {2, 0, 5}, {3, 1, 6}, {0, 2, 7},
                                 {7, 5, 0}, {4, 6, 1}, {5, 7, 2}, {6, 4, 3}};
  for (const dataset::RegistrationBody &body : anatomy().registration.bodies)
    for (Eigen::Index h = 0; h < body.hexes.rows(); ++h)
      for (int c = 0; c < 8; ++c)
      {
        Eigen::Matrix3d edges;
        for (int k = 0; k < 3; ++k)
          edges.row(k) = body.points.row(body.hexes(h, next[c][k])) - body.points.row(body.hexes(h, c));
        EXPECT_GT(edges.determinant(), 0) << body.name << " hexahedron " << h << " corner " << c;
      }
}

/// d/dxi and d/deta of nine nodal values at (xi, eta) in [-1, 1]^2, VTK_BIQUADRATIC_QUAD order.
Eigen::Matrix<double, 2, 3> slopes(const dataset::Points &x, const Eigen::Matrix<std::int32_t, 1, 9> &cell, double xi,
                                   double eta)
{
  static const int place[9][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {0, -1}, {1, 0}, {0, 1}, {-1, 0}, {0, 0}};
  const auto shape = [](int at, double s) { return at == 0 ? 1 - s * s : s * (s + at) / 2; };
  const auto slope = [](int at, double s) { return at == 0 ? -2 * s : s + at / 2.0; };
  Eigen::Matrix<double, 2, 3> result = Eigen::Matrix<double, 2, 3>::Zero();
  for (int k = 0; k < 9; ++k)
  {
    result.row(0) += slope(place[k][0], xi) * shape(place[k][1], eta) * x.row(cell[k]);
    result.row(1) += shape(place[k][0], xi) * slope(place[k][1], eta) * x.row(cell[k]);
  }
  return result;
}

TEST_P(EveryCase, HasShellsWithPositiveJacobianThroughTheThickness)
{
  for (const dataset::ReferenceShell &shell : anatomy().reference.shells)
    for (Eigen::Index c = 0; c < shell.cells.rows(); ++c)
      for (const double xi : {-1.0, 0.0, 1.0})
        for (const double eta : {-1.0, 0.0, 1.0})
        {
          const auto dx = slopes(shell.midsurface, shell.cells.row(c), xi, eta);
          const auto dn = slopes(shell.directors, shell.cells.row(c), xi, eta);
          const double t = shell.thickness[shell.cells(c, 0)];
          const Eigen::RowVector3d up = dx.row(0).cross(dx.row(1));
          for (const double zeta : {-1.0, 1.0})
          {
            const Eigen::Matrix<double, 2, 3> g = dx + zeta * t / 2 * dn;
            EXPECT_GT(g.row(0).cross(g.row(1)).dot(up), 0) << shell.name << " cell " << c << " zeta " << zeta;
          }
          // Principal curvatures of the outer surface: d(normal) = curvature d(outer).
          const Eigen::Matrix<double, 2, 3> outer = dx + t / 2 * dn;
          const Eigen::Matrix2d weingarten = (outer * outer.transpose()).inverse() * (dn * outer.transpose());
          EXPECT_LE(t * weingarten.eigenvalues().real().maxCoeff(), 0.8) << shell.name << " wall/radius in cell " << c;
        }
}

TEST_P(EveryCase, HasUnitDirectorsThatAreTheSurfaceNormals)
{
  for (const dataset::ReferenceShell &shell : anatomy().reference.shells)
  {
    for (Eigen::Index i = 0; i < shell.directors.rows(); ++i)
      EXPECT_NEAR(shell.directors.row(i).norm(), 1, 1e-12);
    double worst = 1;
    for (Eigen::Index c = 0; c < shell.cells.rows(); ++c)
    {
      const auto dx = slopes(shell.midsurface, shell.cells.row(c), 0, 0);
      worst = std::min(worst, dx.row(0).cross(dx.row(1)).normalized().dot(shell.directors.row(shell.cells(c, 8))));
    }
    EXPECT_GT(worst, GetParam() == "quick" ? 0.9 : 0.98) << shell.name << ": directors leave the cells' normals";
  }
}

TEST_P(EveryCase, MeshesOneGeometryTwice)
{
  // Registration nodes lie on the reference's outer surface, up to the chord error of its triangles.
  const double chord = GetParam() == "quick" ? 2 : 0.4; // mm
  const auto reference = reference_surfaces(anatomy().reference);
  for (const auto &[name, surface] : registration_surfaces(anatomy().registration))
  {
    const std::set<std::int32_t> used(surface.triangles.data(), surface.triangles.data() + surface.triangles.size());
    for (const std::int32_t node : used)
    {
      EXPECT_LE(distance_to(surface.points.row(node).transpose(), reference.at(name)), chord)
          << name << " node " << node;
    }
  }
}
} // namespace
} // namespace pelvireg::test
