#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include <Eigen/Core>

#include "sightline/dead_reckoning/surface_points.h"

namespace sightline::dead_reckoning {

/// The distance of each place from the nearest point of a reference scan, up to `max_distance`,
/// looked up on a fine grid (saarinen alg. 7 steps 3 and 4 discretise and sort instead). Covers
/// kReach to each side of the reference's base; further points are not counted.
class DistanceField {
 public:
  static constexpr double kReach = 12.8;  ///< [m]
  static constexpr double kCell = 0.04;   ///< [m]

  /// @param max_distance  [m]
  void draw(const std::vector<SurfacePoint>& points, double max_distance);

  /// Mean of min(d, D)/D over points [m, in the frame of the reference] (eq. 4.8, divided by their
  /// number). D is at most what the field was drawn with; a point off the field counts 1.
  ///
  /// @param slack  taken from each distance [m]: the shift may be this far off
  double cost(const std::vector<Eigen::Vector2d>& points, const Eigen::Vector2d& shift,
              double truncation, double slack = 0.0) const;

 private:
  void paint(const Eigen::Vector2d& point);

  double max_distance_ = 1.0;
  std::vector<float> distances_;
};

/// Least value of a cost over the plane, and its place.
struct Minimum {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  double cost = 0.0;
  std::size_t evaluations = 0;
};

/// A cost at a position, knowing how wide the cells are that it stands for [m].
using CellCost = std::function<double(const Eigen::Vector2d& position, double cell)>;

/// The iterative searcher of saarinen section 4.3.4.2 (fig. 4.13): the square ±half about the
/// centre is divided into 4 x 4 cells, the best of them is the centre of the next square, half as
/// wide, until the cells are as small as the resolution. Two squares are followed, as a wide cell
/// is known by its middle alone, and the second best may hold the minimum: ±1.28 m at 0.02 m takes
/// 16 and then 5 times 32 evaluations.
Minimum searchIteratively(const CellCost& cost, const Eigen::Vector2d& centre, double half,
                          double resolution);

/// The same over all positions of an even grid, for comparison: 16384 evaluations there.
Minimum searchUniformly(const CellCost& cost, const Eigen::Vector2d& centre, double half,
                        double resolution);

}  // namespace sightline::dead_reckoning
