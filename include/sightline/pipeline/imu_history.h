#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "sightline/geometry/attitude.h"

namespace sightline::pipeline {

/// Reading of an inertial sensor, for the base at one time.
struct ImuReading {
  std::int64_t stamp = 0;                      ///< [ns]
  double turn_rate = 0.0;                      ///< of the heading [rad/s]
  std::optional<geometry::Attitude> attitude;  ///< of the base, where the sensor knows down
};

/// The readings of the last seconds, read at any time between them.
class ImuHistory {
 public:
  /// A reading that is not newer than the last one, or that comes after too long a gap to bridge,
  /// starts the history anew.
  void add(const ImuReading& reading);
  std::optional<std::int64_t> newest() const;

  /// Rotation of the base from one time to the other [rad]; nothing outside the history.
  std::optional<double> turn(std::int64_t from, std::int64_t to) const;
  /// Attitude at a time; nothing outside the history, or where the sensor does not know it.
  std::optional<geometry::Attitude> attitude(std::int64_t stamp) const;

 private:
  struct Sample {
    std::int64_t stamp = 0;
    ImuReading reading;
    double heading = 0.0;  // since the history began [rad]
  };
  std::optional<Sample> at(std::int64_t stamp) const;

  std::deque<Sample> samples_;
};

}  // namespace sightline::pipeline
