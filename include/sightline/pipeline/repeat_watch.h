#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "sightline/geometry/pose2.h"
#include "sightline/scan/learned_noise.h"
#include "sightline/scan/scan.h"

namespace sightline::pipeline {

/// Finds scans of one scanner that are the one before it again, under a new stamp: a driver whose
/// device has gone silent. The same ranges alone are no proof, as a scanner without noise that
/// stands still gives them: they are one where the scanner's noise shows in its ranges, or where
/// the odometry says that it moved meanwhile.
class RepeatWatch {
 public:
  /// Takes the next scan; whether it repeats the one before.
  /// @param noise        of the scanner, null where nobody has learned it
  /// @param T_odom_base  by the odometry, where that is known
  bool isRepeat(const scan::Scan& scan, const scan::RangeNoise* noise,
                const std::optional<geometry::Pose2>& T_odom_base);

 private:
  bool isSame(const scan::Scan& scan) const;
  void comeAnew(std::int64_t stamp, const std::optional<geometry::Pose2>& T_odom_base);

  std::vector<double> ranges_;
  std::int64_t since_ = 0;                      // stamp of these ranges, or of a look at them since
  std::optional<geometry::Pose2> T_odom_base_;  // at that time
};

}  // namespace sightline::pipeline
