// The truth of a case that generates itself (the paper's Figure 7).
#pragma once

#include "validation/cli/stage_cache.h"

#include <string>

namespace pelvireg::cli
{
/// truth.h5 from the registration: the chain of the case `driver` is run in the subfolder "driver" up to its nominal
/// `full` registration, whose motion becomes the truth. The reference is not solved again where a result of the driver
/// lies beside this one (`run all`). Throws what the stages throw, and InputError when the driver's pelvis is another
/// one or the driver generates itself too.
void make_self_generated_truth(ResultDirectory &directory, const std::string &driver, int jobs);
} // namespace pelvireg::cli
