#pragma once

#include <cstddef>

#include "sightline/geometry/pose2.h"
#include "sightline/scan/scan.h"
#include "sightline/world/room_view.h"

namespace sightline::tracking {

/// Agreement of the beams of a scan with the walls of a map, seen from a pose.
struct ScanAgreement {
  std::size_t on_wall = 0;  ///< ended where a wall is
  std::size_t beyond = 0;   ///< passed through a place where a wall is
  std::size_t occluded =
      0;  ///< ended before the wall: says nothing against the pose, rooms are furnished

  std::size_t looked_at = 0;  ///< all beams, those without a statement too
  std::size_t unjudged = 0;   ///< the map does not tell, or not surely, what they should meet
  /// Of those on walls, as many as say again what others on the same wall have said: furniture that
  /// stands along a wall is as long as a wall is.
  double repeated = 0.0;

  /// Beams that say something for or against the pose.
  std::size_t evidence() const { return on_wall + beyond; }
  /// Share of the beams that could have met a wall and did; 0 where none could.
  double quality() const {
    return evidence() == 0 ? 0.0 : static_cast<double>(on_wall) / static_cast<double>(evidence());
  }
  /// Beams of which the map tells what they should meet.
  std::size_t judged() const { return evidence() + occluded; }
};

/// Share of the beams that meet the walls of a map, [0.5, 0.85], where nothing is known of how much
/// stands in its rooms.
constexpr double kUsualHits = 0.6;

/// Logarithm of the likelihood of a scan, in proportion to that from just any other pose, by a beam
/// model of three outcomes: a beam meets the wall, something before it, or goes through it (0.02);
/// from just any other pose fewer meet it and more go through it. Beams of which the map tells
/// nothing say nothing: else poses with many walls around them would win. What stops one beam stops
/// its neighbours: all within 4° together count as one.
///
/// @param usual_hits  share of the beams that meet walls; what lies outside [0.5, 0.85] is taken
/// for
///                    the nearest limit, so that a beam on a wall never speaks against a pose
double logLikelihood(const ScanAgreement& agreement, const scan::ScanGeometry& geometry,
                     double usual_hits = kUsualHits);
/// Logarithm of the odds by which a scan speaks for the pose and against just any other one, from
/// which fewer beams meet walls (0.53), as many are stopped (0.19) and more go through (0.28). What
/// the map does not tell says nothing.
double logOdds(const ScanAgreement& agreement, const scan::ScanGeometry& geometry);

/// Share of an independent statement that one of the beams looked at makes: what stops one beam
/// stops its neighbours.
double weightOf(const ScanAgreement& agreement, const scan::ScanGeometry& geometry);

/// `tolerance` [m], of the distance from a wall and of the place on it, is for what pose, map and
/// sensor leave open. The view has to be that of the pose, T_map_sensor. Of every `stride` beams
/// one is looked at.
ScanAgreement scanAgreement(const scan::Scan& scan, const geometry::Pose2& T_map_sensor,
                            const world::RoomView& view, double tolerance, std::size_t stride = 1);

/// Whether the field of view is wide enough for one scan to tell places of a map apart. In a
/// narrower one every corner of a room looks alike, and so does furniture: such a scan corrects a
/// pose, but does not tell that the robot is elsewhere.
bool tellsPlacesApart(const scan::ScanGeometry& geometry);

}  // namespace sightline::tracking
