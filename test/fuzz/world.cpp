// Any text that names no other files, read as a world: one whose rays end somewhere, or
// config::Error.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "sightline/world/world.h"

namespace {

void look(const sightline::world::World& world, const Eigen::Vector3d& direction) {
  const auto hit = world.cast({{0.3, -0.2, 0.5}, direction});
  if (!hit) return;
  const bool is_sound = hit->range > 0.0 && std::isfinite(hit->range) &&
                        hit->material < world.materials().size() && hit->cos_incidence >= 0.0 &&
                        hit->cos_incidence <= 1.0 + 1e-9;
  if (!is_sound || (hit->segment && *hit->segment >= world.segments().size())) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sightline;
  const std::string text(reinterpret_cast<const char*>(data), size);
  if (text.find("include") != std::string::npos || text.find("rooms") != std::string::npos) {
    return 0;
  }
  try {
    const world::World world(config::Node::parse(text, "fuzz"));
    look(world, Eigen::Vector3d::UnitX());
    look(world, Eigen::Vector3d(0.6, 0.0, -0.8));
    look(world, Eigen::Vector3d(-0.48, 0.64, 0.6));
    look(world, -Eigen::Vector3d::UnitZ());
  } catch (const config::Error&) {
  }
  return 0;
}
