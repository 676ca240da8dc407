#include "sightline/pipeline/imu_history.h"

#include <iterator>

#include "sightline/geometry/stamped_pose2.h"

namespace sightline::pipeline {

namespace {

constexpr std::int64_t kLength = 5'000'000'000;    // ns
constexpr std::int64_t kLongestGap = 250'000'000;  // ns

std::optional<geometry::Attitude> between(const std::optional<geometry::Attitude>& a,
                                          const std::optional<geometry::Attitude>& b,
                                          double ratio) {
  if (!a || !b) return std::nullopt;
  return geometry::Attitude{a->roll + ratio * (b->roll - a->roll),
                            a->pitch + ratio * (b->pitch - a->pitch)};
}

}  // namespace

void ImuHistory::add(const ImuReading& reading) {
  if (!samples_.empty()) {
    const std::int64_t elapsed = reading.stamp - samples_.back().reading.stamp;
    if (elapsed <= 0 || elapsed > kLongestGap) samples_.clear();
  }
  double heading = 0.0;
  if (!samples_.empty()) {
    const Sample& last = samples_.back();
    heading = last.heading + 0.5e-9 * static_cast<double>(reading.stamp - last.reading.stamp) *
                                 (last.reading.turn_rate + reading.turn_rate);
  }
  samples_.push_back({reading.stamp, reading, heading});
  while (reading.stamp - samples_.front().reading.stamp > kLength) samples_.pop_front();
}

std::optional<std::int64_t> ImuHistory::newest() const {
  if (samples_.empty()) return std::nullopt;
  return samples_.back().reading.stamp;
}

std::optional<ImuHistory::Sample> ImuHistory::at(std::int64_t stamp) const {
  const auto after = geometry::firstFrom(samples_.begin(), samples_.end(), stamp);
  if (after == samples_.end()) return std::nullopt;
  if (after->stamp == stamp) return *after;
  if (after == samples_.begin()) return std::nullopt;
  const Sample& before = *std::prev(after);
  const double ratio = geometry::ratioBetween(before.stamp, after->stamp, stamp);
  Sample sample;
  sample.stamp = stamp;
  sample.heading = before.heading + ratio * (after->heading - before.heading);
  sample.reading.attitude = between(before.reading.attitude, after->reading.attitude, ratio);
  return sample;
}

std::optional<double> ImuHistory::turn(std::int64_t from, std::int64_t to) const {
  const auto start = at(from);
  const auto end = at(to);
  if (!start || !end) return std::nullopt;
  return end->heading - start->heading;
}

std::optional<geometry::Attitude> ImuHistory::attitude(std::int64_t stamp) const {
  const auto sample = at(stamp);
  return sample ? sample->reading.attitude : std::nullopt;
}

}  // namespace sightline::pipeline
