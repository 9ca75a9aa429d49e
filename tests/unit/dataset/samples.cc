#include "tests/unit/dataset/samples.h"

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <unistd.h>

namespace pelvireg::dataset::testing
{
namespace
{
/// Values that no decimal text would carry exactly.
Points points_from(int n_rows, double seed)
{
  Points points(n_rows, 3);
  for (Eigen::Index i = 0; i < points.size(); ++i)
    points.data()[i] = seed + static_cast<double>(i) / 7.0;
  return points;
}

template <typename Cells> Cells cells_from(int n_cells, int n_nodes)
{
  Cells cells(n_cells, Cells::ColsAtCompileTime);
  for (Eigen::Index i = 0; i < cells.size(); ++i)
    cells.data()[i] = static_cast<std::int32_t>((3 * i + 1) % n_nodes);
  return cells;
}

Integers integers_from(std::initializer_list<int> values)
{
  Integers result(static_cast<Eigen::Index>(values.size()));
  Eigen::Index i = 0;
  for (const int value : values)
    result[i++] = value;
  return result;
}

SurfaceMesh surface_from(double seed)
{
  return {points_from(5, seed), cells_from<Triangles>(4, 5), integers_from({0, 1, 2, 3})};
}

Contour contour_from(int size, double seed)
{
  return {points_from(size, seed), points_from(size, -seed), Integers::Constant(size, 1)};
}

const Plane tilted_plane = {Eigen::Vector3d(3, 0.1, -7), Eigen::Vector3d(3, 0.2, -0.1).normalized()};

RegistrationModel sample_registration()
{
  RegistrationModel model;
  RegistrationBody organ;
  organ.name = "vagina";
  organ.points = points_from(6, 30);
  organ.tets = cells_from<Tets>(3, 6);
  organ.youngs_modulus = 0.005;
  organ.outer_triangles = cells_from<Triangles>(4, 6);
  organ.outer_region = integers_from({0, 0, 2, 3});
  RegistrationBody band;
  band.name = "ligaments";
  band.points = points_from(8, 40);
  band.hexes = cells_from<Hexes>(1, 8);
  band.poisson_ratio = 0.41;
  band.density = 1.0e-9;
  band.fixed_nodes = integers_from({0, 3, 7});
  model.bodies = {organ, band};
  model.attachments = {{"cardinal_left", "ligament", "ligaments", integers_from({1, 2}), "vagina"}};
  return model;
}
} // namespace

Anatomy sample_anatomy()
{
  Anatomy anatomy;
  anatomy.case_name = "sample";
  anatomy.dyn_plane = tilted_plane;
  anatomy.n_control_points = 64;
  anatomy.registration_friction = 0.3;
  anatomy.control_point_spacing = 4.25;
  anatomy.reference.materials = {{"wall", {0.01, 0.02, 0.03, 1.0 / 3}}, {"ligament", {0.1, 0, 0, 2}}};
  ReferenceShell shell;
  shell.name = "vagina";
  shell.material = "wall";
  shell.midsurface = points_from(12, 1);
  shell.directors = points_from(12, 2);
  shell.thickness = Eigen::VectorXd::LinSpaced(12, 2, 3);
  shell.cells = cells_from<Quads9>(2, 12);
  shell.region = integers_from({0, 2});
  shell.pressure_share = Eigen::VectorXd::LinSpaced(12, 0, 1);
  shell.fixed_nodes = integers_from({4});
  shell.rims = {integers_from({0, 1, 2, 3}), integers_from({8, 9})};
  shell.has_cavity = true;
  shell.cavity = {CavityMode::leak, 1e6 / 3, 0.002};
  ReferenceSolid solid;
  solid.name = "uterus";
  solid.material = "wall";
  solid.points = points_from(11, 3);
  solid.cells = cells_from<Tets10>(2, 11);
  solid.faces = cells_from<Triangles6>(3, 11);
  solid.region = integers_from({1, 0, 2});
  anatomy.reference.shells = {shell};
  anatomy.reference.solids = {solid};
  anatomy.reference.trusses = {
      {"cardinal_left", "vagina", 5, "", -1, {50.5, 1, 2}, 3.5, "ligament"},
      {"hiatus", "vagina", 6, "uterus", 2, {0, 0, 0}, 0.5, "ligament", true, {0.1, -7, 1.0 / 3}}};
  anatomy.reference.contact_pairs = {{"vagina", "uterus"}};
  anatomy.reference.ties = {{"uterus", "vagina"}};
  anatomy.reference.target_displacement = 2.1;
  anatomy.reference.n_increments = 4;
  anatomy.registration = sample_registration();
  return anatomy;
}

Truth sample_truth()
{
  Truth truth;
  truth.case_name = "sample";
  truth.source = "a test";
  for (const char *name : {"bladder", "vagina"})
    truth.surfaces.push_back({name, surface_from(1), {points_from(5, 0.1), points_from(5, 0.2)}});
  truth.trusses = {{"cardinal_left", points_from(2, 9), {points_from(2, 9.5), points_from(2, 9.75)}}};
  truth.cavity_names = {"bladder", "vagina", "rectum"};
  truth.cavity_rest_volumes = Eigen::Vector3d(1e5, 2e4 / 3, 7);
  for (int i = 1; i <= 2; ++i)
    truth.increments.push_back({1e-3 * i, 0.5 * i, 1e-7 / i, 0.3 * i, 4 + i, i - 1, 0.01 * i,
                                Eigen::Vector3d(1e5, 2e4, 7 + i), Eigen::Vector3d(0.1, 0.2, 0.3 * i)});
  truth.energy_parts = {"bladder", "bars cardinal_left"};
  truth.supports = {"nodes of bladder", "bars cardinal_left", "bars urethra"};
  for (int i = 1; i <= 2; ++i)
    truth.balances.push_back({3.1 * i, 0.01 / i, Eigen::Vector2d(2.5 * i, 0.1), 0.2 * i, 0.03 * i,
                              Eigen::Vector3d(0.7 * i, -0.1, 0), 0.4 / i, points_from(3, 11 * i),
                              Eigen::Vector3d(1, -2, 0.3 * i), 1e-7 * i});
  truth.discretisation_error = DiscretisationError{.cell_sizes = {9.3, 6.6, 4.67},
                                                   .n_cells = integers_from({500, 1000, 2000}),
                                                   .observed_order = 1.0 / 0.7,
                                                   .used_order = 1.5,
                                                   .safety_factor = 1.25,
                                                   .mean = Eigen::Vector2d(0.01, 0.02),
                                                   .max = Eigen::Vector2d(0.1, 0.2),
                                                   .max_near_bars = Eigen::Vector2d(0.3, 0.4),
                                                   .mean_by_organ = Points4::Constant(2, 4, 0.01),
                                                   .max_by_organ = Points4::Constant(2, 4, 1.0 / 3),
                                                   .bar_distance = 5,
                                                   .share_near_bars = 0.2,
                                                   .case_sha256 = "abc",
                                                   .solver_sha256 = "def",
                                                   .revision = "123",
                                                   .same_solver = true};
  return truth;
}

Observations sample_observations()
{
  const auto outlines = [](double seed) -> std::vector<OrganOutline>
  {
    return {{"bladder", {contour_from(4, seed), contour_from(3, seed + 1)}},
            {"vagina", {contour_from(5, seed + 2)}},
            {"uterus", {}},
            {"rectum", {contour_from(3, seed + 3)}}};
  };
  const auto frame = [&](int increment, double seed) -> DynamicFrame
  {
    return {increment,
            outlines(seed),
            {points_from(3, seed), points_from(2, seed), Points(0, 3), points_from(1, seed)},
            {points_from(3, -seed), points_from(2, -seed), Points(0, 3), points_from(1, -seed)}};
  };
  Observations observations;
  observations.case_name = "sample";
  observations.dyn_plane = tilted_plane;
  observations.rest = frame(0, 1);
  observations.frames = {frame(1, 2), frame(2, 3)};
  observations.slices = {{-1, tilted_plane, outlines(4)}, {0, tilted_plane, outlines(5)}};
  return observations;
}

Estimate sample_estimate()
{
  Estimate estimate;
  estimate.case_name = "sample";
  estimate.condition = "no_boundary_conditions";
  estimate.contact_pairs = {{"bladder", "uterus"}, {"uterus", "rectum"}};
  estimate.perturbation = {.kind = "surface",
                           .seed = 0xfedcba9876543210,
                           .modulus_spread = 0.125,
                           .surface_sd = 1.5,
                           .surface_correlation_length = 12,
                           .outline_sd = 0.75,
                           .plane_offset_sd = 2.5,
                           .plane_tilt_sd = 0.03125};
  for (const int sample : {0, 7})
  {
    EstimateSample entry;
    entry.sample = sample;
    for (const char *name : {"bladder", "uterus"})
      entry.surfaces.push_back({name, surface_from(1), {points_from(5, sample), points_from(5, sample + 1)}});
    entry.steps = {{"ok", 70, 69, 0.1, 0.2, 1e-9, 1e-17, 0.05, 12, 31, 4.5, 1e-7, 1e-12, 2, {0.3, 0}, {11.5, 0}},
                   {"no control point in the image plane",
                    70 + sample,
                    0,
                    0.3,
                    0.4,
                    0,
                    0,
                    0,
                    0,
                    0,
                    0,
                    0,
                    0,
                    0,
                    {0.25, 0.125},
                    {7, 3.5}}};
    if (sample > 0)
      entry.surfaces[1].rest.points.array() += 0.5;
    if (sample == 7)
      entry.bodies = {{"uterus", points_from(6, 2), points_from(6, 3)},
                      {"ligaments", points_from(4, 5), points_from(4, 6)}};
    estimate.samples.push_back(entry);
  }
  return estimate;
}

std::string bytes_of(const std::filesystem::path &file)
{
  std::ostringstream out;
  out << std::ifstream(file, std::ios::binary).rdbuf();
  return out.str();
}
} // namespace pelvireg::dataset::testing
