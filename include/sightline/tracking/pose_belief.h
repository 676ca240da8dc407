#pragma once

#include <optional>

#include "sightline/scan/scan_geometry.h"
#include "sightline/tracking/scan_agreement.h"

namespace sightline::tracking {

/// Probability that the robot is where a hypothesis says it is, from what the beams say scan after
/// scan, whatever other hypotheses there are. A scan without evidence, as in a doorway, leaves it
/// as it was; no scan alone decides.
class PoseBelief {
 public:
  explicit PoseBelief(double log_odds) : log_odds_(log_odds) {}

  /// `is_outside` is whether the hypothesis has left every room.
  void take(const ScanAgreement& agreement, const scan::ScanGeometry& geometry, bool is_outside);

  double probability() const;
  /// Whether the last scan spoke against the pose, or met far fewer walls than those before.
  bool isContradicted() const { return last_ < 0.0 || is_surprised_; }

 private:
  void compareHits(const ScanAgreement& agreement);

  double log_odds_;
  double last_ = 0.0;
  std::optional<double> usual_hits_;  // share of the beams that meet walls
  bool is_surprised_ = false;
};

/// A scan that a pose may be claimed by: less than 4 % of the beams go through walls, and at least
/// 30 % of those that say something meet them.
bool isSound(const ScanAgreement& agreement);

}  // namespace sightline::tracking
