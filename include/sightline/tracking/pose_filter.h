#pragma once

#include <cmath>

#include <Eigen/Core>

#include "sightline/geometry/polar_line.h"
#include "sightline/geometry/pose2.h"
#include "sightline/tracking/tracker_config.h"

namespace sightline::tracking {

/// Kalman filter over (x, y, θ, s): the robot's pose in the map and the scale of its odometry, true
/// length over measured (jensfelt section 4.1; composed in the body frame with both Jacobians, the
/// scale as a state).
class PoseFilter {
 public:
  PoseFilter(const TrackerConfig& config, const geometry::UncertainPose2& start);

  /// Changes settings and keeps the state.
  void configure(const TrackerConfig& config) { config_ = config; }
  /// Moves by a step of odometry, given in the body frame at its start.
  void predict(const geometry::Pose2& step);
  /// Begins a scan: `motion_covariance` is of the motion over its sweep, in coordinates of the base
  /// frame.
  void beginSweep(const Eigen::Matrix3d& motion_covariance);
  /// What a measured line of the base frame says against its wall in the map, first order.
  struct Innovation {
    Eigen::Vector2d value;                 ///< (ρ, φ) measured less predicted, heading wrapped
    Eigen::Matrix2d covariance;            ///< S, of the value
    Eigen::Matrix<double, 2, 7> jacobian;  ///< of the prediction by the state
    double nis = 0.0;
  };
  /// `motion_jacobian` is of the measured line by the motion over the sweep.
  Innovation innovation(const geometry::PolarLine& measured_base,
                        const geometry::PolarLine& wall_map,
                        const Eigen::Matrix<double, 2, 3>& motion_jacobian) const;
  /// Takes the innovation in (jensfelt eq. 9).
  void update(const Innovation& innovation);
  /// Adds independent uncertainty [m, rad].
  void inflate(double position_sigma, double heading_sigma);
  /// Method plain: keeps every standard deviation at the floor or above (jensfelt section 4.3).
  void applyFloor();

  geometry::UncertainPose2 pose() const;
  double scale() const { return scale_; }
  double scaleSigma() const { return std::sqrt(covariance_(3, 3)); }
  /// Covariance of x, y, θ and s.
  Eigen::Matrix4d covariance() const { return covariance_.topLeftCorner<4, 4>(); }

 private:
  void predictFull(const geometry::Pose2& step);
  void predictPlain(const geometry::Pose2& step);

  TrackerConfig config_;
  geometry::Pose2 pose_;
  double scale_;
  // m: the error of the motion over the sweep, as reported; and the variance of its heading before
  // the scan was taken in.
  Eigen::Vector3d motion_error_ = Eigen::Vector3d::Zero();
  double sweep_heading_variance_ = 0.0;
  Eigen::Matrix<double, 7, 7> covariance_ = Eigen::Matrix<double, 7, 7>::Zero();
};

}  // namespace sightline::tracking
