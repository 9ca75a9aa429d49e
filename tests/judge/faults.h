// Faults that are built into sound curves to see whether the gate catches them.
#pragma once

#include "validation/regression/compare.h"

#include <functional>
#include <string>
#include <vector>

namespace pelvireg::test
{
using regression::Curve;
using regression::CurvePoint;
using regression::ErrorResult;
using regression::FamilyName;

/// Registered families of a result, by name.
std::vector<FamilyName> registered_families(const ErrorResult &result);

/// Every error of the families that `takes` accepts, times `factor`.
ErrorResult scaled(
    ErrorResult result, double factor,
    const std::function<bool(const FamilyName &)> &takes = [](const FamilyName &) { return true; });

/// The errors of one family times `factor` at a tenth of its abscissae (at least one), from place `first` on.
ErrorResult with_bump(ErrorResult result, const FamilyName &family, std::size_t first, double factor);

/// The 95th percentiles and maxima alone times `factor`: as many points are off, the worst of them farther.
ErrorResult with_longer_tail(ErrorResult result, const FamilyName &family, double factor);

/// One figure is not a number: at place `place` of the family's curve in its last run.
ErrorResult with_nan(ErrorResult result, const FamilyName &family, std::size_t place,
                     double CurvePoint::*figure = &CurvePoint::mean);

/// Without the curves of one organ.
ErrorResult without_organ(ErrorResult result, const std::string &organ);

/// The curves by step of one organ in condition `full` one step early or late: step s has the figures of s + 1 or s
/// - 1.
ErrorResult shifted_by_one_step(ErrorResult result, const std::string &organ, bool early);

/// Every error of sample s of a family times exp(sd g), g normal: the family's curves as a whole and each of their
/// values scatter by half of the variance each. Depends on (seed, family, sample, abscissa) alone.
ErrorResult with_noise(ErrorResult result, double sd, std::uint64_t seed);

/// Samples 0 and those of `chosen`, which become 1, 2, 3, …
ErrorResult resampled(const ErrorResult &result, const std::vector<int> &chosen);

/// Without the samples above `last`.
ErrorResult first_samples(const ErrorResult &result, int last);

/// What compare() says of the two, without an anchor.
regression::Comparison gate(const ErrorResult &baseline, const ErrorResult &current);
/// The verdict of one family.
const regression::FamilyComparison &family_of(const regression::Comparison &comparison, const FamilyName &name);
} // namespace pelvireg::test
