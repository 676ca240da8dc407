#pragma once

#include "sightline/RoomTrackerConfig.h"
#include "sightline/tracking/tracker_config.h"

/// The settings of the room tracker as dynamic_reconfigure knows them (cfg/RoomTracker.cfg).
namespace sightline::bridge {

RoomTrackerConfig toReconfigure(const tracking::TrackerConfig& config);
/// The settings put into a configuration; what cfg/ does not hold stays.
void applyReconfigure(const RoomTrackerConfig& settings, tracking::TrackerConfig& config);

}  // namespace sightline::bridge
