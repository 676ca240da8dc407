#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "scan_log.h"
#include "sightline/dead_reckoning/angle_histogram.h"
#include "sightline/dead_reckoning/histogram_matcher.h"
#include "sightline/dead_reckoning/surface_points.h"
#include "sightline/dead_reckoning/translation_search.h"

/// The iterative searcher against the even grid it stands for, ±1.28 m at 0.02 m.
///
/// odometry.searcher.evaluations: a match; disagreement: share of matches whose cost is more than
/// 1 % above the grid's. Pairs of scans of fr079 a second apart, turned by the heading that their
/// histograms agree best at, corridor and offices alike.
namespace sightline::bench {

class SearcherCheck {
 public:
  void add(const dead_reckoning::SurfaceScan& reference,
           const dead_reckoning::SurfaceScan& surfaces) {
    constexpr double kHalf = 1.28;        // m
    constexpr double kResolution = 0.02;  // m
    const dead_reckoning::HistogramConfig config;
    const double heading = headingBetween(reference, surfaces);
    std::vector<Eigen::Vector2d> points;
    const Eigen::Matrix2d rotation = geometry::Pose2(0.0, 0.0, heading).rotation();
    for (const auto& point : surfaces.points) points.push_back(rotation * point.position);
    field_.draw(reference.points, dead_reckoning::fieldDistance(config.max_distance, kHalf));
    const auto cost = dead_reckoning::translationCost(field_, points, config.max_distance);
    const auto found =
        dead_reckoning::searchIteratively(cost, Eigen::Vector2d::Zero(), kHalf, kResolution);
    const auto best =
        dead_reckoning::searchUniformly(cost, Eigen::Vector2d::Zero(), kHalf, kResolution);
    ++matches_;
    evaluations_ = found.evaluations;
    if (found.cost > 1.01 * best.cost) ++worse_;
  }

  void print() const {
    fmt::print("odometry.searcher.evaluations {} 1\n", evaluations_);
    fmt::print("odometry.searcher.disagreement {:.2f} %\n",
               100.0 * static_cast<double>(worse_) / static_cast<double>(matches_));
  }

 private:
  static double headingBetween(const dead_reckoning::SurfaceScan& reference,
                               const dead_reckoning::SurfaceScan& surfaces) {
    constexpr std::size_t kBins = 360;
    constexpr std::size_t kSkip = 20;    // beams
    constexpr double kHalfWidth = 0.35;  // rad
    const auto candidates = dead_reckoning::correlateHistograms(
        dead_reckoning::angleHistogram(reference.points, kSkip, kBins),
        dead_reckoning::angleHistogram(surfaces.points, kSkip, kBins), 0.0, kHalfWidth);
    return candidates.empty() ? 0.0 : candidates.front().heading;
  }

  dead_reckoning::DistanceField field_;
  std::size_t matches_ = 0;
  std::size_t worse_ = 0;
  std::size_t evaluations_ = 0;
};

inline void measureSearcher(const ScanLog& log) {
  SearcherCheck check;
  const auto surfacesAt = [&](std::size_t i) {
    return dead_reckoning::readSurfaces(log.scan(i), geometry::Pose2(), Eigen::Vector3d::Zero());
  };
  constexpr std::size_t kApart = 4;  // scans
  for (std::size_t i = 0; i + kApart < log.size(); i += 10)
    check.add(surfacesAt(i), surfacesAt(i + kApart));
  check.print();
}

}  // namespace sightline::bench
