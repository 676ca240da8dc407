#pragma once

#include "sightline/config/fields.h"
#include "sightline/motion/odometry_noise.h"
#include "sightline/world/room_map.h"

namespace sightline::tracking {

enum class Method {
  kFull,   ///< PoseTrack: body-frame prediction, full covariances, odometry scale estimated
  kPlain,  ///< PlainTracker: what jensfelt section 4 describes and nothing else
};

/// The validation gates of jensfelt section 4.2.1.
struct GateConfig {
  double sigmas = 3.0;       ///< gate size in standard deviations of what is predicted
  double max_opening = 1.0;  ///< [m]
  double max_angle = 0.35;   ///< [rad]

  void visit(config::FieldVisitor& visitor);
};

/// The local range-weighted Hough transform of jensfelt section 4.2.
struct HoughConfig {
  double distance_bin = 0.04;    ///< [m]
  double angle_bin = 0.0087266;  ///< 0.5° [rad]

  void visit(config::FieldVisitor& visitor);
};

/// Requirements on a wall before it counts, and the accuracy of the map.
struct WallConfig {
  int min_beams = 8;
  double min_length = 0.25;        ///< [m]
  double position_sigma = 0.01;    ///< of a wall of the map [m]
  double direction_sigma = 0.004;  ///< of a wall of the map [rad]
  double max_nis = 16.0;           ///< of an update, 2 degrees of freedom

  /// The same for one wall, whose own uncertainty comes on top where the map tells it.
  WallConfig of(const world::Wall& wall) const;
  void visit(config::FieldVisitor& visitor);
};

/// Doors as landmarks: their jambs, where the map says that the wall is solid up to them.
struct DoorConfig {
  bool are_landmarks = true;
  double position_sigma = 0.03;  ///< of a jamb of the map along its wall [m]
  /// Uncertainty along a wall that its jambs are asked from on [m]: what walls tell is better.
  double asked_from = 0.05;

  void visit(config::FieldVisitor& visitor);
};

/// A step of the wheels that did not happen as reported is noticed by what the scanner sees, and
/// tried again with this much more uncertainty.
struct SlipConfig {
  double min_quality = 0.6;      ///< below which a scan is tried again
  double position_sigma = 0.15;  ///< [m]
  double heading_sigma = 0.12;   ///< [rad]

  void visit(config::FieldVisitor& visitor);
};

/// Numbers of the method plain.
struct PlainConfig {
  double point_sigma = 0.05;            ///< of a point in x and in y, jensfelt section 2 [m]
  double floor_position_sigma = 0.01;   ///< jensfelt section 4.3, where it has no number [m]
  double floor_heading_sigma = 0.0087;  ///< 0.5° [rad]
  double distance_sigma = 0.01;         ///< share of a step's length, jensfelt section 4.1
  double heading_sigma_per_metre = 0.0104719755;  ///< 0.6°, jensfelt section 4.1 [rad/√m]
  double steering_sigma = 0.001;                  ///< share of a step's turn, jensfelt section 4.1

  void visit(config::FieldVisitor& visitor);
};

struct TrackerConfig {
  Method method = Method::kFull;
  bool neighbours = true;  ///< whether walls of rooms behind a door are looked for too
  GateConfig gate;
  HoughConfig hough;
  WallConfig wall;
  DoorConfig doors;
  SlipConfig slip;
  motion::OdometryNoise odometry = motion::OdometryNoise::unmeasured();
  double threshold_position_sigma = 0.1;    ///< added on passing a door, jensfelt section 4.3 [m]
  double threshold_heading_sigma = 0.0349;  ///< 2° [rad]
  PlainConfig plain;
  double degraded_position_sigma = 0.3;    ///< [m]
  double degraded_heading_sigma = 0.0524;  ///< 3° [rad]
  double lost_quality = 0.3;
  int lost_scans = 10;

  void visit(config::FieldVisitor& visitor);
};

}  // namespace sightline::tracking
