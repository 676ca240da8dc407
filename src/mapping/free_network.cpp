#include "free_network.h"

#include <Eigen/Cholesky>

namespace sightline::mapping {

FreeNetwork::FreeNetwork(const std::vector<RoomOutline>& rooms) {
  Eigen::Index size = 0;
  for (const RoomOutline& room : rooms) size += 2 * static_cast<Eigen::Index>(room.sides.size());
  to_middle_ = Eigen::MatrixXd::Identity(size, size);
  by_frame_ = Eigen::MatrixXd::Zero(size, 3);
  seen_ = Eigen::MatrixXd::Zero(size, 3);
  Eigen::Index at = 0;
  for (const RoomOutline& room : rooms) {
    for (std::size_t i = 0; i < room.sides.size(); ++i, at += 2) add(room, i, at);
  }
}

void FreeNetwork::add(const RoomOutline& room, std::size_t i, Eigen::Index at) {
  const geometry::Segment side = room.side(i);
  const Eigen::Vector2d middle = side.midpoint();
  const Eigen::Vector2d normal = room.sides[i].normal();
  to_middle_(at, at + 1) = side.direction().dot(middle - room.anchor);
  by_frame_.row(at) << normal.x(), normal.y(), normal.y() * middle.x() - normal.x() * middle.y();
  by_frame_(at + 1, 2) = 1.0;
  if (room.sides[i].is_seen) seen_.row(at) = by_frame_.row(at);
}

Eigen::MatrixXd FreeNetwork::covariance(const Eigen::MatrixXd& joint) const {
  const Eigen::Matrix3d information =
      seen_.transpose() * seen_ + 1e-9 * Eigen::Matrix3d::Identity();
  const Eigen::MatrixXd frame = information.ldlt().solve(seen_.transpose());
  const Eigen::MatrixXd project = to_middle_ - by_frame_ * (frame * to_middle_);
  return project * joint * project.transpose();
}

}  // namespace sightline::mapping
