// The rule of the regression gate: every line and tolerance, and where it comes from. What is done with them is in
// docs/regression.md.
#pragma once

#include <cstdint>

namespace pelvireg::regression
{
/// Ratios are CURRENT over BASELINE of (error + floor_mm). E is the average of one run's curve over its steps or
/// slices. Figures "on quick" are from 200 runs with moduli +-10 %; docs/regression.md says how to take them again.
struct Rule
{
  /// mm, added to both errors of a ratio, so that an error of almost nothing does not make a large ratio. Far below the
  /// smallest average of quick (0.26 mm); 0.01 is the value that the rule was simulated with.
  double floor_mm = 0.01;

  /// The geometric mean ratio of E must be proven below this. Simulation: with a line at 1.05 a true +5 % slips through
  /// in 1 to 8 % of all gates, because it lies on the line; with 1.04 in none of 1000.
  double average_line = 1.04;
  /// Above it, and proven above 1, a change within the margin is passed with a warning.
  double average_warning = 1.02;
  /// The same for the largest 95th percentile of a curve: a true +10 % must be caught.
  double tail_line = 1.08;
  /// The simultaneous band must not lie above this at any step or slice …
  double local_line = 1.05;
  /// … where the mean error has grown by more than this, mm: below it nobody would act. A fifth of the smallest value
  /// of a curve of quick (0.09 mm, the vagina at slice 0) is just below.
  double local_least_mm = 0.02;

  /// One-sided error probability of each bound that every family must keep. Of what a single family is enough for
  /// (proven worse, the band, the nominal run) it is shared among the families (Bonferroni).
  double level = 0.01;
  /// Bootstrap resamples of the band: 0.01 shared among 40 families is still a tail of 2.5 resamples.
  int n_resamples = 9999;
  std::uint64_t seed = 20120917;
  /// Fewer randomised runs than this are not judged. On quick the logarithms of E scatter between runs by 0.0076 at
  /// most; even unpaired (times sqrt 2) 4 runs bound the mean within ln 1.025.
  int least_samples = 4;

  /// A slice in which the truth's contour is shorter than this share of the organ's longest one grazes the organ:
  /// whether an estimate still meets it is chance. On a ball it is the outer 13 % of the radius. Of
  /// 200 runs of quick 30 miss such a slice (32 of 207 mm), none misses another.
  double grazing_share = 0.5;

  /// Values nearer than this are the same. The whole chain on quick under three other instruction sets (registration's
  /// kernels, BLAS and C library of processors without AVX, with AVX2, with AVX-512) changed no number by more than
  /// 1e-8, which is the ninth digit written; a hundred times that is allowed.
  double same_relative = 1e-6;
  double same_absolute_mm = 1e-7;

  /// Doing nothing (condition `unregistered`) must give the same errors: it is the experiment's identity. Beyond this
  /// the truth or the judge has changed, and the other curves cannot tell what the registration has to do with it. A
  /// quarter of the gate's margin.
  double control_relative = 0.01;
  double control_absolute_mm = 0.01;
  /// Numbers of the judge's points may differ by so much (a mesh of another processor), never by more.
  double points_relative = 0.02;
  int points_absolute = 2;

  /// mm, of condition `full` at every step of every run: the paper's bound for small motion (section 6.2). Where the
  /// baseline itself is not below it the bound is named and not applied.
  double ceiling_mm = 4.0;
};
} // namespace pelvireg::regression
