// The registration with a fault built in, played on a result directory's observations and judged.
#pragma once

#include "registration/mutation.h"
#include "validation/regression/result.h"

#include "synthetic/dataset/anatomy.h"
#include "synthetic/dataset/observations.h"
#include "synthetic/dataset/truth.h"

#include <filesystem>
#include <string>

namespace pelvireg::test
{
/// A result directory's inputs of the registration and of its judge.
class MutatedRun
{
public:
  explicit MutatedRun(const std::filesystem::path &result_directory);

  const dataset::Anatomy &anatomy() const { return anatomy_; }

  /// Register the conditions `full` and `no_boundary_conditions`, nominal and `n_samples` randomised runs (moduli +-10
  /// %, seed 1), and evaluate.
  regression::ErrorResult play(const registration::Mutation &mutation, int n_samples) const;

private:
  dataset::Anatomy anatomy_;
  dataset::Truth truth_;
  dataset::Observations observations_;
  std::string case_text_;
};
} // namespace pelvireg::test
