#include "sightline/tracking/tracker_config.h"

#include <cmath>

namespace sightline::tracking {

namespace {

constexpr config::Range kAngle{1e-4, 1.5};
constexpr config::Range kShare{0.0, 1.0};

}  // namespace

void GateConfig::visit(config::FieldVisitor& visitor) {
  visitor.number(
      "sigmas", sigmas,
      {"1",
       {1.0, 10.0},
       "size of a gate in standard deviations of the prediction (jensfelt section 4.2.1)"});
  visitor.number("max_opening", max_opening,
                 {"m", {0.01, 10.0}, "largest half width of a gate, delta of jensfelt fig. 4"});
  visitor.number("max_angle", max_angle,
                 {"rad", kAngle, "largest opening angle of a gate, gamma of jensfelt fig. 4"});
}

void HoughConfig::visit(config::FieldVisitor& visitor) {
  visitor.number("distance_bin", distance_bin,
                 {"m",
                  {1e-3, 1.0},
                  "bin of the range-weighted Hough transform in distance (jensfelt section 4.2); "
                  "wider where a gate would hold more than 200"});
  visitor.number(
      "angle_bin", angle_bin,
      {"rad",
       {1e-4, 0.2},
       "bin of the range-weighted Hough transform in angle (jensfelt section 4.2); wider "
       "where a gate would hold more than 200"});
}

WallConfig WallConfig::of(const world::Wall& wall) const {
  WallConfig config = *this;
  if (!wall.sigma) return config;
  config.position_sigma = std::hypot(position_sigma, wall.sigma->position);
  config.direction_sigma = std::hypot(direction_sigma, wall.sigma->direction);
  return config;
}

void WallConfig::visit(config::FieldVisitor& visitor) {
  visitor.integer("min_beams", min_beams,
                  {"beams", {3, 1000}, "fewest beams that make a wall hypothesis"});
  visitor.number("min_length", min_length,
                 {"m", {0.0, 100.0}, "shortest stretch of wall that makes a hypothesis"});
  visitor.number("position_sigma", position_sigma,
                 {"m", kShare, "how well the map knows where a wall stands"});
  visitor.number("direction_sigma", direction_sigma,
                 {"rad", kShare, "how well the map knows a wall's direction"});
  visitor.number("max_nis", max_nis,
                 {"1",
                  {1.0, 1000.0},
                  "largest normalised innovation squared of an update, 2 degrees of freedom"});
}

void DoorConfig::visit(config::FieldVisitor& visitor) {
  visitor.flag(
      "are_landmarks", are_landmarks,
      "method full: the jambs of doors correct the pose along their wall (jensfelt section "
      "5.3)");
  visitor.number("position_sigma", position_sigma,
                 {"m", kShare, "how well the map knows where a jamb stands along its wall"});
  visitor.number("asked_from", asked_from,
                 {"m",
                  {0.0, 10.0},
                  "position uncertainty along a wall from which on its jambs are asked: what walls "
                  "tell is better, as leaves of doors stand half open"});
}

void SlipConfig::visit(config::FieldVisitor& visitor) {
  visitor.number(
      "min_quality", min_quality,
      {"1", kShare, "quality below which a scan is tried again as if the wheels had slipped"});
  visitor.number("position_sigma", position_sigma,
                 {"m", {0.0, 10.0}, "position uncertainty of a slip"});
  visitor.number("heading_sigma", heading_sigma,
                 {"rad", {0.0, 3.2}, "heading uncertainty of a slip"});
}

void PlainConfig::visit(config::FieldVisitor& visitor) {
  visitor.number("point_sigma", point_sigma,
                 {"m", {1e-4, 1.0}, "noise of a point in x and in y (jensfelt section 2)"});
  visitor.number("floor_position_sigma", floor_position_sigma,
                 {"m", kShare, "least position uncertainty (jensfelt section 4.3)"});
  visitor.number("floor_heading_sigma", floor_heading_sigma,
                 {"rad", kShare, "least heading uncertainty (jensfelt section 4.3)"});
  visitor.number(
      "distance_sigma", distance_sigma,
      {"1", kShare, "error of a step's length, share of the length (jensfelt section 4.1)"});
  visitor.number(
      "heading_sigma_per_metre", heading_sigma_per_metre,
      {"rad/sqrt(m)", kShare, "spread of the heading after one metre (jensfelt section 4.1)"});
  visitor.number("steering_sigma", steering_sigma,
                 {"1", kShare, "error of a step's turn, share of the turn (jensfelt section 4.1)"});
}

void TrackerConfig::visit(config::FieldVisitor& visitor) {
  visitor.choice("method", method, {"full", "plain"},
                 "full, or what jensfelt section 4 describes and nothing else");
  visitor.flag("neighbours", neighbours,
               "method full: look for the walls of rooms behind a door too, and through it");
  visitor.group("gate", gate);
  visitor.group("hough", hough);
  visitor.group("wall", wall);
  visitor.group("doors", doors);
  visitor.group("slip", slip);
  visitor.group("odometry", odometry);
  visitor.number(
      "threshold_position_sigma", threshold_position_sigma,
      {"m",
       {0.0, 10.0},
       "position uncertainty added at a door (jensfelt section 4.3): method plain adds it to the "
       "standard deviation, method full as an independent error"});
  visitor.number(
      "threshold_heading_sigma", threshold_heading_sigma,
      {"rad",
       {0.0, 3.2},
       "heading uncertainty added at a door (jensfelt section 4.3), as that of the position"});
  visitor.group("plain", plain);
  visitor.number(
      "degraded_position_sigma", degraded_position_sigma,
      {"m", {0.0, 100.0}, "position uncertainty above which tracking is called degraded"});
  visitor.number(
      "degraded_heading_sigma", degraded_heading_sigma,
      {"rad", {0.0, 3.2}, "heading uncertainty above which tracking is called degraded"});
  visitor.number("lost_quality", lost_quality,
                 {"1", kShare, "method plain: quality below which a scan does not fit the room"});
  visitor.integer(
      "lost_scans", lost_scans,
      {"scans", {1, 10000}, "scans in a row that do not fit before tracking is called lost"});
}

}  // namespace sightline::tracking
