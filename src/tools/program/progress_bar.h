#pragma once

#include <unistd.h>

#include <cstddef>
#include <cstdio>
#include <string>

namespace sightline::tools {

/// A bar on a terminal, nothing elsewhere.
class ProgressBar {
 public:
  /// @param ratio  of the work that is done, 0 to 1
  void show(double ratio) {
    const int percent = static_cast<int>(100.0 * ratio);
    if (!on_terminal_ || percent == shown_) return;
    shown_ = percent;
    const std::string done(static_cast<std::size_t>(percent / 2), '=');
    std::fprintf(stderr, "\r[%-50s] %3d %%%s", done.c_str(), percent, percent == 100 ? "\n" : "");
  }

 private:
  bool on_terminal_ = isatty(STDERR_FILENO) == 1;
  int shown_ = -1;
};

}  // namespace sightline::tools
