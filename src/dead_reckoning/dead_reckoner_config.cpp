#include "sightline/dead_reckoning/dead_reckoner_config.h"

namespace sightline::dead_reckoning {

namespace {

constexpr config::Range kShare{0.0, 1.0};
constexpr config::Range kAngle{1e-4, 3.2};

}  // namespace

void CarrierConfig::visit(config::FieldVisitor& visitor) {
  visitor.number(
      "max_speed", max_speed,
      {"m/s",
       {1e-3, 50.0},
       "the carrier is never faster; a scan is sought 12 m from the prediction at most (24 m "
       "by method histogram)"});
  visitor.number("max_turn_rate", max_turn_rate,
                 {"rad/s", {1e-3, 50.0}, "the carrier never turns faster"});
  visitor.number(
      "acceleration", acceleration,
      {"m/s^2", {1e-3, 100.0}, "standard deviation of what its velocity does between two scans"});
  visitor.number("turn_acceleration", turn_acceleration,
                 {"rad/s^2",
                  {1e-3, 100.0},
                  "standard deviation of what its turn rate does between two scans"});
}

void SubmapConfig::visit(config::FieldVisitor& visitor) {
  visitor.integer("keyframes", keyframes,
                  {"scans",
                   {1, 1000},
                   "most scans that make up the reference; the newest 50 tell what is free space"});
  visitor.number("spacing", spacing, {"m", {0.0, 10.0}, "distance between two keyframes"});
  visitor.number("turn_spacing", turn_spacing, {"rad", kAngle, "turn between two keyframes"});
  visitor.number("surface_sigma", surface_sigma,
                 {"m", {1e-4, 1.0}, "roughness of surfaces and errors of the reference"});
  visitor.number("max_cost", max_cost,
                 {"1", kShare, "share of a scan left unexplained above which a match has failed"});
  visitor.number("max_contradictions", max_contradictions,
                 {"1", kShare,
                  "share of a scan that the reference contradicts above which a match has failed"});
}

void PoseSpaceConfig::visit(config::FieldVisitor& visitor) {
  visitor.number(
      "step", step,
      {"m",
       {1e-3, 1.0},
       "finest grid of positions (saarinen alg. 4); the first grid holds 5e5 poses at most, and is "
       "coarser where the window is wide"});
  visitor.number("angle_step", angle_step, {"rad", {1e-3, 0.2}, "grid of headings"});
  visitor.number("threshold", threshold,
                 {"m", {1e-3, 1.0}, "two points this near are a match, th (saarinen eq. 4.5)"});
  visitor.number(
      "hold_share", hold_share,
      {"1", kShare, "share of beams that match while the reference scan is held (200 of 361)"});
}

void HistogramConfig::visit(config::FieldVisitor& visitor) {
  visitor.number("bin", bin, {"rad", {1e-3, 0.2}, "bin of the angle histogram (saarinen alg. 6)"});
  visitor.numbers("steps", steps,
                  {"deg",
                   {0.5, 60.0},
                   "turn of the beam between the two points of a direction, N of saarinen alg. 6"});
  visitor.integer("candidates", candidates,
                  {"headings", {1, 100}, "most headings the translation is sought for"});
  visitor.number("resolution", resolution,
                 {"m", {1e-3, 1.0}, "of the translation (saarinen alg. 7)"});
  visitor.number(
      "max_distance", max_distance,
      {"m", {1e-2, 2.0}, "distance from which on points are outliers, D (saarinen eq. 4.8)"});
}

void DeadReckonerConfig::visit(config::FieldVisitor& visitor) {
  visitor.choice("method", method, {"submap", "pose_space", "histogram"},
                 "how two places are compared: submap, or the thesis's own (saarinen algs 4, 5-7)");
  visitor.group("carrier", carrier);
  visitor.number("max_gap", max_gap,
                 {"s",
                  {0.01, 1e4},
                  "time whose motion is sought at most, however long no scan came or none was "
                  "matched"});
  visitor.group("submap", submap);
  visitor.group("pose_space", pose_space);
  visitor.group("histogram", histogram);
}

}  // namespace sightline::dead_reckoning
