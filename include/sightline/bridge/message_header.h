#pragma once

#include <cstdint>
#include <string>

#include <std_msgs/Header.h>

#include "sightline/bridge/time.h"

namespace sightline::bridge {

/// Header of a message that holds at a time [ns], in a frame.
inline std_msgs::Header headerOf(std::int64_t stamp, const std::string& frame) {
  std_msgs::Header header;
  header.stamp = timeOf(stamp);
  header.frame_id = frame;
  return header;
}

}  // namespace sightline::bridge
