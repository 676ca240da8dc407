#include "sightline/bridge/tracker_settings.h"

namespace sightline::bridge {

RoomTrackerConfig toReconfigure(const tracking::TrackerConfig& config) {
  auto settings = RoomTrackerConfig::__getDefault__();
  settings.gate_sigmas = config.gate.sigmas;
  settings.gate_max_opening = config.gate.max_opening;
  settings.gate_max_angle = config.gate.max_angle;
  settings.wall_min_beams = config.wall.min_beams;
  settings.wall_min_length = config.wall.min_length;
  settings.wall_position_sigma = config.wall.position_sigma;
  settings.wall_direction_sigma = config.wall.direction_sigma;
  settings.wall_max_nis = config.wall.max_nis;
  settings.slip_min_quality = config.slip.min_quality;
  return settings;
}

void applyReconfigure(const RoomTrackerConfig& settings, tracking::TrackerConfig& config) {
  config.gate.sigmas = settings.gate_sigmas;
  config.gate.max_opening = settings.gate_max_opening;
  config.gate.max_angle = settings.gate_max_angle;
  config.wall.min_beams = settings.wall_min_beams;
  config.wall.min_length = settings.wall_min_length;
  config.wall.position_sigma = settings.wall_position_sigma;
  config.wall.direction_sigma = settings.wall_direction_sigma;
  config.wall.max_nis = settings.wall_max_nis;
  config.slip.min_quality = settings.slip_min_quality;
}

}  // namespace sightline::bridge
