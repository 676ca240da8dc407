#pragma once

#include <cstdint>

#include <Eigen/Geometry>

#include "sightline/config/fields.h"
#include "sightline/geometry/angle.h"
#include "sightline/geometry/attitude.h"
#include "sightline/geometry/pose2.h"
#include "sightline/simulation/random_stream.h"

namespace sightline::simulation {

/// Motion of the trunk of a walking person about the person's path. The amplitudes are the largest,
/// at walking speed; a person who stands still keeps still.
struct GaitConfig {
  double height = 1.2;                    ///< of the point that the trunk turns about [m]
  double speed = 1.3;                     ///< of a person who walks [m/s]
  double step_rate = 1.9;                 ///< steps a second at that speed [Hz]
  double lean = geometry::radians(1.0);   ///< mean pitch, positive forward [rad]
  double pitch = geometry::radians(9.0);  ///< once a step [rad]
  double roll = geometry::radians(3.0);   ///< once in two steps [rad]
  double yaw = geometry::radians(4.0);    ///< once in two steps [rad]
  double sway = 0.03;                     ///< to the side, once in two steps [m]
  double bob = 0.02;                      ///< up and down, once a step [m]
  double variation = 0.5;  ///< share by which the amplitudes differ from stride to stride, [0, 1]

  void visit(config::FieldVisitor& visitor);
};

/// Displacement of the trunk from the upright, level pose on the person's path.
struct BodyMotion {
  double sway = 0.0;  ///< to the left [m]
  double bob = 0.0;   ///< upwards [m]
  double yaw = 0.0;   ///< [rad]
  geometry::Attitude attitude;

  /// The part that lies in the plane, to be put after the pose on the path.
  geometry::Pose2 inPlane() const { return {0.0, sway, yaw}; }
  /// The rest, in the frame that this leaves, about a point `height` [m] above the floor.
  Eigen::Isometry3d outOfPlane(double height) const;
};

/// Motion on the straight line from a (ratio 0) to b (ratio 1).
BodyMotion interpolate(const BodyMotion& a, const BodyMotion& b, double ratio);

/// The trunk of a person who walks at changing speed.
class Gait {
 public:
  Gait(const GaitConfig& config, std::uint64_t seed);

  /// Walks on for `duration` [s], small against a step.
  void step(double speed, double duration);
  BodyMotion motion() const;

 private:
  // Ratios of the amplitudes of a stride to the full ones.
  struct StrideRatios {
    double pitch = 0.0;
    double roll = 0.0;
    double yaw = 0.0;
  };
  StrideRatios drawStride();

  GaitConfig config_;
  RandomStream random_;
  double phase_ = 0.0;        // of the stride, two steps long, in [0, 2π)
  double pace_ = 0.0;         // speed as a share of that of walking, smoothed
  StrideRatios stride_;       // at the start of the stride
  StrideRatios next_stride_;  // at its end
};

}  // namespace sightline::simulation
