#include "sightline/simulation/active_sensor_profile.h"

#include <fmt/format.h>

namespace sightline::simulation {

namespace {

// What the calibration cannot differ in from the sensor that it is of.
void requireSameScan(const triangulation::SensorParameters& calibrated,
                     const triangulation::SensorParameters& sensor, const std::string& source) {
  const auto require = [&](const char* key, double of_calibration, double of_sensor) {
    if (of_calibration == of_sensor) return;
    throw config::Error(source, 0, key,
                        fmt::format("is {}, that of the sensor {}", of_calibration, of_sensor));
  };
  require("scan.beams", calibrated.scan.beams, sensor.scan.beams);
  require("scan.field_of_view", calibrated.scan.field_of_view, sensor.scan.field_of_view);
  require("scan.sample_rate", calibrated.scan.sample_rate, sensor.scan.sample_rate);
  require("intrinsics.detector_length", calibrated.intrinsics.detector_length,
          sensor.intrinsics.detector_length);
}

}  // namespace

void ActiveSensorProfile::takeHead(const driver::HeadJoint& joint, const std::string& source) {
  joint.requireScanOrigin(sensor.origin.position(), source);
  head.lower = joint.limits.lower;
  head.upper = joint.limits.upper;
  head.max_rate = joint.limits.max_rate;
}

void ActiveSensorProfile::visit(config::FieldVisitor& visitor) {
  sensor.visit(visitor);
  visitor.group("head", head);
  visitor.group("optics", optics);
  visitor.number("bandwidth", bandwidth,
                 {"Hz",
                  {0.0, 1e7},
                  "of the detector (pears table 1: 1 kHz), which makes neighbours share some of "
                  "their light and noise; 0: none, as in pears eq. 2"});
  visitor.group("rig", rig);
  visitor.path("calibration", calibration,
               "path of a calibration file, relative to this one; empty: the table that a sensor "
               "with these parameters fills");
}

ActiveSensorProfile ActiveSensorProfile::readFile(const std::string& path) {
  const config::Node document = config::Node::readFile(path);
  ActiveSensorProfile profile;
  config::read(document, profile);
  profile.check(path);
  return profile;
}

void ActiveSensorProfile::check(const std::string& source) const {
  config::validate(*this, source);
  sensor.check(source);
  head.check(source);
  rig.check(source);
  if (rig.nearest <= sensor.origin.x) {
    throw config::Error(source, 0, "rig.nearest", "is not ahead of the scan's origin");
  }
}

triangulation::Calibration ActiveSensorProfile::calibrated() const {
  if (calibration.empty()) {
    const auto depths =
        triangulation::tableDepths(rig.nearest, rig.farthest, static_cast<std::size_t>(rig.depths));
    return {sensor, triangulation::modelledTable(sensor, depths)};
  }
  auto result = triangulation::Calibration::readFile(calibration);
  result.requireSensor(sensor.serial, calibration);
  requireSameScan(result.parameters, sensor, calibration);
  return result;
}

}  // namespace sightline::simulation
