#pragma once

#include <string>

#include <visualization_msgs/MarkerArray.h>

#include "sightline/scan/scan.h"
#include "sightline/tracking/room_tracker.h"

namespace sightline::bridge {

/// One scan's tracking as rviz sees it, in the map frame: every wall (bright in the robot's room),
/// the gates, the beams that the walls were fitted to, the 95 % ellipse of the position with the
/// heading, and the name of the room. Markers keep their namespaces and ids from scan to scan, so
/// each replaces the one before.
visualization_msgs::MarkerArray roomMarkers(const tracking::TrackerUpdate& update,
                                            const world::RoomMap& map, const scan::Scan& scan,
                                            const geometry::Pose2& T_base_sensor,
                                            const std::string& map_frame);

/// The rooms before there is a pose, in the map frame: every wall, and in their middle a text on
/// what is awaited. It takes the place of what was drawn for a pose, and a pose the place of it.
visualization_msgs::MarkerArray awaitingMarkers(const world::RoomMap& map, const std::string& text,
                                                const std::string& map_frame);

}  // namespace sightline::bridge
