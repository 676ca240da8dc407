#pragma once

#include <cstddef>
#include <vector>

#include "sightline/geometry/pose2.h"
#include "sightline/mapping/room_outline.h"
#include "sightline/mapping/survey.h"

namespace sightline::mapping {

/// What rays say of a side of a room, bin by bin from its start.
struct SideEvidence {
  static constexpr double kBin = 0.05;  ///< [m]
  std::vector<int> hits;                ///< rays that ended on it
  std::vector<int> passes;              ///< rays that went through it from inside
  std::vector<int> hidden;  ///< rays that ended on a surface close before it which faces as it does

  /// Whether it stands there, and shows itself more often than what stands before it: a tracker
  /// would take that for the wall.
  bool isWall(std::size_t bin) const {
    return hits[bin] >= 2 && hits[bin] >= passes[bin] && hits[bin] >= hidden[bin];
  }
  bool isOpen(std::size_t bin) const { return passes[bin] >= 2 && passes[bin] > hits[bin]; }
  std::size_t bins() const { return hits.size(); }
  /// Bin of a place along the side; the nearest one.
  std::size_t binAt(double along) const;
};

/// Evidence on all sides, by room and side.
std::vector<std::vector<SideEvidence>> gatherEvidence(const std::vector<KeyScan>& keys,
                                                      const std::vector<geometry::Pose2>& poses,
                                                      const std::vector<RoomOutline>& rooms);

/// Stretches of a side of so many metres that are wall; what nobody saw between two of them is
/// taken for wall where it is short.
std::vector<world::Span> spansOf(const SideEvidence& evidence, double length);

}  // namespace sightline::mapping
