#include "validation/report/child_process.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <sstream>
#include <thread>

extern char **environ;

namespace pelvireg::report
{
namespace
{
std::vector<char *> null_terminated(std::vector<std::string> &words)
{
  std::vector<char *> pointers;
  for (std::string &word : words)
    pointers.push_back(word.data());
  pointers.push_back(nullptr);
  return pointers;
}

std::vector<std::string> environment_with(const std::string &display)
{
  std::vector<std::string> entries;
  for (char **entry = environ; *entry != nullptr; ++entry)
    if (display.empty() || !std::string(*entry).starts_with("DISPLAY="))
      entries.emplace_back(*entry);
  if (!display.empty())
    entries.push_back("DISPLAY=" + display);
  return entries;
}
} // namespace

std::optional<std::filesystem::path> find_in_path(const std::string &name)
{
  const char *path = std::getenv("PATH");
  std::istringstream folders(path ? path : "/usr/bin:/bin");
  for (std::string folder; std::getline(folders, folder, ':');)
  {
    const std::filesystem::path candidate = std::filesystem::path(folder) / name;
    if (!folder.empty() && access(candidate.c_str(), X_OK) == 0)
      return candidate;
  }
  return std::nullopt;
}

pid_t start_child(const std::vector<std::string> &words, const ChildOptions &options)
{
  std::vector<std::string> argument_words = words, environment = environment_with(options.display);
  const std::vector<char *> arguments = null_terminated(argument_words), entries = null_terminated(environment);

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, options.log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
  if (options.open_as_3)
    posix_spawn_file_actions_adddup2(&actions, *options.open_as_3, 3);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  posix_spawnattr_setpgroup(&attributes, 0);

  pid_t child = -1;
  if (posix_spawn(&child, words.front().c_str(), &actions, &attributes, arguments.data(), entries.data()) != 0)
    child = -1;
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  return child;
}

std::optional<int> wait_for_child(pid_t child, double time_limit_s)
{
  using clock = std::chrono::steady_clock;
  const auto limit = clock::now() + std::chrono::duration<double>(time_limit_s);
  do
  {
    int status = 0;
    if (waitpid(child, &status, WNOHANG) == child)
      return status;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  } while (clock::now() < limit);
  return std::nullopt;
}

void end_child(pid_t child)
{
  kill(-child, SIGTERM);
  if (wait_for_child(child, 0.5))
    return;
  kill(-child, SIGKILL);
  waitpid(child, nullptr, 0);
}
} // namespace pelvireg::report
