// The optional groups `balance` and `discretisation_error` of truth.h5.
#pragma once

#include "synthetic/dataset/store.h"
#include "synthetic/dataset/truth.h"

namespace pelvireg::dataset
{
/// Truth::balances, energy_parts and supports. Throws ComputationError for a record without one value a part, cavity or
/// support.
void write_balances(GroupWriter group, const Truth &truth);
/// Fills the same fields; truth.cavity_names must be there. Throws InputError for another number of rows or columns.
void read_balances(const GroupReader &group, std::int64_t n_increments, Truth &truth);

void write_discretisation_error(GroupWriter group, const DiscretisationError &error);
/// Throws InputError for another number of rows.
DiscretisationError read_discretisation_error(const GroupReader &group, std::int64_t n_increments);
} // namespace pelvireg::dataset
