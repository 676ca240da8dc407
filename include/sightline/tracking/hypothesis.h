#pragma once

#include <vector>

#include "sightline/tracking/key_scans.h"
#include "sightline/tracking/pose_belief.h"
#include "sightline/tracking/pose_track.h"

/// Hypotheses of where the robot is, and how they compare.
namespace sightline::tracking {

/// Probability by itself of a pose that counts as right.
constexpr double kSure = 0.9;
/// One that is not to be believed.
constexpr double kHopeless = 0.1;

struct Hypothesis {
  PoseTrack track;
  PoseBelief belief;
  WayTravelled way;            ///< since it turned up
  double log_posterior = 0.0;  ///< up to a constant that all share
  double last_key = 0.0;       ///< the part of the last key scan in it
  TrackerUpdate update;        ///< by the last scan that it took
  bool is_published = false;
  bool is_trusted = false;  ///< as near to the given start as it was said to be, or claimed since
};

/// Posterior of one hypothesis among all.
double probabilityOf(const std::vector<Hypothesis>& all, const Hypothesis& hypothesis);

/// Whether a hypothesis of the list has posterior odds of 10⁴ against all others, is sure by
/// itself, and was last seen to explain a sound scan.
bool isCertain(const std::vector<Hypothesis>& all, const Hypothesis& hypothesis);

/// Whether two tracks have become one: within 0.1 m and 0.05 rad.
bool areOne(const geometry::Pose2& a, const geometry::Pose2& b);

/// The most probable first, 40 at most, without those that have become one with a better one or are
/// hopeless. Where the published one is to be kept, it comes first whatever its posterior.
std::vector<Hypothesis> thinnedOut(std::vector<Hypothesis> all, bool keeps_published);

}  // namespace sightline::tracking
