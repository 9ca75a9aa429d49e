// A truth that the registration made itself (the paper's Figure 7): an inverse crime, and named so.
#pragma once

#include "synthetic/dataset/anatomy.h"
#include "synthetic/dataset/estimate.h"
#include "synthetic/dataset/truth.h"

namespace pelvireg::runner
{
/// The nominal run of `estimate` taken for the truth: organs' outer surfaces at the last step of each increment; no
/// bars, no fluid, no pressure. `driver` names the case whose outlines drove it. Throws InputError when the estimate
/// has no nominal run, a failed step, or not the anatomy's number of steps.
dataset::Truth self_generated_truth(const dataset::Anatomy &anatomy, const dataset::Estimate &estimate,
                                    const std::string &driver);
} // namespace pelvireg::runner
