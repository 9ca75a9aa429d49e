#include "validation/report/child_process.h"
#include "validation/report/pictures.h"
#include "validation/report/x_server.h"

#include <sys/wait.h>

#include <cctype>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <sstream>
#include <system_error>

namespace pelvireg::report
{
namespace
{
namespace fs = std::filesystem;

/// What the program said last, on one line; VTK follows its messages with a line that only ends their colour.
std::string last_words(const fs::path &file)
{
  std::ifstream stream(file);
  std::string last;
  for (std::string line; std::getline(stream, line);)
    if (line.find(' ') != std::string::npos)
      last = line;
  std::erase_if(last, [](unsigned char letter) { return std::iscntrl(letter) != 0; });
  return last.substr(0, 300);
}

std::string failure_of(const std::optional<int> &status, const fs::path &log, double time_limit_s)
{
  std::ostringstream text;
  if (!status)
    text << "drawing took longer than " << time_limit_s << " s.";
  else if (WIFSIGNALED(*status))
    text << "the drawing program was ended by signal " << WTERMSIG(*status) << " (" << last_words(log) << ").";
  else
    text << "the drawing program ended with status " << WEXITSTATUS(*status) << " (" << last_words(log) << ").";
  return text.str();
}

RenderOutcome draw(const std::vector<std::string> &words, const std::string &display, const fs::path &log,
                   double time_limit_s)
{
  const pid_t child = start_child(words, {log, display});
  if (child < 0)
    return {false, words.front() + " could not be started."};
  const auto status = wait_for_child(child, time_limit_s);
  if (!status)
    end_child(child);
  const bool ok = status && WIFEXITED(*status) && WEXITSTATUS(*status) == 0;
  return {ok, ok ? "" : failure_of(status, log, time_limit_s)};
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

  const fs::path log = folder / "render.log", server_log = folder / "x_server.log";
  const auto xvfb = find_in_path("Xvfb");
  if (!xvfb && !std::getenv("DISPLAY"))
    return {false, "there is no X display and no Xvfb; install the package xvfb."};

  RenderOutcome outcome;
  const auto server = xvfb ? std::make_unique<XServer>(*xvfb, server_log) : nullptr;
  if (server && server->display().empty())
    outcome = {false, "no X server could be started (" + last_words(server_log) + ")."};
  else
    outcome = draw({executable.string(), "render", result.string(), folder.string()},
                   server ? server->display() : std::string(), log, time_limit_s);
  fs::remove(log, error);
  fs::remove(server_log, error);
  return outcome;
}
} // namespace pelvireg::report
