#include "sightline/triangulation/calibration.h"

#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "sightline/triangulation/projection_geometry.h"

namespace sightline::triangulation {

void ScanOrigin::visit(config::FieldVisitor& visitor) {
  const config::Range offset{-1.0, 1.0};
  visitor.number("x", x, {"m", offset, "of the scan's origin, ahead of the axis of the head"});
  visitor.number("y", y, {"m", offset, "to the left of the axis of the head"});
  visitor.number("projected_vergence", projected_vergence,
                 {"rad",
                  {geometry::radians(-45.0), geometry::radians(45.0)},
                  "gamma^p, added to every scan angle, counter-clockwise"});
}

void SensorParameters::visit(config::FieldVisitor& visitor) {
  visitor.text("sensor", serial, "serial number");
  visitor.group("scan", scan);
  visitor.group("intrinsics", intrinsics);
  visitor.group("origin", origin);
  visitor.number("noise_current", noise_current, {"A", {1e-15, 1e-3}, "I_n of pears eq. 2"});
}

void SensorParameters::check(const std::string& source) const {
  config::validate(*this, source);
  scan.check(source);
  const auto fail = [&](const char* key, const std::string& reason) {
    throw config::Error(source, 0, key, reason);
  };
  if (serial.empty()) fail("sensor", "has to name a serial number");
  const double widest = 0.5 * scan.field_of_view + std::abs(origin.projected_vergence);
  if (widest > geometry::radians(80.0)) {
    fail("origin.projected_vergence",
         fmt::format("turns the outermost beam to {:.1f} degrees, 80 are the most",
                     geometry::degrees(widest)));
  }
  if (scan.min_current < 5.0 * noise_current) {
    fail("scan.min_current", "is below five times the noise current");
  }
}

Calibration Calibration::readFile(const std::string& path) {
  return read(config::Node::readFile(path));
}

Calibration Calibration::read(const config::Node& document) {
  document.allowOnly(
      {"sensor", "scan", "intrinsics", "origin", "noise_current", "standard_deviations", "table"});
  for (const char* key : {"sensor", "scan", "intrinsics", "origin", "noise_current"}) {
    document.at(key);  // has to be there: a default would be another sensor's
  }
  SensorParameters parameters;
  config::read(document, parameters, config::UnknownKeys::kIgnore);
  parameters.check(document.source());
  const config::Node table = document.at("table");
  Calibration calibration{parameters, CalibrationTable(table)};
  if (calibration.table.beams() != static_cast<std::size_t>(parameters.scan.beams)) {
    table.fail(fmt::format("is of {} beams, the scan of {}", calibration.table.beams(),
                           parameters.scan.beams));
  }
  return calibration;
}

void Calibration::requireSensor(const std::string& serial, const std::string& source) const {
  if (serial == parameters.serial) return;
  throw config::Error(
      source, 0, "sensor",
      fmt::format("is the calibration of '{}', not of '{}'", parameters.serial, serial));
}

CalibrationTable modelledTable(const SensorParameters& parameters,
                               const std::vector<double>& depths) {
  const ProjectionGeometry geometry(parameters.intrinsics);
  std::vector<std::vector<double>> rows;
  for (int beam = 0; beam < parameters.scan.beams; ++beam) {
    const double angle = parameters.scan.scanAngle(beam) + parameters.origin.projected_vergence;
    rows.emplace_back();
    for (const double depth : depths) {
      const double p =
          geometry.imagePosition((depth - parameters.origin.x) / std::cos(angle), angle);
      const bool is_seen = std::abs(p) <= 0.5 * parameters.intrinsics.detector_length;
      rows.back().push_back(is_seen ? p : std::numeric_limits<double>::quiet_NaN());
    }
  }
  return {depths, std::move(rows), "table of the sensor's parameters"};
}

std::vector<double> tableDepths(double nearest, double farthest, std::size_t count) {
  std::vector<double> depths;
  for (std::size_t i = 0; i < count; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(count - 1);
    depths.push_back(1.0 / ((1.0 - share) / nearest + share / farthest));
  }
  return depths;
}

}  // namespace sightline::triangulation
