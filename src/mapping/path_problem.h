#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <ceres/problem.h>
#include <ceres/solver.h>

#include "sightline/geometry/pose2.h"
#include "sightline/mapping/pose_graph.h"
#include "sightline/mapping/survey.h"

namespace sightline::mapping {

/// Least squares over the poses of key scans, to which more may be added. The first pose stays.
class PathProblem {
 public:
  PathProblem(const std::vector<KeyScan>& keys, const std::vector<geometry::Pose2>& poses);

  /// Adds the steps by wheels and by dead reckoning.
  void addSteps();
  void add(const Relation& relation);
  /// Leaves all poses where they are.
  void hold();
  void solve();

  ceres::Problem& problem() { return problem_; }
  double* pose(std::size_t key) { return values_[key].data(); }
  std::vector<geometry::Pose2> poses() const;
  double wheelScale() const { return scale_; }
  double wheelTurn() const { return turn_; }
  std::size_t relations() const { return relations_.size(); }
  /// Squared Mahalanobis distance of each relation.
  std::vector<double> relationCosts();

 private:
  void addWheels(std::size_t i, const geometry::Pose2& measured);
  void addReckoning(std::size_t i);

  const std::vector<KeyScan>& keys_;
  std::vector<std::array<double, 3>> values_;
  double scale_ = 1.0;
  double turn_ = 0.0;
  ceres::Problem problem_;
  std::vector<ceres::ResidualBlockId> relations_;
};

}  // namespace sightline::mapping
