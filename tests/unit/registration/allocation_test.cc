// A program of its own: it counts what malloc() is asked for.
#include "registration/registration.h"
#include "tests/unit/registration/scene.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdlib>

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
TEST(Registration, AllocatesNothingInTheSteadyState)
{
  if (!can_count)
    GTEST_SKIP() << "the address sanitizer owns malloc";
  Model model;
  model.bodies.push_back(scene::hollow_ellipsoid({25, 30, 20}, 3, 3));
  model.bodies.push_back(scene::block({30, 6, 6}, {6, 1, 1}, false, false, {25, -3, -3}));
  model.bodies[0].name = "organ";
  model.bodies[1].name = "band";
  Attachment attachment{"band on organ", 1, {}, 0, 0};
  for (int node = 0; node < model.bodies[1].rest_positions.rows(); ++node)
  {
    if (model.bodies[1].rest_positions(node, 0) > 54)
      model.bodies[1].fixed_nodes.push_back(node);
    if (model.bodies[1].rest_positions(node, 0) < 26)
      attachment.nodes_a.push_back(node);
  }
  model.attachments.push_back(attachment);
  model.bodies.push_back(scene::hollow_ellipsoid({20, 20, 15}, 3, 3, {0, 0, 35.2})); // the organ moves into it
  model.bodies[2].name = "organ above";
  model.contact_pairs.push_back({0, 2});
  Observation observation;
  observation.outlines.push_back(scene::outline(model.bodies[0], 0, model.bodies[0].rest_positions,
                                                observation.plane_origin, observation.plane_normal));
  observation.outlines[0].points.col(2).array() += 1;

  Registration registration;
  registration.prepare(model, {});
  for (int step = 0; step < 5; ++step) // the buffers grow
    ASSERT_EQ(registration.update(observation).status, StepStatus::ok);
  ASSERT_GT(registration.penetrations()[0].n_contacts, 0);
  const long before = n_allocations;
  ASSERT_GT(before, 0);
  ASSERT_EQ(registration.update(observation).status, StepStatus::ok);
  EXPECT_EQ(n_allocations, before);
}
} // namespace pelvireg::registration
