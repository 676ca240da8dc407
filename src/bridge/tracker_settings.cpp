#include "sightline/bridge/tracker_settings.h"

#include "sightline/bridge/reconfigure.h"

namespace sightline::bridge {

RoomTrackerConfig toReconfigure(const tracking::TrackerConfig& config) {
  return settingsOf<RoomTrackerConfig>(config);
}

void applyReconfigure(const RoomTrackerConfig& settings, tracking::TrackerConfig& config) {
  applySettings(settings, config);
}

}  // namespace sightline::bridge
