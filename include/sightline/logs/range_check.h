#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

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
  std::size_t beams = 0;  ///< of a scan; of the first where they differ
  double valid = 0.0;     ///< within the limits
  double nothing = 0.0;   ///< +Inf, or beyond range_max
  double too_near = 0.0;  ///< −Inf, or positive below range_min
  double zero = 0.0;      ///< 0 or negative
  double not_a_number = 0.0;
  /// Largest range that is reported, and the share that has it: where that is more than a surface
  /// could bring, beams without a return are reported so.
  double largest = 0.0;
  double at_largest = 0.0;
  bool misses_as_ranges = false;
  double resolution = 0.0;  ///< step of which all ranges are multiples [m]; 0: none of 1 mm or more
  double moving = 0.0;  ///< standard deviation of the median beam [m]: whether the scene changes
  /// Beams that say the same in every scan although the scene changes, within a metre: the robot's
  /// own body.
  std::vector<BeamSector> constant;
};

/// Gathers the ranges of a scanner.
class RangeCheck {
 public:
  /// One scan, ranges [m] with the limits of its message.
  void add(const std::vector<float>& ranges, double range_min, double range_max);
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
  void addReading(float range, double range_min, double range_max, std::size_t beam);
  void findMisses(RangeSummary& summary) const;
  void findConstantBeams(RangeSummary& summary) const;
  bool isConstant(const Beam& beam) const;
  double resolution() const;

  std::size_t scans_ = 0;
  std::size_t readings_ = 0;
  std::size_t valid_ = 0, nothing_ = 0, too_near_ = 0, zero_ = 0, not_a_number_ = 0;
  std::vector<Beam> beams_;
  std::map<std::int64_t, std::size_t> histogram_;
  std::vector<float> sample_;  // of valid ranges, for their resolution
};

}  // namespace sightline::logs
