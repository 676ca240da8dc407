#pragma once

#include <optional>
#include <vector>

#include "sightline/dead_reckoning/dead_reckoner_config.h"
#include "sightline/dead_reckoning/evidence.h"
#include "sightline/dead_reckoning/line_matcher.h"
#include "sightline/dead_reckoning/matcher.h"
#include "sightline/dead_reckoning/submap.h"

namespace sightline::dead_reckoning {

/// The default method: point-to-line matching from the prediction. Where that is not clearly right,
/// or the window is too wide for it, the window is searched, every pose found is refined, and they
/// are compared by what speaks for and against them.
///
/// A scan that fits nowhere begins a second reference; the first is given up when a few scans in a
/// row fit the second alone.
class SubmapMatcher : public Matcher {
 public:
  explicit SubmapMatcher(const SubmapConfig& config)
      : config_(config), lines_(config.surface_sigma) {}

  std::unique_ptr<Matcher> clone() const override { return std::make_unique<SubmapMatcher>(*this); }
  bool hasReference() const override { return !trusted_.submap.empty(); }
  MatchOutcome match(const Sweep& sweep, const geometry::UncertainPose2& prior,
                     const SearchWindow& window) override;
  double learn(const Sweep& sweep, const geometry::Pose2& T_odom_base, MatchState state) override;
  void clear() override;

 private:
  struct Hypothesis {
    LineMatch match;
    Evidence evidence;
  };
  /// A reference, and where it was last added to.
  struct Reference {
    Submap submap;
    CorrelativeSearch search;
    geometry::Pose2 keyframe;
  };

  MatchOutcome matchWith(Reference& reference, const Sweep& sweep,
                         const geometry::UncertainPose2& prior, const SearchWindow& window);
  std::vector<Hypothesis> search(Reference& reference, const Sweep& sweep,
                                 const RangeProfile& profile, const geometry::UncertainPose2& prior,
                                 const SearchWindow& window);
  Hypothesis refine(const Submap& submap, const Sweep& sweep, const RangeProfile& profile,
                    const geometry::Pose2& start, const geometry::UncertainPose2& prior,
                    double scale);
  MatchOutcome conclude(std::vector<Hypothesis>& hypotheses, const geometry::UncertainPose2& prior,
                        const SearchWindow& window) const;
  bool isClear(const Hypothesis& hypothesis, bool predicted) const;
  double addKeyframe(Reference& reference, const Sweep& sweep, const geometry::Pose2& T_odom_base);

  SubmapConfig config_;
  LineMatcher lines_;
  Reference trusted_;
  Reference fresh_;
  bool matched_fresh_ = false;
  int fresh_matches_ = 0;
};

}  // namespace sightline::dead_reckoning
