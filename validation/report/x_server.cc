#include "validation/report/x_server.h"

#include "validation/report/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <cstdint>

namespace pelvireg::report
{
namespace
{
constexpr int n_attempts = 8, start_limit_ms = 20'000;

/// From 100 to 30099; neighbouring processes and later calls get numbers far apart (Knuth's multiplicative hash).
int display_number()
{
  static std::uint32_t n_calls = 0;
  const std::uint32_t key = static_cast<std::uint32_t>(getpid()) + (n_calls++ << 22);
  return 100 + static_cast<int>(std::uint64_t{key * 2654435769u} * 30'000 >> 32);
}

/// Xvfb writes its display's number and a line's end there when it takes connections (it must be read to the end, or
/// the server dies of a broken pipe); it ends without a word when it cannot start.
bool says_ready(int descriptor)
{
  pollfd waiting = {descriptor, POLLIN, 0};
  char letter = 0;
  while (letter != '\n')
    if (poll(&waiting, 1, start_limit_ms) != 1 || read(descriptor, &letter, 1) != 1)
      return false;
  return true;
}
} // namespace

XServer::XServer(const std::filesystem::path &xvfb, const std::filesystem::path &log)
{
  for (int attempt = 0; attempt < n_attempts && display_.empty(); ++attempt)
  {
    std::string display = ":";
    display += std::to_string(display_number());
    if (start(xvfb, log, display))
      display_ = display;
  }
}

XServer::~XServer()
{
  if (server_ > 0)
    end_child(server_);
}

bool XServer::start(const std::filesystem::path &xvfb, const std::filesystem::path &log, const std::string &display)
{
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0)
    return false;
  server_ = start_child(
      {xvfb.string(), display, "-displayfd", "3", "-screen", "0", "1600x1200x24", "-nolisten", "tcp", "-noreset"},
      {log, "", ends[1]});
  close(ends[1]);
  const bool ready = server_ > 0 && says_ready(ends[0]);
  close(ends[0]);
  if (!ready && server_ > 0)
  {
    end_child(server_);
    server_ = -1;
  }
  return ready;
}
} // namespace pelvireg::report
