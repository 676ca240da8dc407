#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <fmt/format.h>

#include "scan_log.h"

/// Drift of a scanner that stands in a rectangular room for 10 minutes at 10 Hz, its noise learned.
///
/// odometry.at_rest.{position_mm,heading_deg}: a full circle of 360 beams, 1 cm of noise;
/// at_rest_short.*: 512 beams over 180° that reach 5.6 m in a hall, so that two thirds of them come
/// back empty.
namespace sightline::bench {

class StandingScanner {
 public:
  StandingScanner(std::size_t beams, double view, double reach, const Eigen::Vector2d& room)
      : geometry_(scan::ScanGeometry::uniform(-0.5 * view, view / static_cast<double>(beams), beams,
                                              0.0, 0.05, reach)),
        half_(0.5 * room) {}

  geometry::Pose2 stand(int scans) {
    NoTransforms transforms;
    pipeline::ScanFeed feed({}, {}, {false, false}, transforms);
    feed.addScanner();
    pipeline::ScanOdometry odometry({});
    geometry::Pose2 pose;
    constexpr std::int64_t kPeriod = 100'000'000;  // ns
    for (int i = 1; i <= scans; ++i) {
      feed.add(0, scan::Scan(geometry_, kPeriod * i, ranges()), kPeriod * i);
      while (const auto result = feed.flush()) {
        if (!result->located) continue;
        if (const auto update = odometry.update(*result->located)) pose = update->pose.mean;
      }
    }
    return pose;
  }

 private:
  std::vector<double> ranges() {
    constexpr double kSigma = 0.01;  // m
    // Off the middle, and turned against the walls.
    const Eigen::Vector2d place(0.6 * half_.x(), 0.3 * half_.y());
    constexpr double kTurn = 0.3;
    std::vector<double> ranges;
    for (const double angle : geometry_->angles()) {
      const double c = std::cos(angle + kTurn);
      const double s = std::sin(angle + kTurn);
      const double x = (c > 0.0 ? half_.x() - place.x() : -half_.x() - place.x()) / c;
      const double y = (s > 0.0 ? half_.y() - place.y() : -half_.y() - place.y()) / s;
      const double range = std::min(x, y) + kSigma * noise_(random_);
      ranges.push_back(range < geometry_->rangeMax() ? range
                                                     : std::numeric_limits<double>::infinity());
    }
    return ranges;
  }

  std::shared_ptr<const scan::ScanGeometry> geometry_;
  Eigen::Vector2d half_;  // sides of the room [m]
  std::mt19937_64 random_{7};
  std::normal_distribution<double> noise_{0.0, 1.0};
};

inline void measureAtRest() {
  constexpr int kScans = 6000;
  const auto print = [](const char* name, const geometry::Pose2& pose) {
    fmt::print("odometry.{}.position_mm {:.2f} mm\n", name, 1e3 * pose.translation().norm());
    fmt::print("odometry.{}.heading_deg {:.3f} deg\n", name,
               geometry::degrees(std::abs(pose.theta())));
  };
  print("at_rest", StandingScanner(360, 2.0 * geometry::kPi, 30.0, {6.0, 4.0}).stand(kScans));
  print("at_rest_short", StandingScanner(512, geometry::kPi, 5.6, {14.0, 14.0}).stand(kScans));
}

}  // namespace sightline::bench
