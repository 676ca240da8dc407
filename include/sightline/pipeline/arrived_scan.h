#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "sightline/motion/range_scan.h"
#include "sightline/scan/elapsed_time.h"
#include "sightline/scan/scan.h"

namespace sightline::pipeline {

/// A scan as it arrived.
struct ArrivedScan {
  std::size_t scanner = 0;
  scan::Scan scan;
  std::optional<motion::HeadSweep> head;  ///< of a sensor that turns with a head
  std::int64_t arrival = 0;               ///< by the feed's clock [ns]
  /// Added to the stamp where the odometry is looked up, by what turns have shown [ns].
  std::int64_t odometry_shift = 0;
  bool begins_new_time = false;  ///< the first one since the clock was set
  /// Time since the scan before, where the stamps are those of arrival and do not tell it.
  std::optional<scan::ElapsedTime> elapsed = {};

  /// The frame whose motion transforms know: the head's mount, or the sensor itself.
  const std::string& carriedFrame() const { return head ? head->mount_frame : scan.frame; }
};

}  // namespace sightline::pipeline
