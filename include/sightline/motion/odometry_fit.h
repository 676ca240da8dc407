#pragma once

#include <cstddef>
#include <vector>

#include "sightline/geometry/pose2.h"
#include "sightline/motion/odometry_noise.h"

namespace sightline::motion {

/// A stretch of a drive: what the odometry reported, and how the base really moved.
struct OdometryLeg {
  std::vector<geometry::Pose2> reported;  ///< steps, each in the body frame at its start
  geometry::UncertainPose2 moved;         ///< in the body frame at the start of the leg
};

/// A systematic error of odometry, as found.
struct FittedError {
  double value = 0.0;
  double sigma = 0.0;     ///< standard deviation of the value
  bool is_known = false;  ///< whether the drive tells it; if not, the value is assumed
};

struct OdometryFit {
  FittedError scale;     ///< OdometryNoise::scale_mean
  FittedError steering;  ///< OdometryNoise::steering_bias
  FittedError heading;   ///< OdometryNoise::heading_bias_per_metre [rad/m]
  /// All of it as settings: the errors that are known, and the spreads that the legs show.
  OdometryNoise noise;
  std::size_t legs = 0;
  double length = 0.0;  ///< driven [m]
  double turn = 0.0;    ///< turned, either way [rad]
};

/// Fits the errors of jensfelt's appendix to legs by least squares: scale, steering and heading
/// first, then the spreads that are left, in turn until they agree. Legs without motion say
/// nothing. A scale needs 5 m, an error of the steering two turns, and one of the heading 5 m; and
/// each a standard deviation under a hundredth.
OdometryFit fitOdometry(const std::vector<OdometryLeg>& legs);

/// Cuts a drive into legs of half a metre or half a radian.
class OdometryLegs {
 public:
  /// @param T_odom_base  as reported
  /// @param T_map_base   the true pose at the same time, as well as it is known
  void add(const geometry::Pose2& T_odom_base, const geometry::UncertainPose2& T_map_base);
  /// Ends a leg without using it: what comes next does not go on from there.
  void interrupt() { is_going_ = false; }

  const std::vector<OdometryLeg>& legs() const { return legs_; }

 private:
  void begin(const geometry::Pose2& T_odom_base, const geometry::UncertainPose2& T_map_base);

  std::vector<OdometryLeg> legs_;
  std::vector<geometry::Pose2> reported_;
  geometry::Pose2 T_odom_base_;
  geometry::UncertainPose2 start_;
  double length_ = 0.0;
  double turn_ = 0.0;
  bool is_going_ = false;
};

}  // namespace sightline::motion
