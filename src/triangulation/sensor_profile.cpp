#include "sightline/triangulation/sensor_profile.h"

#include <fmt/format.h>

namespace sightline::triangulation {

namespace {

// Refuses a calibration that differs in what no calibration estimates.
void requireSameScan(const SensorParameters& calibrated, const SensorParameters& sensor,
                     const std::string& source) {
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

// Refuses keys that the group does not know, although the document around it may hold others.
template <class Group>
void readStrictly(const config::Node& document, const char* key, Group& group) {
  if (document.has(key)) config::read(document.at(key), group);
}

}  // namespace

void ModelledDepths::visit(config::FieldVisitor& visitor) {
  visitor.number("nearest", nearest, {"m", {1e-3, 1e3}, "depth of the nearest target"});
  visitor.number("farthest", farthest, {"m", {1e-3, 1e3}, "depth of the farthest target"});
  visitor.integer("count", count, {"1", {2, 1000}, "number of targets, uniform in 1/depth"});
}

void SensorProfile::visit(config::FieldVisitor& visitor) {
  sensor.visit(visitor);
  visitor.group("head", head);
  visitor.text("calibration", calibration,
               "path of a calibration file, relative to this one; empty: the table that a sensor "
               "with these parameters fills");
  visitor.group("modelled_depths", modelled_depths);
}

SensorProfile SensorProfile::readFile(const std::string& path) {
  const config::Node document = config::Node::readFile(path);
  SensorProfile profile;
  config::read(document, profile, config::UnknownKeys::kIgnore);
  readStrictly(document, "scan", profile.sensor.scan);
  readStrictly(document, "intrinsics", profile.sensor.intrinsics);
  readStrictly(document, "origin", profile.sensor.origin);
  readStrictly(document, "head", profile.head);
  readStrictly(document, "modelled_depths", profile.modelled_depths);
  profile.check(path);
  profile.resolveCalibration(document);
  return profile;
}

void SensorProfile::check(const std::string& source) const {
  config::validate(*this, source);
  sensor.check(source);
  head.check(source);
  const auto fail = [&](const char* key, const char* reason) {
    throw config::Error(source, 0, key, reason);
  };
  if (modelled_depths.nearest <= sensor.origin.x) {
    fail("modelled_depths.nearest", "is not ahead of the scan's origin");
  }
  if (modelled_depths.nearest >= modelled_depths.farthest) {
    fail("modelled_depths.nearest", "is not below farthest");
  }
}

void SensorProfile::resolveCalibration(const config::Node& document) {
  if (!calibration.empty()) calibration = document.at("calibration").path();
}

Calibration SensorProfile::calibrated() const {
  if (calibration.empty()) {
    const auto depths = tableDepths(modelled_depths.nearest, modelled_depths.farthest,
                                    static_cast<std::size_t>(modelled_depths.count));
    return {sensor, modelledTable(sensor, depths)};
  }
  auto result = Calibration::readFile(calibration);
  result.requireSensor(sensor.serial, calibration);
  requireSameScan(result.parameters, sensor, calibration);
  return result;
}

}  // namespace sightline::triangulation
