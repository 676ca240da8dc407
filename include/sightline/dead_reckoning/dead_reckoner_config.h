#pragma once

#include <vector>

#include "sightline/config/fields.h"

namespace sightline::dead_reckoning {

enum class Method {
  kSubmap,     ///< point-to-line matching against several keyframes, correlation where it is unsure
  kPoseSpace,  ///< correlation in pose space (saarinen alg. 4)
  kHistogram,  ///< angle histogram, then correlation of the translation (saarinen algs 5-7)
};

/// Motion that the carrier of the scanner is capable of: bounds wide enough for robots on wheels
/// and for people. How it really moves is learned (MotionHabit).
struct CarrierConfig {
  double max_speed = 6.0;           ///< [m/s], in any direction
  double max_turn_rate = 6.0;       ///< [rad/s]
  double acceleration = 5.0;        ///< standard deviation [m/s²], at most
  double turn_acceleration = 12.0;  ///< standard deviation [rad/s²], at most

  void visit(config::FieldVisitor& visitor);
};

/// The reference of the default method.
struct SubmapConfig {
  int keyframes = 20;           ///< at most
  double spacing = 0.4;         ///< distance between two keyframes [m]
  double turn_spacing = 0.35;   ///< rotation between two keyframes [rad]
  double surface_sigma = 0.01;  ///< roughness of surfaces and errors of the reference [m]
  double max_cost = 0.25;  ///< share of a scan left unexplained, above which a match has failed
  double max_contradictions = 0.2;  ///< share of a scan that contradicts, above which it has failed

  void visit(config::FieldVisitor& visitor);
};

struct PoseSpaceConfig {
  double step = 0.06;             ///< finest, of position [m]
  double angle_step = 0.0104720;  ///< finest, of heading: 0.6° [rad]
  double threshold = 0.06;        ///< th of eq. 4.5 [m]
  double hold_share = 0.55;       ///< 200 of 361 beams

  void visit(config::FieldVisitor& visitor);
};

struct HistogramConfig {
  double bin = 0.0087266;                      ///< width of a bin of directions: 0.5° [rad]
  std::vector<double> steps{5.0, 10.0, 15.0};  ///< N of alg. 6 as a turn of the beam [deg]
  int candidates = 4;                          ///< headings tried
  double resolution = 0.02;                    ///< finest step of the translation [m]
  double max_distance = 0.5;                   ///< D of eq. 4.8 [m]

  void visit(config::FieldVisitor& visitor);
};

struct DeadReckonerConfig {
  Method method = Method::kSubmap;
  CarrierConfig carrier;
  double max_gap = 10.0;  ///< time whose motion is sought at most after a gap [s]
  SubmapConfig submap;
  PoseSpaceConfig pose_space;
  HistogramConfig histogram;

  void visit(config::FieldVisitor& visitor);
};

}  // namespace sightline::dead_reckoning
