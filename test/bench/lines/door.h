#pragma once

#include <string>
#include <vector>

#include "score.h"

namespace sightline::bench {

/// The walls on both sides of the opening in roomWithDoor().
class DoorScore {
 public:
  void add(const View& view, const geometry::Pose2& pose,
           const std::vector<geometry::LineSegment>& segments, const std::vector<int>& matched) {
    const int lower = wantedSpanAt(view, pose, {8.6, 2.0});
    const int upper = wantedSpanAt(view, pose, {8.6, 3.0});
    if (lower < 0 || upper < 0) return;
    ++seen_;
    const int a = matched[static_cast<std::size_t>(lower)];
    const int b = matched[static_cast<std::size_t>(upper)];
    if (a < 0 || b < 0) return;
    ++separate_;
    addEnd(segments[static_cast<std::size_t>(a)], pose.inverse() * Eigen::Vector2d(8.6, 2.0));
    addEnd(segments[static_cast<std::size_t>(b)], pose.inverse() * Eigen::Vector2d(8.6, 3.0));
  }

  bool isSeen() const { return separate_ > 0; }
  void printFigures(const std::string& scenario) const {
    const std::string name = "lines." + scenario + ".";
    print(name + "both_sides_seen", static_cast<double>(seen_), "scans");
    print(name + "separate", 100.0 * static_cast<double>(separate_) / static_cast<double>(seen_),
          "%");
    print(name + "jamb_median_mm", median(jamb_mm_), "mm");
  }

 private:
  /// The span that really ends there and is long enough to be looked for.
  static int wantedSpanAt(const View& view, const geometry::Pose2& pose,
                          const Eigen::Vector2d& jamb) {
    const Eigen::Vector2d place = pose.inverse() * jamb;
    for (std::size_t i = 0; i < view.spans.size(); ++i) {
      const geometry::Segment& ends = view.spans[i].ends;
      const bool touches = (ends.start - place).norm() < 0.01 || (ends.end - place).norm() < 0.01;
      const bool on_wall = std::abs(view.spans[i].line.signedDistance(place)) < 1e-6;
      if (touches && on_wall && isWanted(view.spans[i])) return static_cast<int>(i);
    }
    return -1;
  }

  void addEnd(const geometry::LineSegment& segment, const Eigen::Vector2d& jamb) {
    jamb_mm_.push_back(
        1e3 * std::min((segment.ends.start - jamb).norm(), (segment.ends.end - jamb).norm()));
  }

  std::size_t seen_ = 0, separate_ = 0;
  std::vector<double> jamb_mm_;
};

}  // namespace sightline::bench
