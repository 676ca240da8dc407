#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "sightline/dead_reckoning/angle_histogram.h"
#include "sightline/dead_reckoning/dead_reckoner_config.h"
#include "sightline/dead_reckoning/matcher.h"
#include "sightline/dead_reckoning/search_window.h"
#include "sightline/dead_reckoning/surface_points.h"
#include "sightline/dead_reckoning/translation_search.h"
#include "sightline/geometry/pose2.h"

namespace sightline::dead_reckoning {

/// Saarinen algs 5 to 7: headings from angle histograms of several step sizes, for each of the best
/// of them the translation by the iterative searcher, and the best of all these.
class HistogramMatcher : public Matcher {
 public:
  explicit HistogramMatcher(const HistogramConfig& config) : config_(config) {}

  bool hasReference() const override { return T_odom_reference_.has_value(); }
  MatchOutcome match(const SurfaceScan& surfaces, const geometry::UncertainPose2& prior,
                     const SearchWindow& window) const override;
  double learn(const SurfaceScan& surfaces, const geometry::Pose2& T_odom_base,
               const MatchOutcome& outcome) override;
  void clear() override { T_odom_reference_.reset(); }

 private:
  std::vector<HeadingCandidate> headings(const SurfaceScan& surfaces, double centre,
                                         double half_width) const;
  std::vector<std::vector<double>> histograms(const SurfaceScan& surfaces) const;

  HistogramConfig config_;
  std::optional<geometry::Pose2> T_odom_reference_;
  std::vector<std::vector<double>> reference_histograms_;  // by step size
  DistanceField field_;
};

/// Cost that the searcher minimises: eq. 4.8 with D = `max_distance`. In wide cells D is as large
/// as these, and a distance that the position may be off within the cell does not count, so that
/// the right cell is known by its middle. The field has to be drawn with fieldDistance.
CellCost translationCost(const DistanceField& field, const std::vector<Eigen::Vector2d>& points,
                         double max_distance);
/// @param half  of the square that is searched [m]
double fieldDistance(double max_distance, double half);

}  // namespace sightline::dead_reckoning
