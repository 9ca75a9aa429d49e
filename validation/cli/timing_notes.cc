#include "validation/cli/timing_notes.h"

namespace pelvireg::cli
{
namespace
{
std::string note_of(const std::string &phase)
{
  return phase + "_mean_ms";
}
} // namespace

Notes notes_of(const runner::StepTiming &timing)
{
  Notes notes = {{"n_steps", timing.n_steps},
                 {"median_ms", timing.median_ms},
                 {"p95_ms", timing.p95_ms},
                 {"max_ms", timing.max_ms},
                 {"mean_ms", timing.mean_ms}};
  for (const runner::PhaseTiming &phase : timing.phases)
    notes[note_of(phase.name)] = phase.mean_ms;
  return notes;
}

std::optional<runner::StepTiming> timing_in(const Notes &notes, const std::string &label)
{
  if (!notes.contains("median_ms"))
    return std::nullopt;
  runner::StepTiming timing{.condition = label,
                            .n_steps = static_cast<int>(notes.at("n_steps")),
                            .median_ms = notes.at("median_ms"),
                            .p95_ms = notes.at("p95_ms"),
                            .max_ms = notes.at("max_ms")};
  if (!notes.contains("mean_ms"))
    return timing;
  timing.mean_ms = notes.at("mean_ms");
  for (const registration::StepPhase &phase : registration::step_phases)
    if (const auto note = notes.find(note_of(phase.name)); note != notes.end())
      timing.phases.push_back({phase.name, note->second});
  return timing;
}
} // namespace pelvireg::cli
