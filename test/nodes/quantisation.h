#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "sightline/driver/messages.h"
#include "sightline/geometry/angle.h"
#include "sightline/geometry/line_segment.h"
#include "sightline/simulation/active_sensor.h"
#include "sightline/simulation/emulated_firmware.h"
#include "sightline/triangulation/ranger.h"

namespace sightline::test {

inline constexpr double kHalfCount = 0.5e-15 * simulation::kFemtoamperesPerCount;  // [A]
inline constexpr double kHalfAngle = 0.5 * driver::kAngleUnit;                     // [rad]

/// What a driver may make of a measured scan: the wire rounds its currents and angles.
class Quantisation {
 public:
  explicit Quantisation(const triangulation::RawScan& measured)
      : measured_(measured), exact_(ranger_.range(measured)) {}

  const scan::Scan& exact() const { return exact_.scan; }

  void expectSame(const motion::RangeScan& published) {
    ASSERT_EQ(published.scan.ranges().size(), exact_.scan.ranges().size());
    for (std::size_t beam = 0; beam < exact_.scan.ranges().size(); ++beam) {
      EXPECT_NEAR(published.head.angles[beam], exact_.head.angles[beam], 1.001 * kHalfAngle);
      expectSame(published.scan, beam);
    }
  }

  /// Whether lines are as near as ranges that err by so much leave them: at most by the error at
  /// their middle, and turned by three times that for each length, the most that a least-squares
  /// slope can be turned by.
  bool areSame(const geometry::LineSegment& a, const geometry::LineSegment& b) const {
    const double turn = 3.0 * largest_ / b.ends.length() + kHalfAngle;
    const double reach = std::max(b.ends.start.norm(), b.ends.end.norm());
    return std::abs(geometry::wrapAngle(a.line.phi - b.line.phi)) <= turn &&
           std::abs(a.line.rho - b.line.rho) <= largest_ + reach * turn;
  }

 private:
  // What is nearly out of range or nearly too dark may be so.
  void expectSame(const scan::Scan& published, std::size_t beam) {
    const auto readings = readingsNear(beam);
    const auto kind = published.kinds()[beam];
    EXPECT_TRUE(std::any_of(readings.begin(), readings.end(),
                            [&](const auto& reading) { return reading.kind == kind; }));
    if (!published.isValid(beam) || !exact_.scan.isValid(beam)) return;
    double bound = 1e-6;  // [m]: the message holds single precision
    for (const auto& reading : readings) {
      if (reading.kind == scan::ReturnKind::kInvalid) continue;
      bound = std::max(bound, 1e-6 + std::abs(reading.range - exact_.scan.ranges()[beam]));
    }
    EXPECT_NEAR(published.ranges()[beam], exact_.scan.ranges()[beam], bound);
    largest_ = std::max(largest_, bound);
  }

  // Both currents as far off as rounding takes them.
  std::array<triangulation::RangeReading, 5> readingsNear(std::size_t beam) const {
    const auto& [first, second] = measured_.currents[beam];
    return {ranger_.read(beam, {first, second}),
            ranger_.read(beam, {first + kHalfCount, second + kHalfCount}),
            ranger_.read(beam, {first + kHalfCount, second - kHalfCount}),
            ranger_.read(beam, {first - kHalfCount, second + kHalfCount}),
            ranger_.read(beam, {first - kHalfCount, second - kHalfCount})};
  }

  triangulation::Ranger ranger_{simulation::ActiveSensorProfile{}.calibrated()};
  triangulation::RawScan measured_;
  motion::RangeScan exact_;
  double largest_ = 0.0;
};

}  // namespace sightline::test
