// Any text, read as a path to drive: one that can be followed, or config::Error.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "sightline/simulation/path.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sightline;
  const std::string text(reinterpret_cast<const char*>(data), size);
  try {
    const simulation::Path path(config::Node::parse(text, "fuzz"));
    simulation::PathFollower follower(path, 0.5);
    for (const geometry::Pose2& pose : {geometry::Pose2(), geometry::Pose2(1.0, 2.0, 3.0)}) {
      const simulation::Velocity wanted = follower.steer(pose);
      if (!(std::abs(wanted.linear) <= path.speed)) std::abort();
      if (!(std::abs(wanted.angular) <= path.turn_rate)) std::abort();
    }
  } catch (const config::Error&) {
  }
  return 0;
}
