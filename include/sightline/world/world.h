#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "sightline/config/node.h"
#include "sightline/geometry/segment.h"
#include "sightline/world/material.h"
#include "sightline/world/room_map.h"

namespace sightline::world {

/// An upright plane piece: a wall, a side of a piece of furniture.
struct WorldSegment {
  geometry::Segment segment;
  double bottom = 0.0;       ///< [m] above the floor
  double top = 2.5;          ///< [m] above the floor
  std::size_t material = 0;  ///< index into World::materials()
};

/// An upright cylinder: a leg, a pillar, a pole.
struct WorldDisc {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  double radius = 0.0;  ///< [m]
  double bottom = 0.0;
  double top = 2.5;
  std::size_t material = 0;
};

/// A level plane piece: the top of a table, the floor.
struct WorldPlate {
  std::vector<Eigen::Vector2d> corners;  ///< convex, counter-clockwise; without any it is endless
  double height = 0.0;                   ///< [m] above the floor
  std::size_t material = 0;
};

/// A half line in space.
struct Ray {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();      ///< [m], z above the floor
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();  ///< unit vector
};

struct Hit {
  double range = 0.0;  ///< along the ray [m]
  std::size_t material = 0;
  double cos_incidence = 1.0;  ///< of the angle between ray and surface normal, in [0, 1]
  std::optional<std::size_t> segment = std::nullopt;  ///< index into World::segments(), if one
};

/// World for a range sensor to see: upright pieces and cylinders with height and material, in the
/// map frame.
///
/// ```yaml
/// include:                            # further files of this kind
///   - {file: furniture/office.yaml, pose: [6.2, 2.8, 0.0]}   # m, m, rad: where its frame stands
/// rooms: ../rooms/floor.yaml          # a RoomMap whose walls stand here, doors being open
/// walls: {height: 2.5, material: plaster}     # of these walls; this is the default
/// materials:                          # besides plaster
///   cloth: {reflectivity: 0.3}
///   steel: {reflectivity: 0.5, lobe: {gain: 4.0, half_width: 0.05, steepness: 2.0}}   # -, rad, -
/// floor: {material: cloth}            # optional: a ray that goes down meets it
/// ceiling: {height: 2.5, material: plaster}   # optional
/// segments:
///   - {from: [0.0, 1.0], to: [2.0, 1.0], bottom: 0.0, top: 1.6, material: cloth}   # m
/// boxes:                              # furniture; bottom and top are closed
///   - {centre: [1.0, 2.0], size: [1.2, 0.8], yaw: 0.1, bottom: 0.72, top: 0.75, material: cloth}
/// discs:
///   - {centre: [1.0, 2.0], radius: 0.05, bottom: 0.0, top: 0.72, material: cloth}
/// ```
/// Bottom, top and material may be left out: then it stands on the floor, as high and made as the
/// walls. Paths are relative to the file that names them. A material is known to the files that a
/// file includes; naming it again there changes nothing already built.
class World {
 public:
  /// Empty space, with plaster as its first material.
  World();
  /// Throws config::Error with file, line and key.
  explicit World(const config::Node& document);
  static World readFile(const std::string& path) { return World(config::Node::readFile(path)); }
  /// The solid walls of a map, of plaster and as high as walls are by default, and nothing else.
  static World of(const RoomMap& map);

  /// Index for the surfaces made of it; a second one of a name replaces the first from here on.
  std::size_t addMaterial(const Material& material);
  std::optional<std::size_t> findMaterial(const std::string& name) const;
  void add(const WorldSegment& segment);
  void add(const WorldDisc& disc) { discs_.push_back(disc); }
  void add(WorldPlate plate) { plates_.push_back(std::move(plate)); }
  /// Takes the place of a segment or disc that was added, by its index: it has moved.
  void replace(std::size_t index, const WorldSegment& segment);
  void replace(std::size_t index, const WorldDisc& disc) { discs_[index] = disc; }

  const std::vector<Material>& materials() const { return materials_; }
  const std::vector<WorldSegment>& segments() const { return segments_; }
  const std::vector<WorldDisc>& discs() const { return discs_; }
  const std::vector<WorldPlate>& plates() const { return plates_; }

  /// The nearest surface along a ray, where any. Points and lines of the plane are homogeneous: the
  /// line through the ray is the cross product of its origin and its point at infinity, and meets
  /// the segments whose ends lie on either side of it.
  std::optional<Hit> cast(const Ray& ray) const;

  /// The surfaces that rays beside an axis can meet: the same as without it, sooner, for any number
  /// of them.
  struct Shortlist {
    std::vector<std::size_t> segments;
  };
  /// Shortlist for rays that stay, ahead of the origin of the axis and in plan view, within
  /// `half_width` [m] of it. The axis must not be upright.
  Shortlist shortlist(const Ray& axis, double half_width) const;
  std::optional<Hit> cast(const Ray& ray, const Shortlist& shortlist) const;

 private:
  // A segment's line (unit normal, offset): the cross product of its homogeneous ends.
  struct Side {
    Eigen::Vector3d line;
    Eigen::Vector3d start;
    Eigen::Vector3d end;
  };
  static Side sideOf(const geometry::Segment& segment);
  // Finds the nearest of segments that come in any order and number.
  class NearestSegment;
  void castOthers(const Ray& ray, std::optional<Hit>& nearest) const;
  void castDiscs(const Ray& ray, std::optional<Hit>& nearest) const;
  void castPlates(const Ray& ray, std::optional<Hit>& nearest) const;

  std::vector<Material> materials_;
  std::vector<WorldSegment> segments_;
  std::vector<Side> sides_;
  std::vector<WorldDisc> discs_;
  std::vector<WorldPlate> plates_;
};

/// The walls of a map where they are really there, and the jambs that close the gap between the two
/// walls of a door, so that nobody looks between them.
std::vector<geometry::Segment> solidWalls(const RoomMap& map);

}  // namespace sightline::world
