#pragma once

#include <vector>

#include "sightline/dead_reckoning/correlative_search.h"
#include "sightline/dead_reckoning/dead_reckoner_config.h"
#include "sightline/dead_reckoning/evidence.h"
#include "sightline/dead_reckoning/line_matcher.h"
#include "sightline/dead_reckoning/matcher.h"
#include "sightline/dead_reckoning/range_profile.h"
#include "sightline/dead_reckoning/reference.h"
#include "sightline/dead_reckoning/submap.h"

namespace sightline::dead_reckoning {

/// The default method: point-to-line matching from the prediction. Where that is not clearly right,
/// or the window is too wide for it, the window is searched, every pose found is refined, and they
/// are compared by what speaks for and against them.
///
/// A scan that fits nowhere begins a second reference; the first is given up when a few scans in a
/// row fit the second alone. Scans of several scanners, in one base, share the references: what one
/// of them sees is matched with what any has seen.
class SubmapMatcher : public Matcher {
 public:
  explicit SubmapMatcher(const SubmapConfig& config) : config_(config) { SearchRasters::reserve(); }

  bool hasReference() const override { return !trusted_.empty(); }
  MatchOutcome match(const SurfaceScan& surfaces, const geometry::UncertainPose2& prior,
                     const SearchWindow& window) const override;
  double learn(const SurfaceScan& surfaces, const geometry::Pose2& T_odom_base,
               const MatchOutcome& outcome) override;
  void clear() override {
    trusted_ = {};
    fresh_ = {};
  }

 private:
  struct Hypothesis {
    LineMatch match;
    Evidence evidence;
    double cost = 1.0;  // of the evidence and of the surprise
  };
  /// A scan and what is known of its pose.
  struct Task {
    const SurfaceScan& surfaces;
    RangeProfile profile;
    geometry::UncertainPose2 prior;
    SearchWindow window;
  };

  MatchOutcome matchWith(const Reference& reference, const Task& task) const;
  static bool isBeyondDoubt(const Hypothesis& local, const Task& task);
  MatchOutcome matchWidely(const Reference& reference, const Task& task,
                           std::vector<Hypothesis> hypotheses) const;
  static Task widened(const Task& task);
  static bool isExpected(const MatchOutcome& outcome, const Task& task);
  static bool isExplainedBetter(const MatchOutcome& second, const MatchOutcome& first);
  Hypothesis refine(const Submap& submap, const Task& task, const geometry::Pose2& start,
                    double scale) const;
  static void putBestFirst(std::vector<Hypothesis>& hypotheses);
  MatchOutcome conclude(std::vector<Hypothesis>& hypotheses, const Task& task) const;
  bool isClear(const Hypothesis& hypothesis, bool predicted) const;
  static bool isAlone(const std::vector<Hypothesis>& hypotheses);

  SubmapConfig config_;
  Reference trusted_;
  Reference fresh_;
  int fresh_matches_ = 0;
};

}  // namespace sightline::dead_reckoning
