#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "sightline/motion/pose_history.h"
#include "sightline/pipeline/arrived_scan.h"
#include "sightline/pipeline/feed_config.h"
#include "sightline/pipeline/imu_history.h"
#include "sightline/pipeline/located_scan.h"
#include "sightline/pipeline/odometry_bridge.h"
#include "sightline/pipeline/sweep_motion.h"
#include "sightline/pipeline/transforms.h"

namespace sightline::pipeline {

/// Time that a scan may still wait.
struct Patience {
  bool usual = false;  ///< for what has been coming
  bool start = false;  ///< for what has not come yet
};

/// Completes one scan from transforms, odometry and an inertial sensor (see LocatedScan).
class ScanLocator {
 public:
  /// Outcome for a scan: located, to be asked for again later, or dropped for a reason.
  struct Outcome {
    std::optional<LocatedScan> located;
    std::string reason;  ///< of a scan that is dropped
    bool waits = false;
  };

  /// The transforms have to live as long. Throws config::Error.
  ScanLocator(const FeedConfig& config, const Frames& frames, const FeedNeeds& needs,
              const Transforms& transforms);

  void addOdometry(std::int64_t stamp, const geometry::Pose2& T_odom_base);
  void addImu(const ImuReading& reading) { imu_.add(reading); }
  /// The clock was set back to about this time: forgets what is from later.
  void restartClock(std::int64_t stamp);

  /// @param before  stamp of the scan before, of whichever scanner, where there is one [ns]
  Outcome locate(const ArrivedScan& arrived, const Patience& patience,
                 std::optional<std::int64_t> before);

 private:
  struct Mounting {
    Eigen::Isometry3d T_base_carried = Eigen::Isometry3d::Identity();
    bool is_fixed = true;  // the same each time it was asked for
  };
  enum class Known { kYes, kNot, kWait, kNever };

  Known findMounting(const ArrivedScan& arrived, const Patience& patience,
                     std::optional<Eigen::Isometry3d>& T_base_carried);
  Known remember(const std::string& frame, const Eigen::Isometry3d& T_base_carried);
  Known findOdometry(const ArrivedScan& arrived, const Patience& patience);
  Known findImu(const ArrivedScan& arrived, const Patience& patience) const;
  Known waitForFirst(const std::string& what, const Patience& patience);
  void chooseSource(const std::string& frame);
  std::optional<std::int64_t> newestOdometry(const std::string& frame) const;
  std::optional<geometry::Pose2> T_odom_base(std::int64_t stamp) const;
  std::optional<Eigen::Isometry3d> T_odom_carried(const std::string& frame,
                                                  std::int64_t stamp) const;
  void place(const ArrivedScan& arrived, const std::optional<Eigen::Isometry3d>& T_base_carried,
             LocatedScan& located);
  void maskBody(const ArrivedScan& arrived, LocatedScan& located) const;
  void followWheels(const ArrivedScan& arrived, LocatedScan& located);
  void addMotion(const ArrivedScan& arrived, std::int64_t lag, LocatedScan& located) const;
  std::optional<std::int64_t> lagOf(const ArrivedScan& arrived) const;
  bool isOver(const ArrivedScan& arrived) const;
  void explain(const ArrivedScan& arrived, Known odometry, LocatedScan& located) const;
  void addInertial(const ArrivedScan& arrived, std::optional<std::int64_t> before,
                   LocatedScan& located) const;
  std::shared_ptr<const scan::ScanGeometry> mirroredGeometry(const scan::Scan& scan);

  FeedConfig config_;
  Frames frames_;
  FeedNeeds needs_;
  const Transforms& transforms_;
  SweepMotion sweep_motion_;
  motion::PoseHistory odometry_;
  OdometryBridge bridge_;
  ImuHistory imu_;
  std::optional<OdometrySource> source_;                // once it is chosen
  std::map<std::string, Mounting> mountings_;           // by frame
  std::set<std::string> given_up_;                      // what was waited for in vain
  std::shared_ptr<const scan::ScanGeometry> geometry_;  // that was mirrored last
  std::shared_ptr<const scan::ScanGeometry> mirrored_geometry_;
};

}  // namespace sightline::pipeline
