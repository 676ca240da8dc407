#pragma once

#include <string>

#include "sightline/bridge/active_sensor_topics.h"
#include "sightline/config/fields.h"
#include "sightline/driver/device_session.h"

namespace sightline::nodes {

/// Parameters of the node sync_scan_driver.
struct SyncScanDriverConfig {
  driver::SessionConfig session;
  std::string calibration;  ///< path
  std::string profile;      ///< path
  std::string urdf;         ///< path
  bool publish_tf = true;
  bridge::ActiveSensorNames names;

  void visit(config::FieldVisitor& visitor) {
    session.visit(visitor);
    visitor.path("calibration", calibration,
                 "path of the device's calibration file; empty: the profile's");
    visitor.path("profile", profile,
                 "path of the sensor's profile; empty: as config/sensors/synchronised_scan.yaml");
    visitor.path("urdf", urdf,
                 "path of the robot description; empty: the parameter robot_description");
    visitor.flag("publish_tf", publish_tf,
                 "broadcast mount_frame to head_frame, at every sample that tells how the head "
                 "turned, and that to frame; off where robot_state_publisher hears joint_states");
    names.visit(visitor);
  }
};

}  // namespace sightline::nodes
