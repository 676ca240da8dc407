#include "sightline/config/range.h"

#include <fmt/format.h>

namespace sightline::config {

std::string Range::text() const {
  const Range everything;
  if (min == everything.min && max == everything.max) return "any";
  if (max < kPositive.max) return fmt::format("[{}, {}]", min, max);
  return min == kPositive.min ? "> 0" : fmt::format(">= {}", min);
}

}  // namespace sightline::config
