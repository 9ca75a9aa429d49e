// The samples behind an NRRD header.
#pragma once

#include "synthetic/observation/images/nrrd_header.h"

#include <vector>

namespace pelvireg::observation
{
/// All samples in the order of the file, as float. `in` stands behind the header. Throws InputError when there are
/// fewer or more than the sizes say, or the compressed data are damaged.
std::vector<float> read_nrrd_samples(std::istream &in, const NrrdHeader &header, const std::string &where);
} // namespace pelvireg::observation
