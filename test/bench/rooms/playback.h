#pragma once

#include <cmath>
#include <ctime>
#include <optional>
#include <vector>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "bench/rooms/recorded_drive.h"
#include "scripted_transforms.h"
#include "sightline/pipeline/scan_feed.h"
#include "sightline/tracking/room_tracker.h"

namespace sightline::bench {

/// One scan under the tracker, against the truth.
struct TrackedScan {
  double time = 0.0;  // of the scan [s]
  bool has_pose = false;
  double position_error = 0.0;                      // [m]
  double heading_error = 0.0;                       // [rad]
  double nees = 0.0;                                // of x, y and heading
  Eigen::Vector3d error = Eigen::Vector3d::Zero();  // of x, y and heading, in the map [m, rad]
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();  // that the tracker gives it
  tracking::TrackerState state = tracking::TrackerState::kInitialising;
  double quality = 0.0;
  double microseconds = 0.0;
  geometry::Pose2 truth;

  /// Nearer than 0.25 m and 5°.
  bool isRight() const {
    return has_pose && position_error <= 0.25 && heading_error <= geometry::radians(5.0);
  }
  bool isClaimed() const { return state == tracking::TrackerState::kTracking; }
};

/// Time that this thread has run [s]: other programs do not count.
inline double threadTime() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// Plays a recorded drive to a tracker through the feed, both with the settings they are shipped
/// with.
class Playback {
 public:
  Playback(tracking::RoomTracker& tracker, const geometry::Pose2& T_base_sensor)
      : tracker_(tracker), feed_({}, {}, {}, transforms_) {
    feed_.addScanner();
    transforms_.mount("", T_base_sensor);
  }

  std::vector<TrackedScan> play(const RecordedDrive& drive) {
    std::size_t reported = 0;
    for (const RecordedDrive::Sweep& sweep : drive.sweeps) {
      for (; reported < drive.odometry.size() && drive.odometry[reported].stamp <= sweep.arrival;
           ++reported) {
        transforms_.drive(drive.odometry[reported].stamp, drive.odometry[reported].pose);
      }
      feed_.add(0, sweep.scan, sweep.arrival);
      while (auto result = feed_.next(sweep.arrival)) take(*result, drive.truth);
    }
    while (auto result = feed_.flush()) take(*result, drive.truth);
    return scans_;
  }

 private:
  void take(const pipeline::FeedResult& result, const motion::PoseHistory& truth) {
    const auto& located = result.located;
    const auto T_map_base = truth.at(result.stamp);
    if (!located || !located->T_odom_base || !T_map_base) return;
    const double begin = threadTime();
    const auto update =
        tracker_.update(located->scan, *located->T_odom_base, *located->T_base_sensor);
    const double spent = threadTime() - begin;
    scans_.push_back(judge(update, *T_map_base));
    scans_.back().time = 1e-9 * static_cast<double>(result.stamp);
    scans_.back().microseconds = 1e6 * spent;
  }

  static TrackedScan judge(const std::optional<tracking::TrackerUpdate>& update,
                           const geometry::Pose2& truth) {
    TrackedScan scan;
    scan.truth = truth;
    if (!update) return scan;
    Eigen::Vector3d error = update->pose.mean.coordinates() - truth.coordinates();
    error[2] = geometry::wrapAngle(error[2]);
    scan.has_pose = true;
    scan.error = error;
    scan.covariance = update->pose.covariance;
    scan.position_error = error.head<2>().norm();
    scan.heading_error = std::abs(error[2]);
    scan.nees = error.dot(update->pose.covariance.inverse() * error);
    scan.state = update->state;
    scan.quality = update->quality;
    return scan;
  }

  tracking::RoomTracker& tracker_;
  test::ScriptedTransforms transforms_;
  pipeline::ScanFeed feed_;
  std::vector<TrackedScan> scans_;
};

}  // namespace sightline::bench
