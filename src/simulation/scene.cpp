#include "sightline/simulation/scene.h"

#include <utility>

namespace sightline::simulation {

namespace {

// A thing that ends where it begins, below the floor, is not seen.
constexpr double kNowhere = -1.0;  // [m]

}  // namespace

world::WorldDisc Scene::discOf(const Moving& moving, const geometry::Pose2& T_map_body) const {
  return {T_map_body.translation(), moving.body.radius, moving.body.bottom, moving.body.top,
          moving.material};
}

world::WorldSegment Scene::segmentOf(const Moving& moving,
                                     const geometry::Pose2& T_map_body) const {
  const Eigen::Vector2d half(0.0, 0.5 * moving.body.width);
  return {{T_map_body * Eigen::Vector2d(-half), T_map_body * half},
          moving.body.bottom,
          moving.body.top,
          moving.material};
}

std::size_t Scene::add(const Body& body, BodyPoseAt T_map_body) {
  body.check("");
  const std::size_t material = world_.addMaterial({"of a body", body.reflectivity});
  Moving moving{body, std::move(T_map_body), material, {}};
  const geometry::Pose2 start = moving.T_map_body(0);
  if (body.radius > 0.0) {
    moving.pieces.push_back({world_.discs().size(), true});
    world_.add(discOf(moving, start));
  }
  if (body.width > 0.0) {
    moving.pieces.push_back({world_.segments().size(), false});
    world_.add(segmentOf(moving, start));
  }
  bodies_.push_back(std::move(moving));
  return bodies_.size() - 1;
}

void Scene::place(const Moving& moving, const geometry::Pose2& T_map_body) {
  for (const Piece& piece : moving.pieces) {
    if (piece.is_disc) {
      world_.replace(piece.index, discOf(moving, T_map_body));
    } else {
      world_.replace(piece.index, segmentOf(moving, T_map_body));
    }
  }
}

void Scene::hide(const Moving& moving) {
  Moving hidden = moving;
  hidden.body.bottom = hidden.body.top = kNowhere;
  place(hidden, {});
}

const world::World& Scene::at(std::int64_t time, std::size_t observer) {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (i == observer) {
      hide(bodies_[i]);
    } else {
      place(bodies_[i], bodies_[i].T_map_body(time));
    }
  }
  return world_;
}

}  // namespace sightline::simulation
