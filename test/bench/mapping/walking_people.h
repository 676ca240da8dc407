#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "bench/rooms/recorded_drive.h"

namespace sightline::bench {

/// A person who walks about a robot: to a new place a few metres from it every four seconds.
class WalkingPerson {
 public:
  explicit WalkingPerson(std::uint64_t seed) : random_(seed) {}

  Eigen::Vector2d at(std::int64_t stamp, const Eigen::Vector2d& robot) {
    const double time = 1e-9 * static_cast<double>(stamp);
    if (!has_begun_ || time >= until_) begin(time, robot);
    const Eigen::Vector2d way = goal_ - start_;
    const double share = std::min(1.0, (time - since_) * kSpeed / std::max(0.01, way.norm()));
    return start_ + share * way;
  }

 private:
  static constexpr double kSpeed = 1.0;   // [m/s]
  static constexpr double kPeriod = 4.0;  // [s]

  double draw(double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(random_);
  }
  Eigen::Vector2d placeAbout(const Eigen::Vector2d& robot) {
    const double angle = draw(-geometry::kPi, geometry::kPi);
    return robot + draw(0.8, 3.0) * Eigen::Vector2d(std::cos(angle), std::sin(angle));
  }
  void begin(double time, const Eigen::Vector2d& robot) {
    start_ = has_begun_ ? goal_ : placeAbout(robot);
    goal_ = placeAbout(robot);
    since_ = time;
    until_ = time + kPeriod;
    has_begun_ = true;
  }

  std::mt19937_64 random_;
  bool has_begun_ = false;
  Eigen::Vector2d start_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d goal_ = Eigen::Vector2d::Zero();
  double since_ = 0.0;
  double until_ = 0.0;
};

/// Lets people walk through a drive, and returns the share of the beams that met them.
inline double addPeople(RecordedDrive& drive, std::uint64_t seed) {
  constexpr double kRadius = 0.22;  // [m]
  std::vector<WalkingPerson> people;
  for (std::uint64_t i = 0; i < 3; ++i) people.emplace_back(7 * seed + i);
  double met = 0.0;
  double beams = 0.0;
  for (RecordedDrive::Sweep& sweep : drive.sweeps) {
    const auto robot = drive.truth.at(sweep.scan.stamp);
    if (!robot) continue;
    for (WalkingPerson& person : people) {
      const Eigen::Vector2d place = person.at(sweep.scan.stamp, robot->translation());
      const Eigen::Vector2d seen = robot->inverse() * place;
      for (std::size_t i = 0; i < sweep.scan.beams(); ++i) {
        const Eigen::Vector2d ray = sweep.scan.direction(i);
        const double off = ray.x() * seen.y() - ray.y() * seen.x();
        const double range =
            ray.dot(seen) - std::sqrt(std::max(0.0, kRadius * kRadius - off * off));
        const bool is_met = std::abs(off) < kRadius && range > 0.1 && sweep.scan.isValid(i) &&
                            range < sweep.scan.ranges()[i];
        if (!is_met) continue;
        sweep.scan.setRange(i, range);
        met += 1.0;
      }
    }
    beams += static_cast<double>(sweep.scan.beams());
  }
  return met / std::max(1.0, beams);
}

}  // namespace sightline::bench
