#pragma once

#include <cmath>
#include <vector>

#include <Eigen/Core>

#include "sightline/geometry/polar_line.h"
#include "sightline/geometry/pose2.h"
#include "sightline/motion/odometry_noise.h"
#include "sightline/tracking/sweep_error.h"
#include "sightline/tracking/wall_error.h"

namespace sightline::tracking {

/// Kalman filter over (x, y, θ, s): the robot's pose in the map and the scale of its odometry, true
/// length over measured (jensfelt section 4.1; composed in the body frame with both Jacobians, the
/// scale as a state). Errors of the walls of the map are constants, which no number of scans
/// averages out. The gains take them for noise of each scan, which forgives walls that are not
/// straight and things in front of them; what each constant has done to the pose is kept, for the
/// last 48 walls, and adds to the covariance (consider analysis, Schmidt 1966). A value: copies are
/// independent.
class PoseFilter {
 public:
  /// Number of states: x, y, θ and s, then the error of the sweep's motion.
  static constexpr int kStates = 4 + 3 * kKnots;

  PoseFilter(const motion::OdometryNoise& odometry, const geometry::UncertainPose2& start);

  /// Moves by a step of odometry, given in the body frame at its start.
  void predict(const motion::OdometryNoise& odometry, const geometry::Pose2& step);
  /// Begins a scan whose motion has this noise.
  void beginSweep(const SweepNoise& motion_noise);
  /// Measured line of the base frame against its wall in the map, to first order.
  struct Innovation {
    Eigen::Vector2d value;       ///< (ρ, φ) measured less predicted, heading wrapped
    Eigen::Matrix2d covariance;  ///< S, of the value
    Eigen::Matrix<double, 2, kStates> jacobian;  ///< of the prediction by the state
    double nis = 0.0;
    WallError wall;
    Eigen::Matrix2d wall_jacobian = Eigen::Matrix2d::Zero();  ///< of the prediction by its error
    /// Covariance of the states with the value's prediction.
    Eigen::Matrix<double, kStates, 2> covariance_with_states;
  };
  /// `motion_jacobian` is of the measured line. A wall that is exact has a WallError of zero
  /// covariance.
  Innovation innovation(const geometry::PolarLine& measured_base,
                        const geometry::PolarLine& wall_map,
                        const LineBySweepError& motion_jacobian, const WallError& wall = {}) const;
  /// Takes the innovation in (jensfelt eq. 9).
  void update(const Innovation& innovation);
  /// Adds an independent error of these standard deviations [m, rad].
  void inflate(double position_sigma, double heading_sigma);

  /// The same with no more uncertainty than these standard deviations [m, rad].
  PoseFilter limited(double position_sigma, double heading_sigma) const;

  /// The pose, with all that makes its error.
  geometry::UncertainPose2 pose() const;
  /// The pose with the covariance that gains and gates go by.
  geometry::UncertainPose2 assumedPose() const;
  double scale() const { return scale_; }
  double scaleSigma() const { return std::sqrt(covariance_(3, 3)); }
  /// Covariance of x, y, θ and s that the gains go by.
  Eigen::Matrix4d covariance() const { return covariance_.topLeftCorner<4, 4>(); }

 private:
  using ByWall = Eigen::Matrix<double, kStates, 2>;
  // What the constant error of a wall does to the states, and the prior of that error.
  struct WallShare {
    world::WallIndex wall;
    Eigen::Matrix2d prior;
    ByWall of_states;  // their derivative

    Eigen::Matrix<double, kStates, kStates> covariance() const {
      return of_states * prior * of_states.transpose();
    }
  };

  WallShare& shareOf(const WallError& wall);
  void updateWalls(const Innovation& innovation, const ByWall& gain);

  geometry::Pose2 pose_;
  double scale_;
  // The error of the sweep's motion as estimated, and the variance of its heading at the last beam
  // before the scan was taken in.
  SweepError motion_error_ = SweepError::Zero();
  double sweep_heading_variance_ = 0.0;
  Eigen::Matrix<double, kStates, kStates> covariance_ =
      Eigen::Matrix<double, kStates, kStates>::Zero();
  std::vector<WallShare> walls_;  // in the order in which they were first used
};

}  // namespace sightline::tracking
