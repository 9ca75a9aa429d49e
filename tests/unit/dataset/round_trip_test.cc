// What is loaded is what was saved, to the last bit; what is saved twice is one file.
#include "synthetic/dataset/error.h"
#include "tests/unit/dataset/samples.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace pelvireg::dataset::testing
{
namespace
{
/// Saving what was loaded must give the bytes of the first file: then no field was lost on the way in or out.
template <typename Content, typename Load> void expect_fixed_point(const Content &content, const Load &load)
{
  const ScratchFolder folder;
  save(content, folder / "first.h5");
  save(load(folder / "first.h5"), folder / "second.h5");
  EXPECT_EQ(bytes_of(folder / "first.h5"), bytes_of(folder / "second.h5"));
}

template <typename Content> void expect_same_bytes_a_second_later(const Content &content)
{
  const ScratchFolder folder;
  save(content, folder / "first.h5");
  std::this_thread::sleep_for(std::chrono::milliseconds(1100)); // HDF5's time stamps count seconds
  save(content, folder / "second.h5");
  EXPECT_EQ(bytes_of(folder / "first.h5"), bytes_of(folder / "second.h5"));
}

void expect_equal(const SurfaceMesh &a, const SurfaceMesh &b)
{
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.triangles, b.triangles);
  EXPECT_EQ(a.region, b.region);
}

void expect_equal(const OrganOutline &a, const OrganOutline &b)
{
  EXPECT_EQ(a.organ, b.organ);
  ASSERT_EQ(a.contours.size(), b.contours.size());
  for (std::size_t i = 0; i < a.contours.size(); ++i)
  {
    EXPECT_EQ(a.contours[i].points, b.contours[i].points);
    EXPECT_EQ(a.contours[i].segment_normals, b.contours[i].segment_normals);
    EXPECT_EQ(a.contours[i].segment_region, b.contours[i].segment_region);
  }
}
} // namespace

TEST(AnatomyFile, ComesBackExactly)
{
  const ScratchFolder folder;
  const Anatomy saved = sample_anatomy();
  save(saved, folder / "anatomy.h5");
  const Anatomy loaded = load_anatomy(folder / "anatomy.h5");
  EXPECT_EQ(loaded.case_name, saved.case_name);
  EXPECT_EQ(loaded.dyn_plane.normal, saved.dyn_plane.normal);
  EXPECT_EQ(loaded.n_control_points, saved.n_control_points);
  EXPECT_EQ(loaded.registration_friction, saved.registration_friction);
  EXPECT_EQ(loaded.control_point_spacing, saved.control_point_spacing);
  const ReferenceShell &shell = loaded.reference.shells.at(0);
  EXPECT_EQ(shell.name, "vagina");
  EXPECT_EQ(shell.midsurface, saved.reference.shells[0].midsurface);
  EXPECT_EQ(shell.cells, saved.reference.shells[0].cells);
  EXPECT_EQ(shell.pressure_share, saved.reference.shells[0].pressure_share);
  EXPECT_EQ(loaded.reference.solids.at(0).pressure_share.size(), 0) << "whole faces";
  EXPECT_EQ(loaded.reference.trusses.at(1).offset_b, saved.reference.trusses[1].offset_b);
  EXPECT_EQ(shell.rims.at(1), saved.reference.shells[0].rims[1]);
  EXPECT_TRUE(shell.has_cavity);
  EXPECT_EQ(shell.cavity.mode, CavityMode::leak);
  EXPECT_EQ(shell.cavity.leak_rate, saved.reference.shells[0].cavity.leak_rate);
  EXPECT_EQ(loaded.reference.solids.at(0).cells, saved.reference.solids[0].cells);
  EXPECT_EQ(loaded.reference.materials.at("wall").kappa, 1.0 / 3);
  EXPECT_EQ(loaded.reference.trusses.at(1).part_b, "uterus");
  EXPECT_EQ(loaded.reference.trusses.at(0).fixed_point, saved.reference.trusses[0].fixed_point);
  EXPECT_FALSE(loaded.reference.trusses.at(0).tension_only);
  EXPECT_TRUE(loaded.reference.trusses.at(1).tension_only);
  EXPECT_EQ(loaded.reference.ties, saved.reference.ties);
  EXPECT_EQ(loaded.reference.n_increments, 4);
  EXPECT_EQ(loaded.registration.bodies.at(1).hexes, saved.registration.bodies[1].hexes);
  EXPECT_EQ(loaded.registration.bodies.at(1).poisson_ratio, 0.41);
  EXPECT_EQ(loaded.registration.attachments.at(0).nodes_a, saved.registration.attachments[0].nodes_a);
}

