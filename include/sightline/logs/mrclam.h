#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "sightline/geometry/stamped_pose2.h"
#include "sightline/logs/trajectory.h"

namespace sightline::logs {

/// A marker that a camera saw.
struct MrclamSighting {
  int subject = 0;       ///< robot or landmark; 0: a code that nobody carries
  double range = 0.0;    ///< [m]
  double bearing = 0.0;  ///< [rad]
};

/// The markers in one image.
struct MrclamLook {
  std::int64_t stamp = 0;  ///< as logged [ns]
  std::vector<MrclamSighting> sightings;
};

struct MrclamVelocity {
  std::int64_t stamp = 0;
  double linear = 0.0;   ///< [m/s]
  double angular = 0.0;  ///< [rad/s]
};

struct MrclamRobot {
  int subject = 0;
  Trajectory truth;               ///< pose in the map, from outside
  std::vector<MrclamLook> looks;  ///< in the order of their stamps; empty images are not logged
  std::vector<MrclamVelocity> velocities;
};

struct MrclamLandmark {
  int subject = 0;
  Eigen::Vector2d place = Eigen::Vector2d::Zero();  ///< in the map [m]
};

/// One set of the UTIAS Multi-Robot Cooperative Localization and Mapping Dataset (Leung, Halpern,
/// Barfoot and Liu, IJRR 30(8), 2011).
struct MrclamSet {
  std::vector<MrclamRobot> robots;
  std::vector<MrclamLandmark> landmarks;
};

/// Reads a folder with Barcodes.dat, Landmark_Groundtruth.dat and RobotN_{Groundtruth,Measurement,
/// Odometry}.dat for N from 1, plain or gzipped. Throws config::Error with file and line.
MrclamSet readMrclam(const std::string& folder);

/// Time between two images of a robot [ns]: the median of the steps that are no longer than one and
/// a half times the shortest common one; 0 where there are too few looks.
std::int64_t cameraPeriod(const std::vector<MrclamLook>& looks);

/// The looks with the empty ones put back: where the step to the next is about n periods [ns], n −
/// 1 looks without sightings in between.
std::vector<MrclamLook> withEmptyLooks(const std::vector<MrclamLook>& looks, std::int64_t period);

}  // namespace sightline::logs
