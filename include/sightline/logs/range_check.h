#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "sightline/scan/range_step.h"
#include "sightline/scan/scan.h"

namespace sightline::logs {

/// Neighbouring beams, the first and the last of them.
struct BeamSector {
  std::size_t first = 0;
  std::size_t last = 0;
  double farthest = 0.0;  ///< mean range of the beam that reaches farthest [m]
};

/// What the ranges of a scanner are like. Shares in [0, 1], of all readings.
struct RangeSummary {
  std::size_t scans = 0;
  std::size_t beams = 0;  ///< of a scan, the most
  double valid = 0.0;
  double nothing = 0.0;
  double too_near = 0.0;
  double invalid = 0.0;
  double step = 0.0;    ///< of which all ranges are multiples [m]; 0: none that matters
  double moving = 0.0;  ///< standard deviation of the median beam [m]: whether the scene changes
  /// Beams that say the same in every scan although the scene changes, within a metre: the robot's
  /// own body.
  std::vector<BeamSector> constant;
};

/// Gathers the ranges of a scanner.
class RangeCheck {
 public:
  void add(const scan::Scan& scan);
  RangeSummary summary() const;
  /// Number of readings by range in [mm].
  const std::map<std::int64_t, std::size_t>& histogram() const { return histogram_; }

 private:
  // Running mean and squares (Welford) of what a beam measured.
  struct Beam {
    std::size_t count = 0;
    double mean = 0.0;
    double squares = 0.0;
    void add(double range);
    double sigma() const;
  };
  void findConstantBeams(RangeSummary& summary) const;
  bool isConstant(const Beam& beam) const;
  double shareOf(scan::ReturnKind kind) const;

  std::size_t scans_ = 0;
  std::size_t readings_ = 0;
  std::array<std::size_t, 4> kinds_{};  // readings by ReturnKind
  std::vector<Beam> beams_;
  std::map<std::int64_t, std::size_t> histogram_;
  scan::RangeStep step_;
};

}  // namespace sightline::logs
