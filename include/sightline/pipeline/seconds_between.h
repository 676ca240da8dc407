#pragma once

#include <cstdint>

namespace sightline::pipeline {

/// Time from one stamp to another [ns], in seconds.
inline double secondsBetween(std::int64_t from, std::int64_t to) {
  return 1e-9 * static_cast<double>(to - from);
}

}  // namespace sightline::pipeline
