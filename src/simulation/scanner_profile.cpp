#include "sightline/simulation/scanner_profile.h"

#include <cmath>

#include <fmt/format.h>

namespace sightline::simulation {

void ScannerProfile::visit(config::FieldVisitor& visitor) {
  const config::Range angle{-2.0 * geometry::kPi, 2.0 * geometry::kPi};
  visitor.integer("beams", beams, {"1", {1, 100000}, "beams of a sweep"});
  visitor.number("angle_min", angle_min, {"rad", angle, "direction of the first beam"});
  visitor.number("angle_max", angle_max, {"rad", angle, "direction of the last beam"});
  visitor.number("range_min", range_min, {"m", {0.0, 100.0}, "nearest range"});
  visitor.number("range_max", range_max, {"m", {1e-3, 1000.0}, "farthest range"});
  visitor.number("rate", rate, {"Hz", {0.1, 1000.0}, "sweeps a second"});
  visitor.number("revolution", revolution,
                 {"s", {0.0, 100.0}, "time of a turn of the mirror; 0: all at once"});
  visitor.number("resolution", resolution,
                 {"m", {0.0, 1.0}, "step of the reported range; 0: as computed"});
  visitor.number("dropout", dropout, {"1", {0.0, 1.0}, "share of the beams without an answer"});
  visitor.number("intensity", intensity,
                 {"sensor's own",
                  {0.0, 1e6},
                  "of a white surface nearby that faces the sensor; 0: none reported"});
  visitor.number("intensity_half_range", intensity_half_range,
                 {"m", {1e-3, 1e4}, "where half of that intensity comes back"});
  visitor.group("noise", noise);
}

ScannerProfile ScannerProfile::readFile(const std::string& path) {
  ScannerProfile profile;
  config::read(config::Node::readFile(path), profile);
  profile.check(path);
  return profile;
}

void ScannerProfile::check(const std::string& source) const {
  config::validate(*this, source);
  const auto fail = [&](const char* key, const std::string& reason) {
    throw config::Error(source, 0, key, reason);
  };
  if (range_min >= range_max) fail("range_min", "is not below range_max");
  if (std::abs(angle_max - angle_min) > 2.0 * geometry::kPi) {
    fail("angle_max", "more than a turn from angle_min");
  }
  if (beams > 1 && angle_min == angle_max) fail("angle_max", "is the same as angle_min");
  if (sweepDuration() > 1.0 / rate) {
    fail("revolution", fmt::format("a sweep of {:.4f} s does not end before the next one, at {} Hz",
                                   sweepDuration(), rate));
  }
}

std::shared_ptr<const scan::ScanGeometry> ScannerProfile::geometry() const {
  const auto intervals = static_cast<double>(std::max(1, beams - 1));
  return scan::ScanGeometry::uniform(angle_min, (angle_max - angle_min) / intervals,
                                     static_cast<std::size_t>(beams), sweepDuration() / intervals,
                                     range_min, range_max);
}

double ScannerProfile::sweepDuration() const {
  return revolution * std::abs(angle_max - angle_min) / (2.0 * geometry::kPi);
}

}  // namespace sightline::simulation