TEST(TruthFile, ComesBackExactly)
{
  const ScratchFolder folder;
  const Truth saved = sample_truth();
  save(saved, folder / "truth.h5");
  const Truth loaded = load_truth(folder / "truth.h5");
  ASSERT_EQ(loaded.surfaces.size(), 2u);
  expect_equal(loaded.surfaces[1].rest, saved.surfaces[1].rest);
  EXPECT_EQ(loaded.surfaces[0].displacements, saved.surfaces[0].displacements);
  EXPECT_EQ(loaded.trusses.at(0).positions, saved.trusses[0].positions);
  EXPECT_EQ(loaded.cavity_names, saved.cavity_names);
  EXPECT_EQ(loaded.increments.at(1).cavity_pressures, saved.increments[1].cavity_pressures);
  EXPECT_EQ(loaded.increments.at(0).residual, saved.increments[0].residual);
  EXPECT_EQ(loaded.supports, saved.supports);
  EXPECT_EQ(loaded.energy_parts, saved.energy_parts);
  EXPECT_EQ(loaded.balances.at(1).strain_energy, saved.balances[1].strain_energy);
  EXPECT_EQ(loaded.balances.at(1).reactions, saved.balances[1].reactions);
  EXPECT_EQ(loaded.balances.at(0).energy_error_percent, saved.balances[0].energy_error_percent);
  ASSERT_TRUE(loaded.discretisation_error);
  EXPECT_EQ(loaded.discretisation_error->max_by_organ, saved.discretisation_error->max_by_organ);
  EXPECT_EQ(loaded.discretisation_error->n_cells, saved.discretisation_error->n_cells);
}

TEST(TruthFile, MayLackTheBalancesWhichAreThenNoneAndNotZero)
{
  const ScratchFolder folder;
  Truth imported = sample_truth();
  imported.balances.clear();
  imported.energy_parts.clear();
  imported.supports.clear();
  imported.discretisation_error.reset();
  save(imported, folder / "truth.h5");
  EXPECT_TRUE(load_truth(folder / "truth.h5").balances.empty());
  EXPECT_FALSE(load_truth(folder / "truth.h5").discretisation_error);
  expect_fixed_point(imported, load_truth);
}

TEST(TruthFile, RefusesABalanceWithoutOneValueAPartOrOneRecordAnIncrement)
{
  const ScratchFolder folder;
  Truth truth = sample_truth();
  truth.balances[1].strain_energy.conservativeResize(1);
  EXPECT_THROW(save(truth, folder / "truth.h5"), ComputationError);
  truth = sample_truth();
  truth.balances.pop_back();
  EXPECT_THROW(save(truth, folder / "truth.h5"), ComputationError);
}

TEST(ObservationsFile, ComesBackExactlyWithOrgansThatThePlaneMisses)
{
  const ScratchFolder folder;
  const Observations saved = sample_observations();
  save(saved, folder / "observations.h5");
  const Observations loaded = load_observations(folder / "observations.h5");
  ASSERT_EQ(loaded.frames.size(), 2u);
  for (std::size_t organ = 0; organ < organ_names.size(); ++organ)
  {
    expect_equal(loaded.rest.outlines.at(organ), saved.rest.outlines[organ]);
    EXPECT_EQ(loaded.frames[1].control_points.at(organ), saved.frames[1].control_points[organ]);
    EXPECT_EQ(loaded.frames[1].control_point_normals.at(organ), saved.frames[1].control_point_normals[organ]);
    expect_equal(loaded.slices.at(0).outlines.at(organ), saved.slices[0].outlines[organ]);
  }
  EXPECT_EQ(loaded.slices[0].index, -1);
}

TEST(EstimateFile, ComesBackExactlyForEverySample)
{
  const ScratchFolder folder;
  const Estimate saved = sample_estimate();
  save(saved, folder / "estimate-full.h5");
  const Estimate loaded = load_estimate(folder / "estimate-full.h5");
  ASSERT_EQ(loaded.samples.size(), 2u);
  EXPECT_EQ(loaded.condition, saved.condition);
  EXPECT_EQ(loaded.samples[1].sample, 7);
  expect_equal(loaded.samples[1].surfaces.at(1).rest, saved.samples[1].surfaces[1].rest);
  EXPECT_EQ(loaded.samples[1].surfaces.at(0).positions, saved.samples[1].surfaces[0].positions);
  EXPECT_EQ(loaded.samples[1].steps.at(1).status, saved.samples[1].steps[1].status);
  EXPECT_EQ(loaded.samples[1].steps.at(1).offered_control_points, 77);
  EXPECT_EQ(loaded.perturbation, saved.perturbation);
  EXPECT_TRUE(loaded.samples[0].bodies.empty()) << "not kept";
  ASSERT_EQ(loaded.samples[1].bodies.size(), 2u);
  EXPECT_EQ(loaded.samples[1].bodies[1].name, "ligaments");
  EXPECT_EQ(loaded.samples[1].bodies[1].rest, saved.samples[1].bodies[1].rest);
  EXPECT_EQ(loaded.samples[1].bodies[1].last, saved.samples[1].bodies[1].last);
  EXPECT_EQ(loaded.label(), "no_boundary_conditions_surface");
}

TEST(EveryFile, KeepsEveryFieldThroughLoadAndSave)
{
  expect_fixed_point(sample_anatomy(), load_anatomy);
  expect_fixed_point(sample_truth(), load_truth);
  expect_fixed_point(sample_observations(), load_observations);
  expect_fixed_point(sample_estimate(), load_estimate);
}

TEST(EveryFile, HasTheSameBytesWhenWrittenASecondLater)
{
  expect_same_bytes_a_second_later(sample_anatomy());
  expect_same_bytes_a_second_later(sample_observations());
}

TEST(EveryFile, MayBeEmpty)
{
  expect_fixed_point(Anatomy{}, load_anatomy);
  expect_fixed_point(Truth{}, load_truth);
  expect_fixed_point(Observations{}, load_observations);
  expect_fixed_point(Estimate{}, load_estimate);
}
} // namespace pelvireg::dataset::testing
