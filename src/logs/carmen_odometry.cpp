#include "sightline/logs/carmen_odometry.h"

#include <algorithm>

#include "sightline/logs/carmen_stamps.h"

namespace sightline::logs {

namespace {

using geometry::Pose2;

bool usesLines(const CarmenLog& log) {
  return 2 * log.odometry.size() >= log.scans.size() && hasUsableStamps(log);
}

std::vector<CarmenOdometry> columnsOf(const CarmenLog& log) {
  std::vector<CarmenOdometry> odometry;
  odometry.reserve(log.scans.size());
  const std::vector<std::int64_t> stamps = risingStamps(log);
  for (std::size_t i = 0; i < log.scans.size(); ++i) {
    const CarmenLaser& laser = log.scans[i];
    odometry.push_back({stamps[i], laser.robot, laser.velocity.value_or(CarmenVelocity{})});
  }
  return odometry;
}

std::vector<CarmenOdometry> linesOf(const CarmenLog& log) {
  auto odometry = log.odometry;
  odometry.erase(std::remove_if(odometry.begin(), odometry.end(),
                                [](const CarmenOdometry& line) { return line.stamp <= 0; }),
                 odometry.end());
  std::stable_sort(
      odometry.begin(), odometry.end(),
      [](const CarmenOdometry& a, const CarmenOdometry& b) { return a.stamp < b.stamp; });
  return odometry;
}

// Keeps the later line of two poses with one stamp, which knows more.
void dropRepeated(std::vector<CarmenOdometry>& odometry) {
  const auto same = [](const CarmenOdometry& a, const CarmenOdometry& b) {
    return a.stamp == b.stamp;
  };
  const auto first = std::unique(odometry.rbegin(), odometry.rend(), same);
  odometry.erase(odometry.begin(), first.base());
}

// The mean over the step that ends at each pose, where nothing was measured.
void deriveVelocity(std::vector<CarmenOdometry>& odometry) {
  for (std::size_t i = 1; i < odometry.size(); ++i) {
    const double seconds = 1e-9 * static_cast<double>(odometry[i].stamp - odometry[i - 1].stamp);
    const Eigen::Vector3d step = between(odometry[i - 1].robot, odometry[i].robot).log();
    odometry[i].velocity = {step.x() / seconds, step.z() / seconds};
  }
}

}  // namespace

bool hasVelocity(const CarmenLog& log) {
  if (usesLines(log)) return true;
  return std::all_of(log.scans.begin(), log.scans.end(),
                     [](const CarmenLaser& laser) { return laser.velocity.has_value(); });
}

std::vector<CarmenOdometry> odometryOf(const CarmenLog& log) {
  auto odometry = usesLines(log) ? linesOf(log) : columnsOf(log);
  dropRepeated(odometry);
  if (!hasVelocity(log)) deriveVelocity(odometry);
  return odometry;
}

void reverseFromVelocity(std::vector<CarmenOdometry>& odometry) {
  if (odometry.empty()) return;
  Pose2 logged = odometry.front().robot;
  for (std::size_t i = 1; i < odometry.size(); ++i) {
    const Pose2 step = between(logged, odometry[i].robot);
    logged = odometry[i].robot;
    const bool contradicts = odometry[i].velocity.translation < 0.0 && step.x() > 0.0;
    const Pose2 repaired = contradicts ? Pose2(-step.translation(), step.theta()) : step;
    odometry[i].robot = odometry[i - 1].robot * repaired;
  }
}

}  // namespace sightline::logs
