#include "validation/report/pictures.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <sstream>
#include <system_error>
#include <thread>

extern char **environ;

namespace pelvireg::report
{
namespace
{
namespace fs = std::filesystem;

std::optional<fs::path> find_in_path(const std::string &name)
{
  const char *path = std::getenv("PATH");
  std::istringstream folders(path ? path : "/usr/bin:/bin");
  for (std::string folder; std::getline(folders, folder, ':');)
  {
    const fs::path candidate = fs::path(folder) / name;
    if (!folder.empty() && access(candidate.c_str(), X_OK) == 0)
      return candidate;
  }
  return std::nullopt;
}

/// The child in a process group of its own (so that a late one can be ended together with its X server), its output
/// in `log`. Returns -1 when it cannot be started.
pid_t start(const std::vector<std::string> &words, const fs::path &log)
{
  std::vector<char *> arguments;
  for (const std::string &word : words)
    arguments.push_back(const_cast<char *>(word.c_str()));
  arguments.push_back(nullptr);

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  posix_spawnattr_setpgroup(&attributes, 0);

  pid_t child = -1;
  if (posix_spawn(&child, words.front().c_str(), &actions, &attributes, arguments.data(), environ) != 0)
    child = -1;
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  return child;
}

/// The wait status, or nothing when the child was still running at the limit (it is then ended).
std::optional<int> wait_for(pid_t child, double time_limit_s)
{
  using clock = std::chrono::steady_clock;
  const auto limit = clock::now() + std::chrono::duration<double>(time_limit_s);
  int status = 0;
  while (clock::now() < limit)
  {
    if (waitpid(child, &status, WNOHANG) == child)
      return status;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  kill(-child, SIGTERM); // xvfb-run ends its server on SIGTERM
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  kill(-child, SIGKILL);
  waitpid(child, &status, 0);
  return std::nullopt;
}

/// Where xvfb-run begins to look for a free display. Each process has its own: a server that is shutting down takes the
/// socket of one that has just started under the same number with it, and VTK aborts.
std::string first_display()
{
  return std::to_string(100 + getpid() % 30000);
}

std::string last_line(const fs::path &file)
{
  std::ifstream stream(file);
  std::string last;
  for (std::string line; std::getline(stream, line);)
    if (!line.empty())
      last = line;
  return last.substr(0, 200);
}

std::string failure_of(const std::optional<int> &status, const fs::path &log, double time_limit_s)
{
  std::ostringstream text;
  if (!status)
    text << "drawing took longer than " << time_limit_s << " s.";
  else if (WIFSIGNALED(*status))
    text << "the drawing program was ended by signal " << WTERMSIG(*status) << ".";
  else
    text << "the drawing program ended with status " << WEXITSTATUS(*status) << " (" << last_line(log) << ").";
  return text.str();
}
} // namespace

RenderOutcome render_in_child(const fs::path &result, const fs::path &folder, const fs::path &program,
                              double time_limit_s)
{
  std::error_code error;
  const fs::path executable = program.empty() ? fs::read_symlink("/proc/self/exe", error) : program;
  fs::create_directories(folder, error);
  if (error)
    return {false, "the folder " + folder.string() + " cannot be made (" + error.message() + ")."};

  for (const Picture &picture : picture_list()) // a failure must not leave those of an earlier result
    fs::remove(folder / picture.file, error);

  std::vector<std::string> words;
  if (const auto xvfb_run = find_in_path("xvfb-run"))
    words = {xvfb_run->string(), "-n", first_display(), "-a", "-s", "-screen 0 1600x1200x24"};
  else if (!std::getenv("DISPLAY"))
    return {false, "there is no X display and no xvfb-run; install the package xvfb."};
  words.insert(words.end(), {executable.string(), "render", result.string(), folder.string()});

  const fs::path log = folder / "render.log";
  const pid_t child = start(words, log);
  if (child < 0)
    return {false, words.front() + " could not be started."};
  const auto status = wait_for(child, time_limit_s);
  const bool ok = status && WIFEXITED(*status) && WEXITSTATUS(*status) == 0;
  const RenderOutcome outcome = {ok, ok ? "" : failure_of(status, log, time_limit_s)};
  fs::remove(log, error);
  return outcome;
}
} // namespace pelvireg::report
