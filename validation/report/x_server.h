// A display without a screen, for drawing in a batch job.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>

namespace pelvireg::report
{
/// An Xvfb of our own, from construction to destruction. Each server has a display number that no other server of this
/// or a neighbouring process is likely to have had, and is gone before the destructor returns: a server that shuts down
/// removes the socket of one that has just started under the same number, and VTK then ends the process.
class XServer
{
public:
  /// Returns when the server answers; `log` takes its output. Tries other numbers when one is taken.
  XServer(const std::filesystem::path &xvfb, const std::filesystem::path &log);
  ~XServer();
  XServer(const XServer &) = delete;
  XServer &operator=(const XServer &) = delete;

  /// ":4711"; empty when no server could be started.
  const std::string &display() const { return display_; }

private:
  bool start(const std::filesystem::path &xvfb, const std::filesystem::path &log, const std::string &display);

  pid_t server_ = -1;
  std::string display_;
};
} // namespace pelvireg::report
