#pragma once

#include <cstddef>

#include "sightline/geometry/line_segment.h"
#include "sightline/lines/beam_array.h"
#include "sightline/lines/piece.h"
#include "sightline/scan/scan.h"

namespace sightline::lines {

/// End of a wall and its reason.
struct EndPoint {
  double position = 0.0;  ///< along the line [m]
  double variance = 0.0;  ///< [m²]
  geometry::EndKind kind = geometry::EndKind::kUnknown;
};

/// Finds the ends of finished pieces. A wall that meets another one ends where the two lines cross;
/// any other end lies between the last beam on the wall and the first one that passes it.
class EndPoints {
 public:
  EndPoints(const scan::Scan& scan, const BeamArray& beams) : scan_(scan), beams_(beams) {}

  /// `neighbour` is the piece met next in the direction of the end, null where there is none; on a
  /// full circle its return numbers may be a revolution off.
  EndPoint start(const Piece& piece, const Piece* neighbour) const;
  EndPoint end(const Piece& piece, const Piece* neighbour) const;

 private:
  enum class Side { kStart, kEnd };
  /// Point at which a beam would meet the line.
  struct Meeting {
    double position;
    double range;
    double variance;  // of the position, from the uncertainty of the line
    double jitter;    // variance of the position, from that of the beam's direction
    bool exists;
  };
  EndPoint find(const Piece& piece, const Piece* neighbour, Side side) const;
  EndPoint edge(const Piece& piece, std::size_t last, Side side) const;
  bool corner(const Piece& piece, const Piece& neighbour, std::size_t last, std::size_t next,
              EndPoint& point) const;
  bool areNeighbours(std::size_t i, std::size_t k) const;
  /// Between an outermost return of a piece and the one before it: near a corner the noise may put
  /// a return on the other wall.
  double spacingAt(const Piece& piece, std::size_t i) const;
  double jitterAt(const Eigen::Vector2d& point, const Eigen::Vector2d& origin,
                  const Eigen::Vector2d& slide) const;
  Meeting meet(const LineEstimate& line, std::size_t beam) const;

  const scan::Scan& scan_;
  const BeamArray& beams_;
};

}  // namespace sightline::lines
