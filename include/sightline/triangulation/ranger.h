#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "sightline/motion/range_scan.h"
#include "sightline/scan/scan.h"
#include "sightline/triangulation/calibration.h"
#include "sightline/triangulation/photocurrents.h"

namespace sightline::triangulation {

/// Readings of one scan of a sensor, one entry a beam.
struct RawScan {
  std::int64_t stamp = 0;  ///< of the first sample, nanoseconds
  std::vector<Photocurrents> currents;
  std::vector<double> head_angles;  ///< of the head's joint [rad]
};

/// One measurement.
struct RangeReading {
  scan::ReturnKind kind = scan::ReturnKind::kInvalid;
  double range = 0.0;     ///< along the beam [m]; meaningless where there was too little light
  double variance = 0.0;  ///< along the beam [m²], eq. 2 times the squared gain of the table
  double depth = 0.0;     ///< in the projection frame, straight ahead [m]
};

/// Photocurrents into ranges, by calibration.
class Ranger {
 public:
  explicit Ranger(Calibration calibration);

  /// Reads one beam. Too little light is invalid (NaN, REP-117); a surface nearer or farther than
  /// the range limits, or than the table knows, is too near (−Inf) or nothing (+Inf).
  RangeReading read(std::size_t beam, const Photocurrents& currents) const;

  /// Reads a whole scan. The variance of a reading is taken at its neighbours' median image
  /// position where that is of the same surface: taken at its own, a range that errs to the far
  /// side would be believed less than one that errs to the near side, and lines would lie too near.
  /// A detector with a bandwidth, one pole, mixes each sample with those before it: light that is
  /// late bends what is seen, and noise is shared. Both are undone exactly, for the price of
  /// (1 + a)/(1 − a) times the variance, where a is what a sample keeps of the one before; of the
  /// first sample that is not known, and it is no range.
  /// Throws scan::InvalidScan where the number of currents or of head angles is not that of the
  /// beams, or a head angle is not finite.
  motion::RangeScan range(const RawScan& raw) const;

  const Calibration& calibration() const { return calibration_; }
  const std::shared_ptr<const scan::ScanGeometry>& geometry() const { return geometry_; }

 private:
  // Currents as they were ahead of the detector's pole; the first, whose past is not known, NaN.
  std::vector<Photocurrents> withoutLag(const std::vector<Photocurrents>& measured) const;
  // NaN where there is too little light.
  double litPosition(const Photocurrents& currents) const;
  double sigma(double current) const;  // of the image position, without lag [m]
  // The gain that scales the variance is that at another image position.
  RangeReading readAt(std::size_t beam, double current, double p, double p_of_gain) const;
  void check(const RawScan& raw) const;

  Calibration calibration_;
  std::shared_ptr<const scan::ScanGeometry> geometry_;
};

}  // namespace sightline::triangulation
