// Inside the store only: the reference's share of anatomy.h5.
#pragma once

#include "synthetic/dataset/anatomy.h"
#include "synthetic/dataset/store.h"

namespace pelvireg::dataset
{
void write_reference(GroupWriter group, const ReferenceModel &model);
/// Throws InputError also for a material, part or node that is named but does not exist.
ReferenceModel read_reference(const GroupReader &group);

template <typename Part> std::vector<std::string> names_of(const std::vector<Part> &parts)
{
  std::vector<std::string> names;
  for (const Part &part : parts)
    names.push_back(part.name);
  return names;
}
} // namespace pelvireg::dataset
