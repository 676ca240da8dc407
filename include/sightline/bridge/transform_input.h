#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <tf2/buffer_core.h>
#include <tf2_msgs/TFMessage.h>

#include "sightline/pipeline/stamp_watch.h"

namespace sightline::bridge {

/// Puts messages of transforms into a tf buffer, live and from a bag alike. What would poison it
/// stays outside: numbers that are no pose, and stamps that leap. Where the clock was set back, the
/// buffer begins anew.
class TransformInput {
 public:
  /// The buffer has to live as long.
  explicit TransformInput(tf2::BufferCore& buffer) : buffer_(buffer) {}

  /// Returns the reasons of the transforms that were left out, one for each. One whose stamp leaps
  /// is kept until the next ones tell whether the clock was set.
  std::vector<std::string> take(const tf2_msgs::TFMessage& message, bool is_static,
                                std::int64_t now);

 private:
  using Transform = geometry_msgs::TransformStamped;
  using Faults = std::vector<std::string>;
  struct Child {
    pipeline::StampWatch stamps;
    std::vector<Transform> strays;  // whose stamps may be those of a new time
    std::int64_t newest = 0;        // [ns]
  };

  void admit(const Transform& transform, std::int64_t now, Faults& faults);
  void beginNewTime(Child& child, bool is_earlier);
  static void dropStrays(Child& child, Faults& faults);
  void insert(const Transform& transform, Child& child);

  tf2::BufferCore& buffer_;
  std::map<std::string, Child> children_;  // by frame
};

}  // namespace sightline::bridge
