#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "sightline/geometry/pose2.h"
#include "sightline/simulation/body.h"
#include "sightline/world/world.h"

namespace sightline::simulation {

/// The world as it is at a time [ns]. What it returns holds until it is asked again.
using WorldAt = std::function<const world::World&(std::int64_t)>;

/// A world in which nothing moves; it has to live as long.
inline WorldAt still(const world::World& world) {
  return [&world](std::int64_t) -> const world::World& { return world; };
}

/// A world and the bodies that move through it.
class Scene {
 public:
  /// Pose of a body in the map at a time [ns].
  using BodyPoseAt = std::function<geometry::Pose2(std::int64_t)>;

  explicit Scene(world::World world) : world_(std::move(world)) {}

  /// Returns the index of the body. Throws config::Error.
  std::size_t add(const Body& body, BodyPoseAt T_map_body);
  /// The world at a time [ns] as the body `observer` sees it, which does not see itself. The
  /// result holds until the next call.
  const world::World& at(std::int64_t time, std::size_t observer);

 private:
  struct Piece {
    std::size_t index;  // in the world
    bool is_disc;
  };
  struct Moving {
    Body body;
    BodyPoseAt T_map_body;
    std::size_t material;
    std::vector<Piece> pieces;
  };
  world::WorldDisc discOf(const Moving& moving, const geometry::Pose2& T_map_body) const;
  world::WorldSegment segmentOf(const Moving& moving, const geometry::Pose2& T_map_body) const;
  void place(const Moving& moving, const geometry::Pose2& T_map_body);
  void hide(const Moving& moving);

  world::World world_;
  std::vector<Moving> bodies_;
};

}  // namespace sightline::simulation
