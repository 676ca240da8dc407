#pragma once

#include <unistd.h>

#include <chrono>
#include <cstddef>
#include <cstdio>
#include <string>

namespace sightline::tools {

/// A bar on a terminal; elsewhere a line now and then, of what lasts longer than some seconds.
class ProgressBar {
 public:
  /// @param ratio  of the work that is done, 0 to 1
  void show(double ratio) {
    const int percent = static_cast<int>(100.0 * ratio);
    if (percent == shown_) return;
    on_terminal_ ? draw(percent) : tell(percent);
  }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::seconds kBetweenLines{3};

  void draw(int percent) {
    shown_ = percent;
    const std::string done(static_cast<std::size_t>(percent / 2), '=');
    std::fprintf(stderr, "\r[%-50s] %3d %%%s", done.c_str(), percent, percent == 100 ? "\n" : "");
  }

  void tell(int percent) {
    if (Clock::now() < told_ + kBetweenLines) return;
    told_ = Clock::now();
    shown_ = percent;
    std::fprintf(stderr, "%d %%\n", percent);
  }

  bool on_terminal_ = isatty(STDERR_FILENO) == 1;
  int shown_ = -1;  // percent
  Clock::time_point told_ = Clock::now();
};

}  // namespace sightline::tools
