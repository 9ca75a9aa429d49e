// What a person sees while a stage runs.
#pragma once

#include <chrono>
#include <functional>
#include <string>

namespace pelvireg::cli
{
/// Progress of one stage on standard output: a bar with the time left on a terminal, plain lines otherwise.
class Progress
{
public:
  explicit Progress(std::string stage);
  /// Removes an unfinished bar, so that an error message starts on a clean line.
  ~Progress();
  Progress(const Progress &) = delete;
  Progress &operator=(const Progress &) = delete;

  /// fraction: 0 … 1; message: one line of what happened.
  void update(double fraction, const std::string &message);
  /// A line that stays.
  void say(const std::string &message);
  void finish(const std::string &result);
  double seconds() const;

  /// update() as the callback that the stages take.
  std::function<void(double, const std::string &)> callback();

private:
  /// Empty while too little is done to tell.
  std::string time_left(double fraction, const std::string &separator) const;
  void draw_bar(double fraction, const std::string &message);
  void print_line(double fraction, const std::string &message);

  std::string stage_;
  bool is_terminal_;
  bool has_bar_ = false;
  std::chrono::steady_clock::time_point start_;
  std::chrono::steady_clock::time_point last_output_;
};

/// "8 s", "1 min 20 s", "2 h 5 min".
std::string duration_text(double seconds);
} // namespace pelvireg::cli
