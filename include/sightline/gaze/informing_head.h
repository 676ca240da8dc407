#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "sightline/gaze/carrier_motion.h"
#include "sightline/gaze/gaze_config.h"
#include "sightline/gaze/informative_gaze.h"
#include "sightline/scan/scan.h"

namespace sightline::gaze {

/// The mode inform: keeps what is known of the pose and of the walls of the map, and says where to
/// look for more. Times are [ns].
class InformingHead {
 public:
  /// Both have to live as long.
  InformingHead(const GazeConfig& config, const CarrierMotion& motion);

  void setMap(world::RoomMap map);
  void takePose(std::int64_t stamp, const geometry::UncertainPose2& T_map_base);
  /// A scan of the sensor on the head: what the walls are hidden by, and what is known by them.
  void takeScan(const scan::Scan& scan, const geometry::Pose2& T_base_mount,
                const geometry::Pose2& T_mount_sensor);
  void clearPose();
  void chooseAnew() { chosen_at_ = 0; }

  const std::optional<geometry::UncertainPose2>& pose() const { return T_map_base_; }
  /// The angle to look at [rad], or why there is none.
  struct Choice {
    std::optional<double> angle;
    std::string fault;
  };
  Choice choose(std::int64_t now, const std::optional<geometry::Pose2>& T_base_mount,
                double head_angle);

 private:
  // Pose and its uncertainty, carried from its stamp to a time.
  struct Carried {
    geometry::Pose2 T_map_base;
    PoseUncertainty uncertainty;
  };
  std::optional<Carried> carriedTo(std::int64_t stamp) const;
  Look choose(const Carried& carried, const geometry::Pose2& T_base_mount, double head_angle) const;

  const GazeConfig* config_;
  const CarrierMotion* motion_;
  InformativeGaze informative_;
  WallVisibility visibility_;
  std::optional<world::RoomMap> map_;
  std::optional<geometry::UncertainPose2> T_map_base_;  // as it was told last
  std::int64_t told_at_ = 0;
  std::optional<PoseUncertainty> uncertainty_;  // at the same time
  std::int64_t scanned_at_ = 0;
  double pose_period_ = 0.1;  // of the sensor's scans, too [s]
  std::int64_t chosen_at_ = 0;
  Look look_;
};

}  // namespace sightline::gaze
