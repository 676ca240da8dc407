#pragma once

#include <optional>

#include "sightline/geometry/pose2.h"
#include "sightline/scan/scan_geometry.h"
#include "sightline/tracking/scan_agreement.h"

namespace sightline::tracking {

/// Probability that the robot is where a hypothesis says it is, from what the beams say view after
/// view, whatever other hypotheses there are. Scans of one view, within 0.3 m and 20°, tell the
/// same and count as one, the last of them. A scan without evidence, as in a doorway, leaves it as
/// it was; one that suddenly meets far fewer walls than those before speaks against it.
class PoseBelief {
 public:
  explicit PoseBelief(double log_odds) : before_(log_odds) {}

  /// `is_outside` is whether the hypothesis has left every room.
  void take(const ScanAgreement& agreement, const scan::ScanGeometry& geometry, bool is_outside,
            const geometry::Pose2& T_odom_base);

  double probability() const;
  /// Whether the last scan spoke against the pose.
  bool isContradicted() const { return last_ < 0.0; }

 private:
  bool isSurprising(const ScanAgreement& agreement);

  double before_;      // log odds by the views before this one
  double last_ = 0.0;  // by the last scan
  std::optional<geometry::Pose2> view_;
  std::optional<double> usual_hits_;  // share of the beams that meet walls
};

/// A scan that a pose may be claimed by: less than 4 % of the beams go through walls, and at least
/// 30 % of those that say something meet them.
bool isSound(const ScanAgreement& agreement);

}  // namespace sightline::tracking
