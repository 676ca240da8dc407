#pragma once

#include <cstddef>
#include <string>

#include "sightline/config/fields.h"
#include "sightline/logs/carmen_log.h"

namespace sightline::bridge {

/// Options for making a bag of a CARMEN log.
struct CarmenBagOptions {
  bool reverse_from_tv = false;  ///< repair odometry that counts forward while the robot backs
  double odometry_delay = 0.0;   ///< [s] the odometry is stamped later by this
  double laser_offset = 0.0;     ///< [m] of the laser ahead of base_link

  void visit(config::FieldVisitor& visitor);
};

/// Contents of the bag that was written.
struct CarmenBagContents {
  std::size_t scans = 0;
  std::size_t odometry = 0;
  std::size_t not_rising = 0;  ///< scans stamped no later than the one before
};

/// Writes /scan, /odom and /tf (odom→base_link, base_link→laser), scans in the order of the log.
///
/// Scans are stamped with their ipc_time, or where that does not rise with logs::risingStamps(),
/// and taken as made at once, since CARMEN does not log how long a sweep takes. `path`.stamps holds
/// both stamps of each scan (logs::readStamps). A reading at or beyond the range limit (of the
/// line, of the parameter robot_front_laser_max, or else the 81 m from which on a SICK LMS reports
/// faults) is +Inf; a reading of zero or less is NaN. The mounting is repeated with each odometry
/// pose, so that the bag can be played from anywhere.
///
/// Throws config::Error where the log holds no scans, or has no velocity to repair its odometry
/// from; rosbag::BagException where the file cannot be written.
CarmenBagContents writeCarmenBag(const logs::CarmenLog& log, const CarmenBagOptions& options,
                                 const std::string& path);

}  // namespace sightline::bridge
