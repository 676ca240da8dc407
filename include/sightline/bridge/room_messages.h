#pragma once

#include <string>

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <geometry_msgs/TransformStamped.h>
#include <nav_msgs/OccupancyGrid.h>

#include "sightline/TrackerStatus.h"
#include "sightline/tracking/room_tracker.h"
#include "sightline/world/occupancy.h"

namespace sightline::bridge {

geometry_msgs::PoseWithCovarianceStamped toPoseMessage(const tracking::TrackerUpdate& update,
                                                       const std::string& map_frame);
TrackerStatus toStatusMessage(const tracking::TrackerUpdate& update, const world::RoomMap& map,
                              const std::string& map_frame);
/// map→odom at the stamp of the scan.
geometry_msgs::TransformStamped toMapOdom(const tracking::TrackerUpdate& update,
                                          const std::string& map_frame,
                                          const std::string& odom_frame);
nav_msgs::OccupancyGrid toGridMessage(const world::Occupancy& grid, const std::string& map_frame);

}  // namespace sightline::bridge
