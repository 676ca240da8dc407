#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "sightline/scan/scan.h"
#include "sightline/world/room_map.h"

namespace sightline::tracking {

/// A beam that met something straight.
struct SurfacePoint {
  Eigen::Vector2d position;  ///< [m]
  Eigen::Vector2d normal;    ///< unit vector, towards the scanner
  double length = 0.0;       ///< of surface that the beam stands for [m]
};

/// The beams of a scan whose neighbours lie on a line with them, in the sensor's frame, at most
/// `most` of them, evenly spread.
std::vector<SurfacePoint> surfacePoints(const scan::Scan& scan, std::size_t most);

/// The main directions of pieces of walls modulo 90°, in [0, 90°) [rad]: one, or two where the
/// second holds at least a third of the first's length and lies 8° away. None without pieces.
std::vector<double> mainDirections(const std::vector<SurfacePoint>& pieces);

/// The walls of a map as such pieces, one a span, where they are solid.
std::vector<SurfacePoint> wallPieces(const world::RoomMap& map);

}  // namespace sightline::tracking
