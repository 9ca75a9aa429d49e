// Inside the store only: what the steps of one run say of themselves, as a group of columns.
#pragma once

#include "synthetic/dataset/estimate.h"
#include "synthetic/dataset/store.h"

#include <cstddef>
#include <vector>

namespace pelvireg::dataset
{
/// Throws ComputationError for a step whose penetrations are not those of n_pairs pairs.
void write_steps(GroupWriter group, const std::vector<StepRecord> &steps, std::size_t n_pairs);
std::vector<StepRecord> read_steps(const GroupReader &group, std::size_t n_pairs);
} // namespace pelvireg::dataset
