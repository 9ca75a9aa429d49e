// The built-in case files, embedded when the program is configured.
#pragma once

#include <vector>

namespace pelvireg::anatomy
{
struct BuiltInCase
{
  const char *name, *text;
};

/// In the order in which they are listed. Defined in a generated file (CMakeLists.txt).
std::vector<BuiltInCase> built_in_case_texts();
} // namespace pelvireg::anatomy
