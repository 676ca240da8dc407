#include "sightline/triangulation/scan_pattern.h"

#include <cmath>

namespace sightline::triangulation {

void ScanPattern::visit(config::FieldVisitor& visitor) {
  visitor.integer("beams", beams, {"1", {2, 10000}, "samples of a scan (pears table 1)"});
  visitor.number("field_of_view", field_of_view,
                 {"rad", {0.01, geometry::radians(120.0)}, "from the first beam to the last"});
  visitor.number("sample_rate", sample_rate, {"Hz", {1.0, 1e6}, "of the measurements in a scan"});
  visitor.number("range_min", range_min, {"m", {1e-3, 100.0}, "nearest range along a beam"});
  visitor.number("range_max", range_max, {"m", {1e-3, 1000.0}, "farthest range along a beam"});
  visitor.number("min_current", min_current,
                 {"A", {1e-15, 1.0}, "with less light there is no measurement"});
  visitor.number("bandwidth", bandwidth,
                 {"Hz",
                  {0.0, 1e7},
                  "of the one pole of the detector (pears table 1: 1 kHz); what samples share is "
                  "taken out; 0: none"});
}

void ScanPattern::check(const std::string& source) const {
  config::validate(*this, source);
  if (range_min >= range_max) {
    throw config::Error(source, 0, "range_min", "is not below range_max");
  }
}

double ScanPattern::scanAngle(double beam) const {
  return field_of_view * (beam / (beams - 1) - 0.5);
}

double ScanPattern::memory() const {
  return bandwidth > 0.0 ? std::exp(-2.0 * geometry::kPi * bandwidth / sample_rate) : 0.0;
}

std::shared_ptr<const scan::ScanGeometry> ScanPattern::geometry(double projected_vergence) const {
  return scan::ScanGeometry::uniform(scanAngle(0) + projected_vergence, scanAngle(1) - scanAngle(0),
                                     static_cast<std::size_t>(beams), 1.0 / sample_rate, range_min,
                                     range_max);
}

}  // namespace sightline::triangulation
