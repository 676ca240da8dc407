#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sightline/gaze/fixation.h"
#include "sightline/gaze/gaze_config.h"
#include "sightline/gaze/head_watch.h"
#include "sightline/gaze/informing_head.h"
#include "sightline/scan/scan.h"
#include "sightline/world/room_map.h"

namespace sightline::gaze {

/// Outcome of a wish to look at something.
struct Fixated {
  bool success = false;
  std::uint32_t id = 0;
  std::string message;  ///< why not
};

/// Where the gaze stands.
struct GazeState {
  GazeMode mode = GazeMode::kHold;
  bool rests = false;            ///< the head went to its rest for want of input
  std::string message;           ///< what keeps the gaze from doing what it is told; or empty
  std::optional<double> wanted;  ///< head angle [rad]
  std::uint32_t target = 0;      ///< feature that is fixated; 0: none
  bool is_target_lost = false;
  std::optional<Eigen::Vector2d> place;  ///< of the target, in odom [m]
};

/// Decides where a head looks: holds, sweeps, keeps a feature in view, or looks where the pose
/// becomes the most certain. Its input comes as values with the time at which they hold; times are
/// those of ROS [ns]. Not thread-safe.
class GazeControl {
 public:
  /// Throws config::Error.
  explicit GazeControl(const GazeConfig& config);
  // Its parts refer to its settings.
  GazeControl(const GazeControl&) = delete;
  GazeControl& operator=(const GazeControl&) = delete;

  void setMap(world::RoomMap map) { informing_.setMap(std::move(map)); }
  void setMounting(const geometry::Pose2& T_base_mount) { T_base_mount_ = T_base_mount; }
  void setField(const SensorField& field) { config_.field = field; }

  void takeOdometry(std::int64_t stamp, const geometry::Pose2& T_odom_base);
  void takePose(std::int64_t stamp, const geometry::UncertainPose2& T_map_base);
  void takeFeatures(std::int64_t stamp, const std::vector<geometry::Feature>& features);
  void takeHead(std::int64_t now, double angle);
  /// A scan of the sensor on the head, to learn what the walls of the map are hidden by.
  void takeScan(const scan::Scan& scan, const geometry::Pose2& T_mount_sensor);

  void hold();
  void sweep();
  void inform();
  Fixated fixate(std::uint32_t id);
  Fixated fixateAt(const Eigen::Vector2d& place_odom);
  Fixated fixateNearestCorner();
  Fixated fixateMostInformative();

  /// The command for now, within the limits of the head; nothing where it goes on as it was told.
  std::optional<motion::HeadCommand> decide(std::int64_t now);
  const GazeState& state() const { return state_; }
  const GazeConfig& config() const { return config_; }

 private:
  void restartClock(std::int64_t now);
  void setMode(GazeMode mode);
  Fixated fixate(const geometry::Feature* feature, const std::string& fault);
  bool isFresh(const std::optional<std::int64_t>& stamp, std::int64_t now) const;

  std::optional<double> wanted(std::int64_t now);
  std::optional<double> wantedFixating(std::int64_t now);
  std::optional<double> wantedInforming(std::int64_t now);
  double wantedSweeping();
  double rest(const std::string& reason);
  bool watchHead(std::int64_t now);
  std::optional<motion::HeadCommand> command(double angle, std::int64_t now);

  GazeConfig config_;
  GazeState state_;
  HeadWatch watch_;
  CarrierMotion motion_;
  InformingHead informing_;
  std::optional<geometry::Pose2> T_base_mount_;
  std::vector<geometry::Feature> features_;
  std::optional<std::int64_t> features_stamp_;
  std::optional<Fixation> fixation_;
  bool is_nearest_ = false;  // whether any nearest corner will do for it
  std::optional<std::int64_t> now_;
  double sweep_sense_ = 1.0;
  std::optional<double> commanded_;      // [rad]
  std::optional<GazeMode> interrupted_;  // by a head that did not answer
  std::int64_t commanded_at_ = 0;
};

}  // namespace sightline::gaze
