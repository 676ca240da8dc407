#pragma once

#include <cstddef>

#include <Eigen/Core>

#include "sightline/scan/motion_noise.h"
#include "sightline/scan/scan.h"

namespace sightline::lines {

/// Ratio of the sweep's time at which a beam was sent, from the first beam (0) to the last (1); 0
/// where all are sent at once.
double timeRatio(const scan::Scan& scan, std::size_t beam);
/// Covariance that drift and walk make of the sensor's coordinates (x, y, θ) in a part of the
/// sweep.
Eigen::Matrix3d covarianceAfter(double time_ratio, const scan::MotionNoise& noise);
/// Covariance that drift and walk make of the sensor's coordinates (x, y, θ) at a beam, in its
/// frame at the stamp.
Eigen::Matrix3d motionCovariance(const scan::Scan& scan, std::size_t beam);
/// ∂ of a point seen by a beam, in the frame at the stamp, by the sensor's coordinates at the beam.
Eigen::Matrix<double, 2, 3> motionJacobian(const scan::Scan& scan, std::size_t beam,
                                           const Eigen::Vector2d& point);

}  // namespace sightline::lines
