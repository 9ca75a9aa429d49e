// Programs that are started and ended from here.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace pelvireg::report
{
/// The program's path when `name` is an executable of the folders in PATH.
std::optional<std::filesystem::path> find_in_path(const std::string &name);

struct ChildOptions
{
  std::filesystem::path log;         ///< takes both outputs
  std::string display;               ///< DISPLAY of the child; empty: as here
  std::optional<int> open_as_3 = {}; ///< a descriptor of this process that the child has as its number 3
};

/// Start words[0] with the arguments words[1 …], in a process group of its own, without input. -1 when it cannot be
/// started.
pid_t start_child(const std::vector<std::string> &words, const ChildOptions &options);

/// The wait status, or nothing when the child was still running at the limit.
std::optional<int> wait_for_child(pid_t child, double time_limit_s);

/// End the child and its group: asked first, forced after half a second. Returns when it is gone.
void end_child(pid_t child);
} // namespace pelvireg::report
