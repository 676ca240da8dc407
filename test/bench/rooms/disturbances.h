#pragma once

#include <algorithm>
#include <cmath>
#include <random>

#include "bench/rooms/recorded_drive.h"

/// What goes wrong on a recorded drive.
namespace sightline::bench {

/// Shortens a share of the sectors of 10° by one factor each, drawn anew each second: false walls
/// parallel to the true ones.
inline void addSectorClutter(RecordedDrive& drive, double share, std::uint64_t seed) {
  constexpr double kSector = 0.17453292519943295;
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<double> factors(36, 1.0);
  std::int64_t second = -1;
  for (RecordedDrive::Sweep& sweep : drive.sweeps) {
    if (sweep.scan.stamp / 1'000'000'000 != second) {
      second = sweep.scan.stamp / 1'000'000'000;
      for (double& factor : factors) factor = unit(random) < share ? 0.3 + 0.6 * unit(random) : 1.0;
    }
    for (std::size_t i = 0; i < sweep.scan.beams(); ++i) {
      const auto direction = sweep.scan.direction(i);
      const double angle = std::atan2(direction.y(), direction.x()) + geometry::kPi;
      const double factor = factors[static_cast<std::size_t>(angle / kSector) % factors.size()];
      const auto& scan = sweep.scan;
      const double reach = scan.isValid(i) ? scan.ranges()[i] : scan.geometry()->rangeMax();
      if (factor < 1.0) sweep.scan.setRange(i, factor * reach);
    }
  }
}

/// A motion that the wheels report and the robot does not make, spread over a time [s], in the body
/// frame. A negative turn is one that they miss.
inline void addFalseMotion(RecordedDrive& drive, double begin, double duration,
                           const Eigen::Vector3d& twist) {
  geometry::Pose2 correction;
  geometry::Pose2 before;
  bool has_before = false;
  double done = 0.0;
  for (geometry::StampedPose2& sample : drive.odometry) {
    const double time = 1e-9 * static_cast<double>(sample.stamp);
    const double share = std::clamp((time - begin) / std::max(duration, 1e-9), 0.0, 1.0);
    const geometry::Pose2 measured = sample.pose;
    const geometry::Pose2 step = has_before ? geometry::between(before, measured) : measured;
    before = measured;
    const geometry::Pose2 slip = geometry::Pose2::exp((share - done) * twist);
    done = share;
    correction = has_before ? correction * step * slip : measured;
    has_before = true;
    sample.pose = correction;
  }
}

/// The odometry stands still for a time [s], then jumps to where it should be.
inline void freezeOdometry(RecordedDrive& drive, double begin, double duration) {
  geometry::Pose2 frozen;
  for (geometry::StampedPose2& sample : drive.odometry) {
    const double time = 1e-9 * static_cast<double>(sample.stamp);
    if (time < begin) frozen = sample.pose;
    if (time >= begin && time < begin + duration) sample.pose = frozen;
  }
}

/// Odometry that reports lengths wrong by a factor.
inline void scaleOdometry(RecordedDrive& drive, double factor) {
  geometry::Pose2 before = drive.odometry.front().pose;
  geometry::Pose2 sum = before;
  for (geometry::StampedPose2& sample : drive.odometry) {
    Eigen::Vector3d tangent = geometry::between(before, sample.pose).log();
    before = sample.pose;
    tangent.head<2>() *= factor;
    sum = sum * geometry::Pose2::exp(tangent);
    sample.pose = sum;
  }
}

/// Every nth report of the odometry, as of wheels that report at 50 Hz / n.
inline void thinOdometry(RecordedDrive& drive, std::size_t every, std::size_t first) {
  std::vector<geometry::StampedPose2> kept;
  for (std::size_t i = first; i < drive.odometry.size(); i += every) {
    kept.push_back(drive.odometry[i]);
  }
  drive.odometry = std::move(kept);
}

/// From a time [s] on the robot is where another drive has it at the same time: it was carried or
/// turned, the wheels noticing nothing.
inline void moveUnnoticed(RecordedDrive& drive, const RecordedDrive& other, double time) {
  const auto from = static_cast<std::int64_t>(time * 1e9);
  const auto is_before = [&](const RecordedDrive::Sweep& sweep) { return sweep.scan.stamp < from; };
  const auto is_earlier = [&](const geometry::StampedPose2& pose) { return pose.stamp < from; };
  motion::PoseHistory truth(std::numeric_limits<std::int64_t>::max() / 2);
  const auto addTruth = [&](std::int64_t stamp, const RecordedDrive& of) {
    if (const auto pose = of.truth.at(stamp)) truth.add(stamp, *pose);
  };
  drive.sweeps.erase(std::find_if_not(drive.sweeps.begin(), drive.sweeps.end(), is_before),
                     drive.sweeps.end());
  for (const RecordedDrive::Sweep& sweep : other.sweeps) {
    if (!is_before(sweep)) drive.sweeps.push_back(sweep);
  }
  auto& odometry = drive.odometry;
  odometry.erase(std::find_if_not(odometry.begin(), odometry.end(), is_earlier), odometry.end());
  for (const geometry::StampedPose2& pose : odometry) addTruth(pose.stamp, drive);
  const auto first = std::find_if_not(other.odometry.begin(), other.odometry.end(), is_earlier);
  const auto seam = first == other.odometry.begin() ? first : std::prev(first);
  const geometry::Pose2 T_old_new = odometry.back().pose * seam->pose.inverse();
  for (auto pose = first; pose != other.odometry.end(); ++pose) {
    odometry.push_back({pose->stamp, T_old_new * pose->pose});
    addTruth(pose->stamp, other);
  }
  drive.truth = truth;
}

}  // namespace sightline::bench
