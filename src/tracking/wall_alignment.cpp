#include "sightline/tracking/wall_alignment.h"

#include <cmath>

#include <Eigen/Cholesky>

namespace sightline::tracking {

namespace {

constexpr struct {
  // Points this far from a wall are taken for it, round after round [m].
  double reaches[5] = {0.45, 0.3, 0.2, 0.12, 0.12};
  double least_alignment = 0.9;  // cosine between the normals of point and wall
  double overshoot = 0.15;       // that a point may lie past the end of a wall [m]
  double soft = 0.05;            // distance at which a point has lost half of its weight [m]
  double damping = 0.05;         // information on what no point tells [1/m²]
} kAlignment;

}  // namespace

WallAlignment::WallAlignment(const world::RoomMap& map, const std::vector<SurfacePoint>& points)
    : points_(points) {
  std::vector<std::vector<Piece>> own(map.rooms().size());
  for (std::size_t i = 0; i < map.rooms().size(); ++i) {
    for (const world::Wall& wall : map.rooms()[i].walls) {
      for (const world::Span& span : wall.spans) {
        own[i].push_back({wall.segment.start + span.from * wall.segment.direction(),
                          wall.segment.leftNormal(), span.to - span.from});
      }
    }
  }
  pieces_ = own;
  for (const world::Door& door : map.doors()) {
    for (const std::size_t side : {0U, 1U}) {
      auto& pieces = pieces_[door.rooms[side]];
      const auto& behind = own[door.rooms[1 - side]];
      pieces.insert(pieces.end(), behind.begin(), behind.end());
    }
  }
}

const WallAlignment::Piece* WallAlignment::nearest(const std::vector<Piece>& pieces,
                                                   const Eigen::Vector2d& position_map,
                                                   const Eigen::Vector2d& normal_map,
                                                   double reach) const {
  const Piece* best = nullptr;
  for (const Piece& piece : pieces) {
    const Eigen::Vector2d from_start = position_map - piece.start;
    const double distance = std::abs(piece.normal.dot(from_start));
    if (distance >= reach || piece.normal.dot(normal_map) < kAlignment.least_alignment) continue;
    const double along = piece.normal.y() * from_start.x() - piece.normal.x() * from_start.y();
    if (along < -kAlignment.overshoot || along > piece.length + kAlignment.overshoot) continue;
    best = &piece;
    reach = distance;
  }
  return best;
}

geometry::Pose2 WallAlignment::refine(const geometry::Pose2& T_map_sensor, std::size_t room) const {
  geometry::Pose2 pose = T_map_sensor;
  for (const double reach : kAlignment.reaches) {
    Eigen::Matrix3d information = kAlignment.damping * Eigen::Matrix3d::Identity();
    Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
    const Eigen::Matrix2d rotation = pose.rotation();
    for (const SurfacePoint& point : points_) {
      const Eigen::Vector2d turned = rotation * point.position;
      const Piece* piece =
          nearest(pieces_[room], turned + pose.translation(), rotation * point.normal, reach);
      if (!piece) continue;
      const double residual = piece->normal.dot(turned + pose.translation() - piece->start);
      const double ratio = residual / kAlignment.soft;
      const double weight = 1.0 / (1.0 + ratio * ratio);
      const Eigen::Vector3d jacobian(
          piece->normal.x(), piece->normal.y(),
          turned.x() * piece->normal.y() - turned.y() * piece->normal.x());
      information += weight * jacobian * jacobian.transpose();
      gradient += weight * residual * jacobian;
    }
    pose = geometry::Pose2(pose.coordinates() - information.ldlt().solve(gradient));
  }
  return pose;
}

}  // namespace sightline::tracking
