#include "sightline/simulation/active_sensor_profile.h"

namespace sightline::simulation {

void ActiveSensorProfile::takeHead(const driver::HeadJoint& joint, const std::string& source) {
  joint.requireScanOrigin(sensor.origin.position(), source);
  head.lower = joint.limits.lower;
  head.upper = joint.limits.upper;
  head.max_rate = joint.limits.max_rate;
}

void ActiveSensorProfile::visit(config::FieldVisitor& visitor) {
  SensorProfile::visit(visitor);
  visitor.group("optics", optics);
  visitor.number("bandwidth", bandwidth,
                 {"Hz",
                  {0.0, 1e7},
                  "of the detector (pears table 1: 1 kHz), which makes neighbours share some of "
                  "their light and noise; 0: none, as in pears eq. 2"});
  visitor.number(
      "jitter", jitter,
      {"rad",
       {0.0, 0.1},
       "standard deviation of the true head angle about the reported one, drawn for each "
       "sample (pears eq. 23)"});
  visitor.group("rig", rig);
}

ActiveSensorProfile ActiveSensorProfile::readFile(const std::string& path) {
  const config::Node document = config::Node::readFile(path);
  ActiveSensorProfile profile;
  config::read(document, profile);
  profile.check(path);
  profile.resolveCalibration(document);
  return profile;
}

void ActiveSensorProfile::check(const std::string& source) const {
  config::validate(*this, source);
  SensorProfile::check(source);
  rig.check(source);
  if (rig.nearest <= sensor.origin.x) {
    throw config::Error(source, 0, "rig.nearest", "is not ahead of the scan's origin");
  }
}

}  // namespace sightline::simulation
