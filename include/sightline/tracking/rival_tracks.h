#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "sightline/tracking/hypothesis.h"
#include "sightline/tracking/key_scans.h"

namespace sightline::tracking {

/// Several explanations of where the robot is, of which one is published. Each is a PoseTrack with
/// the log-posterior of what the key scans say of it. As long as one explains what is seen, there
/// is no other; where views speak against it, and until a pose that nobody gave is certain, the
/// whole map is searched again and again (relocalise). The published one takes every scan, the
/// others those by which all are compared: each new view, and of the same view fewer and fewer.
///
/// A pose is certain with posterior odds of 10⁴ and by a sound scan, and is claimed after the robot
/// has turned by 180° or driven 2 m as well: what the map lacks is no noise, so that no ratio of
/// evidence is safe by itself. Until the first claim there are no updates, and the most probable
/// pose is the published one; from then on another one takes its place only where the scan speaks
/// against it and the other is certain: within 0.75 m, now or where nothing was in doubt last, at
/// once, as the robot may have been pushed or turned; elsewhere after the other has explained what
/// was seen for as long as a claim takes. After a jump the updates are flagged.
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
  /// All that is held possible: the published pose, then the most probable.
  std::vector<RivalPose> rivals() const;

 private:
  // Log odds: a pose given by hand is wrong once in a hundred times.
  static constexpr double kWrongStart = -4.6;
  // Where the robot was when nothing was in doubt last.
  struct Undoubted {
    geometry::Pose2 T_map_base;
    geometry::Pose2 T_odom_base;
  };

  void moveAll(const TrackerInput& input);
  void takeByPublished(const TrackingContext& context, const TrackerInput& input,
                       bool is_published);
  bool explainsLess(const TrackerInput& input) const;
  void look(const TrackingContext& context, const TrackerInput& input);
  double likelihoodOf(ScanAgreement agreement, const TrackerInput& input) const;
  void weigh(const TrackerInput& input, bool is_new_key);
  void search(const TrackingContext& context, const TrackerInput& input);
  bool isTrusted(const geometry::Pose2& T_map_base) const;
  double mahalanobis(const geometry::Pose2& T_map_base) const;
  bool isInPushReach(const Hypothesis& from, const geometry::Pose2& T_map_base) const;
  double logPriorOf(const TrackingContext& context, const Hypothesis& rival) const;
  void settle();
  void claimIfCertain();
  void dismissRivals();
  void dismissSurprise(const TrackerInput& input);
  bool isToBeSearched() const;
  bool isSureStart() const;
  bool isInDoubt() const;
  void publish(std::size_t index);
  std::vector<Hypothesis>::iterator mostProbableRival();
  void takeOverIfCertain();
  void giveUpStartIfWrong();
  TrackerState stateOf(const TrackingContext& context, double quality) const;
  TrackerUpdate report(const TrackingContext& context);

  std::vector<Hypothesis> hypotheses_;             // most probable first
  std::optional<geometry::UncertainPose2> start_;  // as given; until a pose is claimed
  // Share of beams on walls by which all are compared: that of the published one, when there was
  // no doubt last.
  double usual_hits_ = kUsualHits;
  KeyScans keys_;
  WayTravelled way_;             // since the published pose was last put in question
  geometry::Pose2 T_odom_base_;  // at the last scan
  std::optional<Undoubted> undoubted_;
  std::optional<std::int64_t> newest_;
  bool is_started_ = false;
  bool is_claimed_ = false;
  bool is_confirmed_ = false;  // whether the published pose has ever been certain: it is kept then
  bool is_checked_ = false;    // whether the start has been compared with the rest of the map
  bool is_compared_ = false;   // whether all hypotheses take this scan
  int scans_since_search_ = 0;
  int search_again_ = 1;  // scans after the last search, from the same place
};

}  // namespace sightline::tracking
