#pragma once

#include <cstddef>

#include <Eigen/Core>

#include "sightline/dead_reckoning/motion_model.h"
#include "sightline/geometry/pose2.h"

namespace sightline::dead_reckoning {

/// Measurement of a pose by a match.
struct PoseMeasurement {
  /// Information on the coordinates (x, y, θ); may be singular, zero where there was no match.
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  /// Covariance of what is uncertain besides.
  Eigen::Matrix3d extra_covariance = Eigen::Matrix3d::Zero();
  /// Covariance of what the noise of the sensor's motion within the sweep makes of the pose.
  Eigen::Matrix3d motion_covariance = Eigen::Matrix3d::Zero();
  /// Share of the variance that is the same for the pose before, [0, 1].
  double common = 0.0;
};

/// The motion over which a twist was found: that since the scan before of the same scanner.
struct TwistInterval {
  std::size_t scanner = 0;
  geometry::Pose2 T_odom_base;  ///< at its beginning
  geometry::Pose2 step;
  double elapsed = 0.0;  ///< [s]; 0 at a scanner's first scan, which leaves the twist as it was
};

/// The errors of three things and how they hang together: of the pose in odom, of the pose against
/// the reference, and of the twist of the last step. Without a reference in some direction
/// the pose goes on with the twist's error: it is not a random walk, and grows faster.
///
/// Errors are of the coordinates (x, y, θ), along the axes of odom; that of the twist is in the
/// base.
class ErrorState {
 public:
  /// Certain of pose and twist.
  void reset();

  /// Covariance against the reference, after a step from T_odom_base.
  Eigen::Matrix3d predicted(const geometry::Pose2& T_odom_base, const StepPrediction& step) const;

  /// The step and the match at its end. With the gain K of the Kalman filter, the match's error v,
  /// and w what the prediction p leaves open, the error e of the pose becomes (1 − K)(p + w) − K v.
  /// Returns the covariance of the step's coordinates in the base before it.
  Eigen::Matrix3d advance(const geometry::Pose2& T_odom_base, const StepPrediction& prediction,
                          const TwistInterval& interval, const PoseMeasurement& measurement);
  /// The next scan of each scanner is taken for its first.
  void forgetScans();

  /// Says what the noise of the sensor's motion did to a scan that nothing was matched with: its
  /// surfaces are displaced as if they had been seen from a pose with this error.
  void displace(const Eigen::Matrix3d& motion_covariance);

  /// New surfaces are as far off as the pose they were seen from: this share of the reference's
  /// view takes over the error of the pose, which cannot be matched away any more. The error that
  /// the motion within their own sweep made stays the pose's: it displaced the surfaces the other
  /// way, and the reference shows them where they are.
  void handOver(double share);

  Eigen::Matrix3d pose() const { return block(kPose); }
  Eigen::Matrix3d againstReference() const { return block(kAgainst); }
  Eigen::Matrix3d twist() const { return block(kTwist); }

 private:
  static constexpr Eigen::Index kPose = 0;
  static constexpr Eigen::Index kAgainst = 3;
  static constexpr Eigen::Index kTwist = 6;
  static constexpr Eigen::Index kScanners = 9;

  using Joint = Eigen::MatrixXd;
  using Columns = Eigen::Matrix<double, Eigen::Dynamic, 3>;

  Eigen::Matrix3d block(Eigen::Index place) const { return covariance_.block<3, 3>(place, place); }
  void makeRoomFor(std::size_t scanner);
  Joint apartFrom(double common) const;
  void propagate(const Eigen::Matrix<double, 3, Eigen::Dynamic>& moved,
                 const Eigen::Matrix3d& by_pose, const TwistInterval& interval,
                 const Eigen::Matrix3d& noise, const Eigen::Matrix3d& motion);

  // Three entries each: pose, pose against the reference, twist, and for each scanner the pose
  // against that at its last scan.
  Joint covariance_ = Joint::Zero(9, 9);
  // Covariance of the error that the motion within the last sweep made of its pose, and what it has
  // in common with the errors above.
  Eigen::Matrix3d motion_ = Eigen::Matrix3d::Zero();
  Columns with_motion_ = Columns::Zero(9, 3);
};

}  // namespace sightline::dead_reckoning
