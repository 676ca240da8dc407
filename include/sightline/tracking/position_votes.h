#pragma once

#include <cstddef>
#include <vector>

#include "sightline/tracking/surface_points.h"

namespace sightline::tracking {

/// Correlation of what faces a scanner with the walls of a map that face the same of four ways:
/// each beam votes for every position from which it would have met such a wall. A wall gives a run
/// of positions along itself, so that a vote is two numbers, whatever the length of the wall.
class PositionVotes {
 public:
  struct Place {
    Eigen::Vector2d position_map;  ///< of the sensor
    double votes = 0.0;            ///< length of surface that meets a wall [m]
  };

  /// @param frame  direction of the walls that count [rad]; others are left out
  PositionVotes(const std::vector<SurfacePoint>& pieces, double frame, double cell);

  /// The best place of each block of half a metre, of those that hold at least four tenths of the
  /// best place's votes.
  ///
  /// @param points   in the sensor's frame
  /// @param heading  of the sensor in the map [rad]
  std::vector<Place> of(const std::vector<SurfacePoint>& points, double heading);

 private:
  // A wall along one of the two axes of the frame: coordinate across it, and from where to where.
  struct Run {
    double across;
    double from;
    double to;
  };
  // Votes along one axis: begins and ends of runs, then their sums.
  struct Layer {
    std::vector<double> cells;
  };

  void vote(const SurfacePoint& point, double turn);
  void addRun(int axis, double across, double from, double to, double weight);
  void sumUp();
  std::vector<Place> places() const;
  std::size_t index(std::size_t x, std::size_t y) const { return y * size_[0] + x; }
  double at(std::size_t i) const { return layers_[0].cells[i] + layers_[1].cells[i]; }

  double frame_;
  double cell_;
  std::vector<Run> runs_[4];  // by the way that they face: +x, +y, −x, −y of the frame
  Eigen::Vector2d origin_;    // of the cells, in the frame
  std::size_t size_[2];
  Layer layers_[2];  // of walls across x and across y
};

}  // namespace sightline::tracking
