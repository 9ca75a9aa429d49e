// Small contents of every file, with every field set to a value of its own.
#pragma once

#include "synthetic/dataset/anatomy.h"
#include "synthetic/dataset/estimate.h"
#include "synthetic/dataset/observations.h"
#include "synthetic/dataset/truth.h"
#include "tests/scratch_folder.h"

#include <filesystem>
#include <string>

namespace pelvireg::dataset::testing
{
Anatomy sample_anatomy();
Truth sample_truth();
Observations sample_observations();
Estimate sample_estimate();

using test::ScratchFolder;

std::string bytes_of(const std::filesystem::path &file);
} // namespace pelvireg::dataset::testing
