#include "validation/cli/timing_notes.h"

#include <gtest/gtest.h>

namespace pelvireg::cli
{
namespace
{
const runner::StepTiming timing{.condition = "full",
                                .n_steps = 45,
                                .median_ms = 2,
                                .p95_ms = 3,
                                .max_ms = 4,
                                .mean_ms = 2.25,
                                .phases = {{"match", 0.5}, {"compliance", 1.25}, {"contact", 0.25}}};
}

TEST(TimingNotes, ComeBackInTheOrderOfAStep)
{
  const auto again = timing_in(notes_of(timing), "full");
  ASSERT_TRUE(again);
  EXPECT_EQ(again->condition, "full");
  EXPECT_EQ(again->n_steps, 45);
  EXPECT_EQ(again->median_ms, 2);
  EXPECT_EQ(again->p95_ms, 3);
  EXPECT_EQ(again->max_ms, 4);
  EXPECT_EQ(again->mean_ms, 2.25);
  ASSERT_EQ(again->phases.size(), 3u) << "not in the notes' own order, which is that of the alphabet";
  for (std::size_t k = 0; k < 3; ++k)
  {
    EXPECT_EQ(again->phases[k].name, timing.phases[k].name);
    EXPECT_EQ(again->phases[k].mean_ms, timing.phases[k].mean_ms);
  }
}

TEST(TimingNotes, OfAnOlderProgramHaveNoPhases)
{
  const auto again = timing_in({{"n_steps", 45}, {"median_ms", 2}, {"p95_ms", 3}, {"max_ms", 4}}, "full");
  ASSERT_TRUE(again);
  EXPECT_EQ(again->median_ms, 2);
  EXPECT_TRUE(again->phases.empty());
  EXPECT_FALSE(timing_in({}, "full"));
}
} // namespace pelvireg::cli
