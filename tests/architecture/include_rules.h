// Who may include what (DESIGN, section 2).
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace pelvireg::architecture
{
/// Problems of one source file as sentences "file:line: what, what is allowed".
/// file: path from the root, with '/'. text: its content. known_files: every source file's path from the root.
std::vector<std::string> include_problems(const std::string &file, const std::string &text,
                                          const std::set<std::string> &known_files);

/// Paths from the root of every .h and .cc file in the source folders, sorted.
std::set<std::string> source_files(const std::filesystem::path &root);
} // namespace pelvireg::architecture
