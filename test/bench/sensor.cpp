// The triangulation sensor: its noise against the paper's, its calibration, lines of its scans,
// speed of its simulation. All is simulated. Ranges and lines are those of a sensor whose
// calibration is exact and whose detector has no limit of bandwidth; the head's angles are exact
// but for the figures of jitter.
#include <chrono>
#include <cmath>
#include <filesystem>

#include "bench/sensor/calibration.h"
#include "bench/sensor/edge.h"
#include "bench/sensor/lines.h"
#include "bench/sensor/table2.h"
#include "sightline/simulation/active_sensor.h"

namespace sightline::bench {
namespace {

// 50 walls all round, of which any beam may meet any.
world::World fiftySegments() {
  world::World world;
  const auto corner = [](int i) -> Eigen::Vector2d {
    const double angle = 2.0 * geometry::kPi * i / 50.0;
    return 1.8 * Eigen::Vector2d(std::cos(angle), std::sin(angle));
  };
  for (int i = 0; i < 50; ++i) {
    world.add(world::WorldSegment{{corner(i), corner((i + 1) % 50)}, 0.0, 2.5, 0});
  }
  return world;
}

// Light, noise and ranges, on one core.
void speed(const simulation::ActiveSensorProfile& profile) {
  const world::World world = fiftySegments();
  const triangulation::Ranger ranger(profile.calibrated());
  const Eigen::Isometry3d T_map_mount(Eigen::Translation3d(0.0, 0.0, 1.0));
  std::vector<double> factors;
  for (std::uint64_t seed = 1; seed <= 9; ++seed) {
    simulation::ActiveSensor sensor(profile, seed);
    const auto began = std::chrono::steady_clock::now();
    const auto scans =
        sensor.advance(world, 5'000'000'000, [&](std::int64_t) { return T_map_mount; });
    for (const auto& raw : scans) ranger.range(raw);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - began;
    factors.push_back(5.0 / took.count());
  }
  print("sensor.simulation.realtime_factor", median(factors), "1");
}

}  // namespace
}  // namespace sightline::bench

int main(int, char** argv) {
  using namespace sightline;
  const auto profile = simulation::ActiveSensorProfile::readFile(
      SIGHTLINE_SOURCE_DIR "/config/sensors/synchronised_scan.yaml");
  bench::table2(profile);
  bench::calibration();
  bench::edges(profile);
  bench::lineConsistency(profile);
  bench::jitterConsistency(profile);
  bench::calibratedConsistency(profile);
  bench::drawSegmentsAgainstGate(
      profile,
      std::filesystem::path(argv[0]).replace_filename("segments_against_gate.png").string());
  bench::speed(profile);
  return 0;
}
