#pragma once

#include <optional>

#include "sightline/tracking/explanation.h"
#include "sightline/tracking/pose_filter.h"
#include "sightline/tracking/tracking_context.h"
#include "sightline/tracking/wall_finder.h"

namespace sightline::tracking {

/// One hypothesis of where the robot is, by the method full: filter, room and what it remembers of
/// the scans before. A value: copies are independent, so that rivals are a vector of these. What
/// all rivals share is handed in as context.
class PoseTrack {
 public:
  PoseTrack(const TrackingContext& context, const geometry::UncertainPose2& start,
            std::size_t room);

  /// Moves with the odometry to the stamp of a scan.
  void predict(const TrackingContext& context, const TrackerInput& input);
  /// The scan as predicted; where that does not agree, the best of that, of the motion before
  /// having gone on whatever the wheels say, of a slip of the wheels, of walls close to where they
  /// are expected alone, and of no wall at all being what it was taken for. Wheels that stop from
  /// one scan to the next where the walls move on are not believed for a while: until scans speak
  /// for them, or they report the motion again.
  Explanation explain(const TrackingContext& context, const TrackerInput& input) const;
  /// Takes an explanation for the truth, and goes into the next room where it leads there.
  TrackerUpdate commit(const TrackingContext& context, const TrackerInput& input,
                       Explanation explanation);

  /// The three in turn. Nothing for a scan older than the last one used.
  std::optional<TrackerUpdate> update(const TrackingContext& context, const TrackerInput& input);
  /// Adds an independent error of these standard deviations [m, rad].
  void inflate(double position_sigma, double heading_sigma);
  geometry::UncertainPose2 pose() const { return filter_.pose(); }
  std::size_t room() const { return memory_.room(); }
  /// Share of the beams that have met walls lately: how much stands in the rooms.
  double usualHits() const { return usual_hits_; }
  void setUsualHits(double share) { usual_hits_ = share; }
  TrackMemory& memory() { return memory_; }

 private:
  // Walls are looked for as far as one filter leaves open, and correct the other. Where several
  // lines may be a wall by what is predicted, the choice that explains the scan best; a motion that
  // nobody predicted is as good as its heaviest lines.
  Explanation explainFrom(const PoseFilter& prior, const PoseFilter& looked_from,
                          WallFinder::Lines lines, const TrackingContext& context,
                          const TrackerInput& input, const Sweep& sweep) const;
  Explanation explainBy(std::vector<WallFit> fits, const PoseFilter& prior,
                        const TrackingContext& context, const TrackerInput& input,
                        const Sweep& sweep) const;
  bool goesOn() const;
  bool haveStopped() const;
  bool isContradicted(const TrackingContext& context, const TrackerInput& input,
                      const Explanation& explanation) const;
  bool isMotionDoubted(const Explanation& explanation) const;
  static Explanation slippedOr(Explanation best, Explanation slipped, double log_prior,
                               const TrackerInput& input);
  void learnMotion(const TrackerInput& input, const Explanation& explanation);
  Explanation withoutWalls(const Explanation& taken, const TrackingContext& context,
                           const TrackerInput& input) const;
  void learnHits(const ScanAgreement& agreement);
  void judge(const TrackingContext& context, const TrackerInput& input,
             Explanation& explanation) const;

  PoseFilter filter_;
  std::optional<PoseFilter> coasting_;          // as if the motion before had gone on
  std::optional<geometry::Pose2> before_;       // pose after the last scan
  std::optional<geometry::Pose2> last_motion_;  // by wheels or walls, between the last scans
  std::optional<geometry::Pose2> step_;         // by the wheels, to the scan in hand
  std::optional<std::int64_t> distrusted_at_;   // stamp since which wheels are not believed
  TrackMemory memory_;
  double usual_hits_ = kUsualHits;
};

}  // namespace sightline::tracking
