#pragma once

#include <memory>
#include <vector>

#include "sightline/config/fields.h"
#include "sightline/geometry/pose2.h"
#include "sightline/targets/line_of_sight.h"

namespace sightline::targets {

/// Settings of the actions that robots choose from (dames figure 3).
struct ActionSetConfig {
  int headings = 8;                             ///< evenly around, the first along the map's x axis
  std::vector<double> lengths{1.0, 4.5, 20.0};  ///< of the ways [m]
  int looks = 3;             ///< T, poses at which the robot looks, evenly along the way
  double clearance = 0.4;    ///< kept from walls ahead, and half of it beside the way [m]
  double speed = 0.5;        ///< of the robots [m/s]
  double turn_rate = 0.8;    ///< at which they turn to a way [rad/s]
  std::vector<double> area;  ///< x_min, y_min, x_max, y_max: none leads out of it; empty: all [m]

  void visit(config::FieldVisitor& visitor);
  /// Throws config::Error naming `source`.
  void check(const std::string& source = "") const;
};

/// A way that a robot may take.
struct SearchAction {
  std::vector<geometry::Pose2> poses;  ///< T_map_sensor of its looks, in order; never empty
  double duration = 0.0;               ///< [s]
};

/// Straight ways from a pose, of each heading and length. One that a wall, or the end of the area,
/// cuts short ends before it; of those that end at the same place the first is kept. Empty where
/// the robot cannot go anywhere; beside a wall the clearance is taken less strictly.
class ActionSet {
 public:
  /// `sight` tells walls; none: there are none. Throws config::Error.
  explicit ActionSet(const ActionSetConfig& config,
                     std::shared_ptr<const LineOfSight> sight = nullptr);

  std::vector<SearchAction> from(const geometry::Pose2& T_map_sensor) const;
  const ActionSetConfig& config() const { return config_; }

 private:
  std::vector<SearchAction> within(const geometry::Pose2& T_map_sensor, double clearance) const;
  bool isFree(const Eigen::Vector2d& from_map, const Eigen::Vector2d& to_map,
              double clearance) const;
  double reach(const geometry::Pose2& T_map_start, double length, double clearance) const;
  SearchAction actionTo(const geometry::Pose2& T_map_sensor, double heading, double length) const;

  ActionSetConfig config_;
  std::shared_ptr<const LineOfSight> sight_;
};

}  // namespace sightline::targets
