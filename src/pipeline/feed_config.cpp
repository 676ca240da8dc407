#include "sightline/pipeline/feed_config.h"

namespace sightline::pipeline {

void Frames::visit(config::FieldVisitor& visitor) {
  visitor.text("map", map, "frame of the rooms");
  visitor.text("odom", odom, "frame of the odometry, in which the world stands still");
  visitor.text("base", base, "frame of the robot");
}

Frames Frames::withoutSlashes() const {
  const auto strip = [](const std::string& name) {
    return name.rfind('/', 0) == 0 ? name.substr(1) : name;
  };
  return {strip(map), strip(odom), strip(base)};
}

void FeedConfig::visit(config::FieldVisitor& visitor) {
  visitor.group("noise", noise);
  visitor.choice("odometry_source", odometry_source, {"automatic", "transforms", "topic", "none"},
                 "where the odometry of the wheels comes from; automatic: transforms where they "
                 "know it, otherwise the topic odom");
  visitor.group("odometry_limits", odometry_limits);
  visitor.flag("use_imu", use_imu,
               "take the topic imu, where it comes: its turn rate, and its attitude for a scanner "
               "that leans");
  visitor.group("sweep_noise", sweep_noise);
  visitor.entries("body", body,
                  "directions in which the scanner of this frame sees the robot itself: pairs of "
                  "angles in the frame of the base, from one counter-clockwise to the other");
  visitor.number("head_sigma", head_sigma,
                 {"rad",
                  {0.0, 0.1},
                  "standard deviation of each reported angle of a turning head (pears eq. 23)"});
  visitor.number("time_offset", time_offset,
                 {"s",
                  {-10.0, 10.0},
                  "added to the stamps of scans, for a driver that does not stamp the first beam: "
                  "minus the duration of the sweep for stamps at its end"});
  visitor.flag("correct_timing", correct_timing,
               "learn from the odometry's turns when the beams are measured, and make good what is "
               "certainly wrong of stamps and sweeps");
  visitor.number("patience", patience,
                 {"s",
                  {0.0, 60.0},
                  "how long a scan waits for transforms, odometry or an inertial sensor that have "
                  "been coming"});
  visitor.number("start_patience", start_patience,
                 {"s", {0.0, 60.0}, "how long the first scans wait for what has not come yet"});
}

}  // namespace sightline::pipeline
