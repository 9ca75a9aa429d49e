// Nodes of the registration's bodies beside Table 1 of the paper.
#pragma once

#include "synthetic/dataset/anatomy.h"
#include "validation/runner/evaluation.h"

#include <string>
#include <vector>

namespace pelvireg::runner
{
/// Of the model's bodies, in its order.
std::vector<BodySize> body_sizes(const dataset::RegistrationModel &model);

/// Nodes by body, and where the sum is within 5 % of one of Table 1's columns that column and the differences in
/// percent, "!" beside those beyond 5 %. Three or four lines, each with its newline.
std::string node_table(const std::vector<BodySize> &bodies);

/// What Table 1 has of a body in the column that fits the sum of `bodies`; 0 when none fits or it has no such body.
int table_one_nodes(const std::vector<BodySize> &bodies, const std::string &body);
} // namespace pelvireg::runner
