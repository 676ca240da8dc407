#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "sightline/tracking/key_scans.h"
#include "sightline/tracking/pose_belief.h"
#include "sightline/tracking/pose_track.h"

namespace sightline::tracking {

/// Several explanations of where the robot is, of which the most probable one is published. Each is
/// a PoseTrack with the log-posterior of what the key scans say of it. As long as one explains
/// what is seen, there is no other; where scans speak against it, and until a pose that nobody gave
/// is certain, the whole map is searched again and again (relocalise).
///
/// A pose that was found by search is claimed only with posterior odds of 10⁴, by a sound scan, and
/// after the robot has turned by 180° or driven 2 m: what the map lacks is no noise, so that no
/// ratio of evidence is safe by itself. Until the first claim there are no updates; after a jump
/// they are flagged.
class RivalTracks {
 public:
  /// Anywhere in the map.
  RivalTracks() = default;
  /// Near a pose: tracked from there at once, but for one so vague that it has to be searched for.
  RivalTracks(const TrackingContext& context, const geometry::UncertainPose2& start,
              std::size_t room);

  /// Takes one scan. Nothing for a scan older than the last one used, or before the first claim.
  std::optional<TrackerUpdate> update(const TrackingContext& context, const TrackerInput& input);
  void inflate(double position_sigma, double heading_sigma);
  void setRoom(std::size_t room);
  void restartClock();

  /// Whether a pose has been given or claimed.
  bool isStarted() const { return is_started_; }
  /// The published pose, and its room; nothing where there is none.
  std::optional<geometry::UncertainPose2> pose() const;
  std::optional<std::size_t> room() const;
  /// All that is held possible, most probable first.
  std::vector<RivalPose> rivals() const;

 private:
  struct Hypothesis {
    PoseTrack track;
    PoseBelief belief;
    double log_posterior = 0.0;  // up to a constant that all share
    double last_key = 0.0;       // the part of the last key scan in it
    TrackerUpdate update;        // by the last scan
    bool is_published = false;
    bool is_trusted = false;  // as near to the given start as it was said to be, or claimed since
  };

  void move(const TrackingContext& context, const TrackerInput& input);
  void look(const TrackingContext& context, const TrackerInput& input);
  void weigh(const TrackerInput& input, bool is_new_key);
  void search(const TrackingContext& context, const TrackerInput& input);
  bool isTrusted(const geometry::Pose2& T_map_base) const;
  double mahalanobis(const geometry::Pose2& T_map_base) const;
  double logPriorOf(const TrackingContext& context, const geometry::Pose2& T_map_base) const;
  void thinOut();
  void settle();
  void claimIfCertain();
  bool isInDoubt() const;
  double probabilityOf(const Hypothesis& hypothesis) const;
  TrackerState stateOf(const TrackingContext& context, double quality) const;
  TrackerUpdate report(const TrackingContext& context);

  std::vector<Hypothesis> hypotheses_;             // most probable first
  std::optional<geometry::UncertainPose2> start_;  // as given; until a pose is claimed
  // Share of beams on walls by which all are compared: that of the published one, when there was
  // no doubt last.
  double usual_hits_ = kUsualHits;
  KeyScans keys_;
  WayTravelled way_;  // since the published pose was last put in question
  std::optional<std::int64_t> newest_;
  bool is_started_ = false;
  bool is_claimed_ = false;
  bool is_checked_ = false;  // whether the start has been compared with the rest of the map
  int scans_since_search_ = 0;
  int search_again_ = 1;  // scans after the last search, from the same place
  int lost_scans_ = 0;    // in a row
};

}  // namespace sightline::tracking
