#include "sightline/simulation/cable.h"

#include <algorithm>
#include <cmath>

namespace sightline::simulation {

namespace {

constexpr std::size_t kLongestBurst = 64;

}  // namespace

bool Cable::happens(double share) {
  return share > 0.0 && std::bernoulli_distribution(share)(random_);
}

bool Cable::pass(std::vector<std::uint8_t>& bytes) {
  if (bytes.empty()) return true;
  const bool burst_hit = burst(bytes);
  const bool corrupted = corrupt(bytes);
  const bool dropped = drop(bytes);
  return !burst_hit && !corrupted && !dropped;
}

// Changes at least the first byte of the burst.
bool Cable::burst(std::vector<std::uint8_t>& bytes) {
  if (!happens(faults_.bursts)) return false;
  const std::size_t begin = random_() % bytes.size();
  const std::size_t end = std::min(bytes.size(), begin + 1 + random_() % kLongestBurst);
  bytes[begin] ^= static_cast<std::uint8_t>(1 + random_() % 255);
  for (std::size_t i = begin + 1; i < end; ++i) bytes[i] = static_cast<std::uint8_t>(random_());
  return true;
}

bool Cable::corrupt(std::vector<std::uint8_t>& bytes) {
  if (faults_.corrupted <= 0.0) return false;
  bool any = false;
  for (std::uint8_t& byte : bytes) {
    if (!happens(faults_.corrupted)) continue;
    byte ^= static_cast<std::uint8_t>(1 + random_() % 255);
    any = true;
  }
  return any;
}

bool Cable::drop(std::vector<std::uint8_t>& bytes) {
  if (faults_.dropped <= 0.0) return false;
  const auto end = std::remove_if(bytes.begin(), bytes.end(),
                                  [this](std::uint8_t) { return happens(faults_.dropped); });
  const bool any = end != bytes.end();
  bytes.erase(end, bytes.end());
  return any;
}

std::int64_t Cable::delay() {
  const double jitter = std::uniform_real_distribution<>(0.0, 1.0)(random_) * faults_.jitter;
  return std::llround(1e9 * (faults_.delay + jitter));
}

}  // namespace sightline::simulation
