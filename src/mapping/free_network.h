#pragma once

#include <vector>

#include <Eigen/Core>

#include "sightline/mapping/room_outline.h"

namespace sightline::mapping {

/// Covariance of sides among one another: a shift and a turn of all together is a choice of the
/// map's frame, and no error of a wall (inner constraints of a free network, Baarda 1973; the frame
/// is that which fits the middles of all sides that were seen best).
class FreeNetwork {
 public:
  explicit FreeNetwork(const std::vector<RoomOutline>& rooms);

  /// @param joint  of (distance, angle) of all sides, in the frame of the first pose
  /// @return of (distance at the middle of the side, angle) of all sides
  Eigen::MatrixXd covariance(const Eigen::MatrixXd& joint) const;

 private:
  void add(const RoomOutline& room, std::size_t side, Eigen::Index at);

  Eigen::MatrixXd to_middle_;
  Eigen::MatrixXd by_frame_;  // ∂(distance at the middle, angle) of all sides / ∂(x, y, θ)
  Eigen::MatrixXd seen_;      // the same of the distances of sides that were seen, others zero
};

}  // namespace sightline::mapping
