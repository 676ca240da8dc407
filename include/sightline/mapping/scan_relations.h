#pragma once

#include <cstddef>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "sightline/dead_reckoning/submap_matcher.h"
#include "sightline/geometry/pose2.h"
#include "sightline/mapping/pose_graph.h"
#include "sightline/mapping/survey.h"

namespace sightline::mapping {

/// How far from its estimate a key scan may be [m, rad].
struct Doubt {
  double position = 0.3;
  double heading = 0.12;
};

/// Matches key scans with others, by point-to-line matching onto a few scans that were taken one
/// after another, and by a search where the doubt is wide. Poses are T_map_base by key scan, as far
/// as they are known; keys and poses are held by reference.
class ScanRelations {
 public:
  ScanRelations(const std::vector<KeyScan>& keys, const std::vector<geometry::Pose2>& poses)
      : keys_(keys), poses_(poses) {}

  /// The key scan against those just before it; nothing where they do not match.
  std::optional<Relation> withPrevious(std::size_t key) const;
  /// The key scan against those about another.
  std::optional<Relation> withVisit(std::size_t key, std::size_t other, const Doubt& doubt);
  /// Key scans of earlier visits of the place of a key scan, the most alike of each visit, best
  /// first.
  ///
  /// @param radius  within which a place is the same [m]
  std::vector<std::size_t> visits(std::size_t key, double radius, std::size_t most) const;
  /// Has to be called when the poses have changed.
  void forget() { references_.clear(); }

 private:
  using Matcher = dead_reckoning::SubmapMatcher;
  struct Reference {
    std::size_t centre;
    std::shared_ptr<const Matcher> matcher;
  };

  std::shared_ptr<const Matcher> reference(std::size_t centre, std::size_t first,
                                           std::size_t last) const;
  const Matcher& referenceAbout(std::size_t centre);
  std::optional<Relation> match(std::size_t key, std::size_t centre, const Matcher& matcher,
                                const Doubt& doubt) const;
  double unlikeness(std::size_t key, std::size_t other) const;

  const std::vector<KeyScan>& keys_;
  const std::vector<geometry::Pose2>& poses_;
  std::deque<Reference> references_;  // the last ones that were needed
};

}  // namespace sightline::mapping
