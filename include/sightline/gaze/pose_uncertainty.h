#pragma once

#include <vector>

#include <Eigen/Core>

#include "sightline/gaze/wall_look.h"
#include "sightline/geometry/pose2.h"
#include "sightline/motion/odometry_noise.h"

namespace sightline::gaze {

/// Covariance of a pose in a map whose walls err by constants, as a room tracker finds it: odometry
/// adds, each look at a wall takes. To look at the same wall again and again does not take its
/// constant away, so it is kept what each wall's has done to the pose (consider analysis, Schmidt
/// 1966; see tracking::PoseFilter). A value: what if one looked there is asked of a copy.
class PoseUncertainty {
 public:
  /// @param covariance    of (x, y, θ) in the map
  /// @param wall_sigmas   of the offset [m] and turn [rad] of every wall
  PoseUncertainty(const Eigen::Matrix3d& covariance, const Eigen::Vector2d& wall_sigmas);

  /// Moves by a step from a pose.
  void predict(const geometry::Pose2& T_map_base, const geometry::Pose2& step,
               const motion::OdometryNoise& noise);
  /// Takes what so many scans say of a wall, seen by a base at such a place in the map.
  void take(const WallLook& look, const Eigen::Vector2d& base, double scans);
  /// Takes over the covariance that the tracker says; what is in it of the walls is kept.
  void adopt(const Eigen::Matrix3d& covariance);

  /// Covariance of (x, y, θ), with all that makes its error.
  Eigen::Matrix3d covariance() const;

 private:
  using ByWall = Eigen::Matrix<double, 3, 2>;
  struct Share {
    world::WallIndex wall;
    ByWall of_pose;  // derivative of the pose by the wall's error
  };
  ByWall& shareOf(const world::WallIndex& wall);
  Eigen::Matrix3d ofWalls() const;

  Eigen::Matrix3d random_;  // what is not of the walls
  Eigen::Matrix2d wall_;
  std::vector<Share> shares_;
};

}  // namespace sightline::gaze
