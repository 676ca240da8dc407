#pragma once

#include <string>

#include "sightline/mapping/room_alignment.h"
#include "sightline/mapping/room_fitter.h"
#include "sightline/world/room_map.h"

namespace sightline::mapping {

/// A rooms file to which a recording has been added.
struct MergedRooms {
  world::RoomMap map;
  FittedRooms fitted;  ///< the recording's, in the map; its rooms are all of the map
  RoomAlignment alignment;
  std::size_t doors = 0;  ///< that were added
};

/// Adds the rooms of a recording to a map: what the map has stays as it is, name, place, spans and
/// all; rooms that it lacks, or the part of them that it lacks, come in with new names, and doors
/// where the recording shows some that the map does not have. Throws config::Error with the path
/// where the recording's rooms do not fit into the map, or fit in more than one way.
///
/// @param path  of the map's file, for messages
/// @param keys  of the recording
MergedRooms mergeRooms(const world::RoomMap& map, const std::string& path,
                       const std::vector<KeyScan>& keys, FittedRooms fitted);

/// The text of a rooms file for people.
std::string mergedText(const MergedRooms& merged);

}  // namespace sightline::mapping
