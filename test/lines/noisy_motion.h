#pragma once

#include <vector>

#include "lines/room_scan.h"
#include "sightline/scan/motion_noise.h"

namespace sightline::test {

/// Scans by a sensor that did not move quite as it is said to have: the errors are drawn beam by
/// beam from the process, the scan gets the motion as it was meant and what the noise model says of
/// the rest.
struct NoisySweep {
  ScanOf scan{};
  Eigen::Vector3d motion{0, 0, 0};  ///< as meant: tangent of Pose2::exp
  scan::MotionNoise noise{};

  geometry::PolarLine wall() const { return (scan.pose.inverse() * scan.walls.front()).line(); }

  scan::Scan take(Gauss& gauss) const {
    const Eigen::Vector3d drift = gauss(noise.drift);
    const bool walks = !noise.walk.isZero(0.0);
    const double steps = static_cast<double>(scan.beams - 1);
    Eigen::Vector3d walk = Eigen::Vector3d::Zero();
    std::vector<double> ranges;
    std::vector<geometry::Pose2> meant;
    for (std::size_t i = 0; i < scan.beams; ++i) {
      const double ratio = static_cast<double>(i) / steps;
      if (i > 0 && walks) walk += gauss(Eigen::Matrix3d(noise.walk / steps));
      meant.push_back(geometry::Pose2::exp(ratio * motion));
      const geometry::Pose2 happened = moved(meant.back(), ratio * drift + walk, gauss);
      ranges.push_back(rangeFrom(happened, i, gauss));
    }
    scan::Scan result = scan.withRanges(std::move(ranges));
    result.setSensorMotion(std::move(meant));
    result.motion_noise = noise;
    return result;
  }

 private:
  geometry::Pose2 moved(const geometry::Pose2& pose, const Eigen::Vector3d& error,
                        Gauss& gauss) const {
    const geometry::Pose2 drifted(pose.translation() + error.head<2>(), pose.theta() + error[2]);
    const double turn = gauss(std::sqrt(noise.jitter));
    const geometry::Pose2 axis(noise.jitter_axis, 0.0);
    return axis * geometry::Pose2(0.0, 0.0, turn) * axis.inverse() * drifted;
  }
  double rangeFrom(const geometry::Pose2& sensor, std::size_t beam, Gauss& gauss) const {
    const double angle = scan.angle_min + static_cast<double>(beam) * scan.angle_increment;
    return scan.range(scan.pose * sensor, angle) + gauss(scan.noise.sigma);
  }
};

}  // namespace sightline::test
