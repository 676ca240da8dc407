#pragma once

#include <cstddef>
#include <memory>
#include <stdexcept>
#include <vector>

namespace sightline::scan {

/// A scan, or the description of one, that cannot be used. what() names the fault.
class InvalidScan : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Properties that all scans of a sensor share: directions and times of its beams, and its range.
/// Immutable, shared between scans, so that the trigonometry is done once.
///
/// Angles in radians from the sensor's x axis, counter-clockwise, strictly monotonic in either
/// sense, at most one turn apart from first to last; time offsets in seconds after the stamp of
/// the scan; range limits in metres with 0 ≤ range_min < range_max (range_max may be infinite).
class ScanGeometry {
 public:
  /// Throws InvalidScan.
  ScanGeometry(std::vector<double> angles, std::vector<double> time_offsets, double range_min,
               double range_max);

  /// The usual planar scanner. Throws InvalidScan, also on no beams and on an increment of zero or
  /// NaN (one beam may have any increment).
  static std::shared_ptr<const ScanGeometry> uniform(double angle_min, double angle_increment,
                                                     std::size_t beams, double time_increment,
                                                     double range_min, double range_max);

  /// The same sensor with another time from beam to beam; the trigonometry is not done again.
  std::shared_ptr<const ScanGeometry> withTimeIncrement(double time_increment) const;
  /// Geometry of the same sensor upside down: every angle negated.
  std::shared_ptr<const ScanGeometry> mirrored() const;

  std::size_t beams() const { return angles().size(); }
  const std::vector<double>& angles() const { return directions_->angles; }
  const std::vector<double>& cosines() const { return directions_->cosines; }
  const std::vector<double>& sines() const { return directions_->sines; }
  /// Whether one was made of the other, and the directions of the beams are the same.
  bool sharesDirections(const ScanGeometry& other) const {
    return directions_ == other.directions_;
  }
  const std::vector<double>& timeOffsets() const { return time_offsets_; }
  double rangeMin() const { return range_min_; }
  double rangeMax() const { return range_max_; }
  /// Mean angle from one beam to the next; negative for a sensor that scans clockwise; 0 for a
  /// single beam.
  double angleIncrement() const { return directions_->increment; }
  /// Whether the last beam is the first one's neighbour, so that a wall may cross the seam.
  bool isFullCircle() const;

 private:
  struct Directions {
    explicit Directions(std::vector<double> of);
    std::vector<double> angles, cosines, sines;
    double increment;
  };

  std::shared_ptr<const Directions> directions_;
  std::vector<double> time_offsets_;
  double range_min_;
  double range_max_;
};

}  // namespace sightline::scan
