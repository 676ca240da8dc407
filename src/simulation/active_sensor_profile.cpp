#include "sightline/simulation/active_sensor_profile.h"

namespace sightline::simulation {

void ActiveSensorProfile::visit(config::FieldVisitor& visitor) {
  sensor.visit(visitor);
  visitor.group("head", head);
  visitor.group("optics", optics);
  visitor.number("bandwidth", bandwidth,
                 {"Hz", config::kNotNegative,
                  "of the detector (pears table 1: 1 kHz), which makes neighbours share some of "
                  "their light and noise; 0: none, as in pears eq. 2"});
  visitor.group("rig", rig);
  visitor.text("calibration", calibration,
               "path of a calibration file, relative to this one; empty: the table that a sensor "
               "with these parameters fills");
}

ActiveSensorProfile ActiveSensorProfile::readFile(const std::string& path) {
  const config::Node document = config::Node::readFile(path);
  ActiveSensorProfile profile;
  config::read(document, profile);
  profile.check(path);
  if (!profile.calibration.empty()) profile.calibration = document.at("calibration").path();
  return profile;
}

void ActiveSensorProfile::check(const std::string& source) const {
  config::validate(*this, source);
  sensor.check(source);
  head.check(source);
  rig.check(source);
}

triangulation::Calibration ActiveSensorProfile::calibrated() const {
  if (calibration.empty()) {
    const auto depths =
        triangulation::tableDepths(rig.nearest, rig.farthest, static_cast<std::size_t>(rig.depths));
    return {sensor, triangulation::modelledTable(sensor, depths)};
  }
  auto result = triangulation::Calibration::readFile(calibration);
  result.requireSensor(sensor.serial, calibration);
  return result;
}

}  // namespace sightline::simulation
