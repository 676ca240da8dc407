#pragma once

#include <cstddef>
#include <deque>
#include <optional>

#include "sightline/tracking/tracking_context.h"

namespace sightline::tracking {

/// A scan that is kept, and where it was taken.
struct KeyScan {
  scan::Scan scan;
  geometry::Pose2 T_odom_base;
  geometry::Pose2 T_base_sensor;
  geometry::Pose2 T_odom_view;  ///< where the first scan of the same view was taken
};

/// Whether a scan taken there says something new: 0.3 m or 20° away.
bool isAnotherView(const geometry::Pose2& T_odom_base, const geometry::Pose2& T_odom_other);

/// The last scans that say something new each, taken 0.3 m or 20° apart: hypotheses that turn up
/// late are judged by them too.
class KeyScans {
 public:
  /// Whether a scan taken here says something new.
  bool isNew(const TrackerInput& input) const;
  /// Keeps a scan, in the place of the last one where it is of the same view. A view does not move
  /// with the scans that it keeps: a robot that turns slowly sees another one in the end.
  void add(const TrackerInput& input);
  void clear() { scans_.clear(); }

  bool empty() const { return scans_.empty(); }
  /// Logarithm of the likelihood of all scans but the last one, were the robot now at a pose, and
  /// had it come there as the odometry says.
  double logLikelihoodBefore(const world::RoomMap& map, const geometry::Pose2& T_map_base,
                             double usual_hits) const;

 private:
  std::deque<KeyScan> scans_;
};

/// Path of a robot since a moment, by its odometry: what a claim of its pose has to wait for.
class WayTravelled {
 public:
  void add(const geometry::Pose2& T_odom_base);
  void restart() { length_ = turn_ = 0.0; }
  void forgetLast() { last_.reset(); }
  /// Whether it drove 2 m, or turned by 180°.
  bool isEnough() const;

 private:
  std::optional<geometry::Pose2> last_;
  double length_ = 0.0;  // [m]
  double turn_ = 0.0;    // [rad], either way cancelling the other
};

}  // namespace sightline::tracking
