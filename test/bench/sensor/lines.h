#pragma once

#include <cmath>
#include <string>

#include <Eigen/Cholesky>

#include "bench/figures.h"
#include "sightline/lines/line_extractor.h"
#include "sightline/simulation/active_sensor.h"

namespace sightline::bench {

/// A wall in the mount's frame, and how fast the head turns while it is seen.
struct WallView {
  const char* name;
  double rho;   // [m]
  double phi;   // [rad]
  double rate;  // [rad/s]
};
/// The last wall leaves the sensor's range obliquely, where readings beyond it are cut off.
constexpr WallView kWallViews[] = {
    {"near", 0.8, 0.6, 0.0},         {"near_turning", 0.8, 0.6, 0.8},
    {"middle", 1.3, 0.0, 0.0},       {"middle_turning", 1.3, 0.0, 0.8},
    {"far", 2.2, 0.0, 0.0},          {"far_turning", 2.2, 0.0, 0.8},
    {"at_the_limit", 1.8, 0.6, 0.0},
};

inline world::World whiteWall(const WallView& view) {
  const Eigen::Vector2d normal(std::cos(view.phi), std::sin(view.phi));
  const Eigen::Vector2d along(-normal.y(), normal.x());
  world::World world;
  const std::size_t white = world.addMaterial({"white", 1.0});
  world.add(world::WorldSegment{
      {view.rho * normal + 4.0 * along, view.rho * normal - 4.0 * along}, 0.0, 2.0, white});
  return world;
}

/// Mean NEES (of 2) over 300 seeds of the lines in single scans; a scan with no or with several of
/// them counts apart.
inline void lineConsistency(const simulation::ActiveSensorProfile& profile) {
  const triangulation::Ranger ranger(profile.calibrated());
  const geometry::Pose2 T_head_projection(profile.sensor.origin.position(), 0.0);
  const Eigen::Isometry3d T_map_mount(Eigen::Translation3d(0.0, 0.0, 1.0));
  const auto two_scans = static_cast<std::int64_t>(2e9 * profile.sensor.scan.scanPeriod());
  for (const WallView& view : kWallViews) {
    const world::World world = whiteWall(view);
    const geometry::PolarLine wall{view.rho, view.phi, Eigen::Matrix2d::Zero()};
    double sum = 0.0;
    int lines = 0;
    for (std::uint64_t seed = 1; seed <= 300; ++seed) {
      simulation::ActiveSensor sensor(profile, seed);
      if (view.rate != 0.0) {
        sensor.command({motion::HeadCommand::Mode::kRate, 0.0, view.rate});
      }
      const auto raw =
          sensor.advance(world, two_scans, [&](std::int64_t) { return T_map_mount; }).back();
      lines::LineExtractor extractor;
      const auto& segments = extractor.extract(ranger.range(raw).scan);
      if (segments.size() != 1) continue;
      const geometry::Pose2 T_mount_head(0.0, 0.0, raw.head_angles[0]);
      const auto line = geometry::transform(T_mount_head * T_head_projection, segments[0].line);
      const Eigen::Vector2d error = geometry::difference(line, wall);
      sum += error.dot(line.covariance.ldlt().solve(error));
      ++lines;
    }
    print(std::string("sensor.lines.") + view.name + ".nees", sum / lines, "of_2");
    std::printf("# sensor.lines.%s: %d of 300 scans have one line\n", view.name, lines);
  }
}

}  // namespace sightline::bench
