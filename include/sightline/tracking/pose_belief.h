#pragma once

#include <optional>

#include "sightline/geometry/pose2.h"
#include "sightline/scan/scan_geometry.h"
#include "sightline/tracking/tracker_update.h"

namespace sightline::tracking {

/// Probability that the robot is where a hypothesis says it is, from what the beams say view after
/// view, whatever other hypotheses there are. Scans of one view, within 0.3 m and 20°, tell the
/// same and count as one, the last of them. A scan without evidence, as in a doorway, leaves it as
/// it was; one that suddenly meets far fewer walls than those before speaks against it.
class PoseBelief {
 public:
  explicit PoseBelief(double log_odds) : before_(log_odds) {}

  /// Takes what a scan has left the hypothesis with.
  void take(const TrackerUpdate& update, const scan::ScanGeometry& geometry,
            const geometry::Pose2& T_odom_base);

  double probability() const;
  /// Whether the last scan spoke against the pose.
  bool isContradicted() const { return last_ < 0.0; }
  /// Whether far fewer beams meet walls than before: who looks elsewhere may find more.
  bool isSurprised() const { return is_surprised_ && !is_dismissed_; }
  /// Takes back what a surprise has said, as the rest of the map explains the scan no better:
  /// people or clutter have come before the walls. It holds for the view, while no beams go through
  /// walls.
  /// @param update  what `take` has got last
  void dismissSurprise(const TrackerUpdate& update, const scan::ScanGeometry& geometry);

 private:
  bool isSurprising(const ScanAgreement& agreement, const scan::ScanGeometry& geometry);

  double before_;      // log odds by the views before this one
  double last_ = 0.0;  // by the last scan
  std::optional<geometry::Pose2> view_;
  std::optional<double> usual_hits_;  // share of the beams that meet walls
  bool is_surprised_ = false;         // by the last scan
  bool was_surprised_ = false;        // by the last scan of the view before, and not dismissed
  bool has_jumped_ = false;           // within this view
  bool is_dismissed_ = false;         // what surprises in this view
};

/// Whether 4 % or more of the beams that say something go through walls.
bool goesThroughWalls(const ScanAgreement& agreement);

/// A scan that a pose may be claimed by: less than 4 % of the beams go through walls, and at least
/// 30 % of those that say something meet them.
bool isSound(const ScanAgreement& agreement);

/// Whether walls are where the prediction alone expects them, within 0.15 m, as far as they are
/// seen: two independent beams or more are on them, and less than 4 % of the beams go through
/// walls.
bool isAsPredicted(const TrackerUpdate& update, const scan::ScanGeometry& geometry);

}  // namespace sightline::tracking
