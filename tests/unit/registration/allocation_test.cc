// A program of its own: it counts what malloc() is asked for.
#include "registration/registration.h"
#include "tests/unit/registration/scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <set>

#if defined(__SANITIZE_ADDRESS__)
constexpr bool can_count = false; // the sanitizer's malloc must stay
static long n_allocations = 0;
#else
constexpr bool can_count = true;
static long n_allocations = 0;
extern "C" void *__libc_malloc(std::size_t size);
extern "C" void *__libc_calloc(std::size_t count, std::size_t size);
extern "C" void *__libc_realloc(void *block, std::size_t size);
extern "C" void *malloc(std::size_t size)
{
  ++n_allocations;
  return __libc_malloc(size);
}
extern "C" void *calloc(std::size_t count, std::size_t size)
{
  ++n_allocations;
  return __libc_calloc(count, size);
}
extern "C" void *realloc(void *block, std::size_t size)
{
  ++n_allocations;
  return __libc_realloc(block, size);
}
#endif

namespace pelvireg::registration
{
namespace
{
/// An organ on a band and a second organ 0.2 mm above it, into which the first one moves.
Model organs_that_come_to_touch()
{
  Model model;
  model.bodies.push_back(scene::hollow_ellipsoid({25, 30, 20}, 3, 3));
  model.bodies.push_back(scene::block({30, 6, 6}, {6, 1, 1}, false, false, {25, -3, -3}));
  model.bodies.push_back(scene::hollow_ellipsoid({20, 20, 15}, 3, 3, {0, 0, 35.2}));
  model.bodies[0].name = "organ";
  model.bodies[1].name = "band";
  model.bodies[2].name = "organ above";
  Attachment attachment{"band on organ", 1, {}, 0, 0};
  for (int node = 0; node < model.bodies[1].rest_positions.rows(); ++node)
  {
    if (model.bodies[1].rest_positions(node, 0) > 54)
      model.bodies[1].fixed_nodes.push_back(node);
    if (model.bodies[1].rest_positions(node, 0) < 26)
      attachment.nodes_a.push_back(node);
  }
  model.attachments.push_back(attachment);
  model.contact_pairs.push_back({0, 2});
  return model;
}
} // namespace

// From the first step on, while the number of contacts and of control points changes from step to step.
TEST(Registration, AllocatesNothingAfterPrepareWhileContactsComeAndGo)
{
  if (!can_count)
    GTEST_SKIP() << "the address sanitizer owns malloc";
  const Model model = organs_that_come_to_touch();
  Registration registration;
  registration.prepare(model, {});
  std::set<int> numbers_of_contacts;
  for (int step = 0; step < 24; ++step)
  {
    Observation observation;
    observation.outlines.push_back(scene::outline(model.bodies[0], 0, model.bodies[0].rest_positions,
                                                  observation.plane_origin, observation.plane_normal, 1 + step % 3));
    observation.outlines[0].points.col(2).array() += 4 * std::sin(0.3 * step);
    observation.outlines[0].points.col(1).array() += 0.5 * step;
    // Outlines hold the organ above, so that the organ comes back to it.
    observation.outlines.push_back(scene::outline(model.bodies[2], 2, model.bodies[2].rest_positions,
                                                  observation.plane_origin, observation.plane_normal, 3));
    ASSERT_LE(observation.outlines[0].points.rows() + observation.outlines[1].points.rows(),
              Options().reserved_control_points);
    const long before = n_allocations;
    ASSERT_GT(before, 0);
    const StepSummary summary = registration.update(observation);
    EXPECT_EQ(n_allocations, before) << step << ", " << summary.n_contacts << " contacts";
    ASSERT_EQ(summary.status, StepStatus::ok);
    ASSERT_LE(summary.n_contacts, Options().reserved_contacts);
    numbers_of_contacts.insert(summary.n_contacts);
  }
  EXPECT_TRUE(numbers_of_contacts.contains(0));
  EXPECT_GE(numbers_of_contacts.size(), 3u);
}

// Beyond the capacity a step allocates, is right all the same, and the next one of its size does not.
TEST(Registration, GrowsOnceBeyondItsCapacity)
{
  const Model model = organs_that_come_to_touch();
  Observation observation;
  observation.outlines.push_back(scene::outline(model.bodies[0], 0, model.bodies[0].rest_positions,
                                                observation.plane_origin, observation.plane_normal));
  observation.outlines[0].points.col(2).array() += 1;
  Options small;
  small.reserved_control_points = small.reserved_contacts = 0;
  Registration tight, roomy;
  tight.prepare(model, small);
  roomy.prepare(model, {});
  for (int step = 0; step < 8; ++step)
  {
    const long before = n_allocations;
    ASSERT_EQ(tight.update(observation).status, StepStatus::ok);
    EXPECT_TRUE(!can_count || step < 6 || n_allocations == before) << step;
    ASSERT_EQ(roomy.update(observation).status, StepStatus::ok);
  }
  ASSERT_GT(tight.penetrations()[0].n_contacts, 0);
  for (int body = 0; body < 3; ++body)
    EXPECT_EQ(tight.positions(body), roomy.positions(body));
}
} // namespace pelvireg::registration
