#include "validation/cli/progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <sys/ioctl.h>
#include <unistd.h>

namespace pelvireg::cli
{
namespace
{
constexpr int bar_width = 24;
constexpr double seconds_between_lines = 10;
constexpr double seconds_between_bars = 0.1;

double seconds_since(std::chrono::steady_clock::time_point instant)
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - instant).count();
}

std::size_t terminal_width()
{
  winsize size{};
  return ::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 20 ? size.ws_col : 80;
}
} // namespace

std::string duration_text(double seconds)
{
  const auto whole = static_cast<long>(seconds + 0.5);
  if (whole < 60)
    return fmt::format("{} s", whole);
  if (whole < 3600)
    return fmt::format("{} min {} s", whole / 60, whole % 60);
  return fmt::format("{} h {} min", whole / 3600, whole % 3600 / 60);
}

Progress::Progress(std::string stage)
    : stage_(std::move(stage)), is_terminal_(::isatty(STDOUT_FILENO) != 0), start_(std::chrono::steady_clock::now()),
      last_output_(start_)
{
}

Progress::~Progress()
{
  if (has_bar_)
    fmt::print("\r\033[K");
  std::fflush(stdout);
}

double Progress::seconds() const
{
  return seconds_since(start_);
}

void Progress::update(double fraction, const std::string &message)
{
  const double pause = is_terminal_ ? (has_bar_ ? seconds_between_bars : 0) : seconds_between_lines;
  if (seconds_since(last_output_) < pause)
    return;
  last_output_ = std::chrono::steady_clock::now();
  if (is_terminal_)
    draw_bar(std::clamp(fraction, 0.0, 1.0), message);
  else
    print_line(std::clamp(fraction, 0.0, 1.0), message);
  std::fflush(stdout);
}

std::string Progress::time_left(double fraction, const std::string &separator) const
{
  return fraction > 0.01 ? separator + duration_text(seconds() * (1 - fraction) / fraction) + " left" : "";
}

void Progress::draw_bar(double fraction, const std::string &message)
{
  const int filled = static_cast<int>(fraction * bar_width);
  std::string line = fmt::format("{:<10} [{}{}] {:3.0f} %", stage_, std::string(static_cast<std::size_t>(filled), '#'),
                                 std::string(static_cast<std::size_t>(bar_width - filled), '.'), 100 * fraction);
  line += time_left(fraction, "  ") + "  " + message;
  // A line that wraps could not be drawn over.
  fmt::print("\r\033[K{}", line.substr(0, terminal_width() - 1));
  has_bar_ = true;
}

void Progress::print_line(double fraction, const std::string &message)
{
  fmt::print("{}: {:.0f} %{}, {}\n", stage_, 100 * fraction, time_left(fraction, ", "), message);
}

void Progress::say(const std::string &message)
{
  fmt::print("{}{}: {}\n", has_bar_ ? "\r\033[K" : "", stage_, message);
  has_bar_ = false;
  std::fflush(stdout);
}

void Progress::finish(const std::string &result)
{
  say(fmt::format("{} ({:.1f} s)", result, seconds()));
}

std::function<void(double, const std::string &)> Progress::callback()
{
  return [this](double fraction, const std::string &message) { update(fraction, message); };
}
} // namespace pelvireg::cli
