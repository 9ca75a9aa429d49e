// The claim on the error by slice.
#include "synthetic/dataset/geometry.h"
#include "validation/runner/aggregate.h"
#include "validation/runner/claim_terms.h"

#include <fmt/format.h>

#include <cstddef>
#include <optional>

namespace pelvireg::runner
{
namespace
{
using dataset::organ_names;

/// Where the error of the full condition is least, among the slices that count and the DYN plane.
struct LeastError
{
  int slice_index = 0;
  double error = 0, in_dyn_plane = 0; ///< mm

  bool is_in_dyn_plane() const { return error >= in_dyn_plane; }
};

/// Nothing when no run has an error in the DYN plane.
std::optional<LeastError> least_error(const Evaluation &evaluation, const std::string &organ)
{
  const auto errors = error_by_slice(evaluation, full, organ);
  const auto &centre = errors[static_cast<std::size_t>(evaluation.n_slices_each_side)];
  if (!centre)
    return std::nullopt;
  LeastError least{0, centre->mean, centre->mean};
  for (std::size_t i = 0; i < errors.size(); ++i)
  {
    const int k = static_cast<int>(i) - evaluation.n_slices_each_side;
    if (errors[i] && counts_for_growth(evaluation, organ, k) && errors[i]->mean < least.error)
    {
      least.slice_index = k;
      least.error = errors[i]->mean;
    }
  }
  return least;
}

std::string phrase(const std::optional<LeastError> &least)
{
  if (!least)
    return "no error at 0";
  return least->is_in_dyn_plane() ? "least at 0"
                                  : fmt::format("not least at 0 ({:.2f} mm, {:.2f} mm at {})", least->in_dyn_plane,
                                                least->error, least->slice_index);
}

std::string number(const std::optional<Slope> &slope)
{
  return slope ? fmt::format("{:.3f}", slope->value) : "none";
}

std::string phrase(const Evaluation &evaluation, const std::string &organ, const std::optional<LeastError> &least)
{
  const auto with = slope_with_distance(evaluation, full, organ),
             without = slope_with_distance(evaluation, bare, organ);
  std::string text =
      fmt::format("{}: {}, slope {} with and {} without", organ, phrase(least), number(with), number(without));
  if (with && with->n_left_out > 0)
    text += fmt::format(" over {} slices ({} and {} with the {} left out)", with->n_slices,
                        number(slope_with_distance(evaluation, full, organ, true)),
                        number(slope_with_distance(evaluation, bare, organ, true)), with->n_left_out);
  return text;
}
} // namespace

ClaimVerdict growth_by_slice(const Evaluation &evaluation)
{
  ClaimVerdict claim{
      "error_by_slice",
      "Error by slice is least at index 0 and grows faster without boundary conditions",
      "yes",
      fmt::format("every organ, over slices whose section of the truth's organ is at least {:.0f} % of its "
                  "largest (others graze it): no slice of the full condition below index 0, and a steeper "
                  "least-squares slope of error against distance (mm/mm) without boundary conditions",
                  100 * least_section_share),
      "",
      ""};
  if (!needs_sound(evaluation, {full, bare}, claim))
    return claim;
  bool holds = true;
  for (const std::string &organ : organ_names)
  {
    const std::optional<LeastError> least = least_error(evaluation, organ);
    const auto with = slope_with_distance(evaluation, full, organ);
    const auto without = slope_with_distance(evaluation, bare, organ);
    holds = holds && least && least->is_in_dyn_plane() && with && without && without->value > with->value;
    append_phrase(claim.ours, phrase(evaluation, organ, least));
  }
  if (!evaluation.missed_slices.empty())
    append_phrase(claim.ours,
                  fmt::format("slices of the truth that an estimate misses: {}", evaluation.missed_slices.size()));
  claim.verdict = to_verdict(holds);
  return claim;
}
} // namespace pelvireg::runner
