#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Core>
#include <Eigen/StdVector>

#include "sightline/geometry/arc.h"
#include "sightline/geometry/feature.h"
#include "sightline/geometry/line_segment.h"
#include "sightline/scan/scan.h"

namespace sightline::lines {

/// A feature as one scan shows it.
struct Sighting {
  geometry::FeatureKind kind = geometry::FeatureKind::kCorner;
  Eigen::Vector2d position = Eigen::Vector2d::Zero();    ///< [m]
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  ///< of what errs anew in each scan [m²]
  /// Unit vector along the wall that ends here; zero where none does.
  Eigen::Vector2d along = Eigen::Vector2d::Zero();
  /// Variance, along the wall, of the place of an end between two beams [m²]: it errs alike until
  /// the beams fall elsewhere.
  double between_beams = 0.0;
  std::optional<std::size_t> arc;  ///< its number, if it is one

  Eigen::Matrix2d fullCovariance() const {
    return covariance + between_beams * along * along.transpose();
  }
};

/// Features in what the extractor found, in the scan's frame: corners once, with the covariance of
/// the crossing of their two lines; ends where the scan or its range ends are none.
std::vector<Sighting> sightingsIn(const scan::Scan& scan,
                                  const std::vector<geometry::LineSegment>& segments,
                                  const std::vector<geometry::Arc>& arcs);

/// The same in another frame.
Sighting operator*(const geometry::Pose2& T_target_source, const Sighting& sighting);

}  // namespace sightline::lines
