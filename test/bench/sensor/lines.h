#pragma once

#include <cmath>
#include <optional>
#include <random>
#include <string>

#include <Eigen/Cholesky>

#include "bench/figures.h"
#include "sightline/geometry/statistics.h"
#include "sightline/lines/line_extractor.h"
#include "sightline/simulation/active_sensor.h"
#include "sightline/triangulation/calibration_writer.h"
#include "sightline/triangulation/parameter_estimation.h"

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

/// Encoder of the head, where it is coarse: standard deviation of each beam's angle.
constexpr double kHeadJitter = geometry::radians(0.36);

/// Takes one scan after another of a wall.
class WallScans {
 public:
  WallScans(const simulation::ActiveSensorProfile& profile, const WallView& view)
      : WallScans(profile, view, profile.calibrated()) {}
  /// With a calibration that is not perfect.
  WallScans(const simulation::ActiveSensorProfile& profile, const WallView& view,
            const triangulation::Calibration& calibration)
      : profile_(profile), view_(view), ranger_(calibration), world_(whiteWall(view)) {}

  triangulation::RawScan take(std::uint64_t seed) const {
    simulation::ActiveSensor sensor(profile_, seed);
    if (view_.rate != 0.0) sensor.command({motion::HeadCommand::Mode::kRate, 0.0, view_.rate});
    const Eigen::Isometry3d T_map_mount(Eigen::Translation3d(0.0, 0.0, 1.0));
    const auto two_scans = static_cast<std::int64_t>(2e9 * profile_.sensor.scan.scanPeriod());
    return sensor.advance(world_, two_scans, [&](std::int64_t) { return T_map_mount; }).back();
  }
  scan::Scan range(const triangulation::RawScan& raw) const { return ranger_.range(raw).scan; }
  Eigen::Vector2d origin() const { return ranger_.calibration().parameters.origin.position(); }

  /// Squared error of the scan's only line in standard deviations.
  std::optional<double> nees(const scan::Scan& scan, double head_angle) {
    const auto& segments = extractor_.extract(scan);
    if (segments.size() != 1) return std::nullopt;
    const geometry::Pose2 T_mount_projection =
        geometry::Pose2(0.0, 0.0, head_angle) * geometry::Pose2(origin(), 0.0);
    const auto line = geometry::transform(T_mount_projection, segments[0].line);
    const Eigen::Vector2d error =
        geometry::difference(line, {view_.rho, view_.phi, Eigen::Matrix2d::Zero()});
    return error.dot(line.covariance.ldlt().solve(error));
  }

 private:
  const simulation::ActiveSensorProfile& profile_;
  const WallView& view_;
  triangulation::Ranger ranger_;
  world::World world_;
  lines::LineExtractor extractor_;
};

/// NEES of those that are there, their mean and how many are within the gate of 95 %.
struct NeesSum {
  double sum = 0.0;
  int lines = 0;
  int inside = 0;

  void add(const std::optional<double>& nees) {
    if (!nees) return;
    sum += *nees;
    ++lines;
    if (*nees <= geometry::kChiSquare95Of2) ++inside;
  }
};

/// Mean NEES (of 2) over 300 seeds of the lines in single scans; a scan with no or with several of
/// them counts apart.
inline void lineConsistency(const simulation::ActiveSensorProfile& profile) {
  for (const WallView& view : kWallViews) {
    WallScans scans(profile, view);
    NeesSum nees;
    for (std::uint64_t seed = 1; seed <= 300; ++seed) {
      const auto raw = scans.take(seed);
      nees.add(scans.nees(scans.range(raw), raw.head_angles[0]));
    }
    print(std::string("sensor.lines.") + view.name + ".nees", nees.sum / nees.lines, "of_2");
    std::printf("# sensor.lines.%s: %d of 300 scans have one line\n", view.name, nees.lines);
  }
}

/// The same where each beam's head angle is read with an error of its own, which the scan says.
inline void jitterConsistency(const simulation::ActiveSensorProfile& profile) {
  for (const WallView& view : kWallViews) {
    if (view.rate == 0.0) continue;
    WallScans scans(profile, view);
    NeesSum nees, ignored;
    for (std::uint64_t seed = 1; seed <= 1000; ++seed) {
      auto raw = scans.take(seed);
      std::mt19937_64 random(seed);
      std::normal_distribution<double> error(0.0, kHeadJitter);
      for (double& angle : raw.head_angles) angle += error(random);
      scan::Scan scan = scans.range(raw);
      ignored.add(scans.nees(scan, raw.head_angles[0]));
      scan.motion_noise.jitter = kHeadJitter * kHeadJitter;
      scan.motion_noise.jitter_axis = -scans.origin();
      nees.add(scans.nees(scan, raw.head_angles[0]));
    }
    const std::string name = std::string("sensor.lines.") + view.name + "_jitter.";
    print(name + "nees", nees.sum / nees.lines, "of_2");
    print(name + "inside", 100.0 * nees.inside / nees.lines, "%");
    print(name + "nees_ignored", ignored.sum / ignored.lines, "of_2");
    std::printf("# %s %d of 1000 scans have one line\n", name.c_str(), nees.lines);
  }
}

/// Calibration of a sensor as its own rig records it.
inline triangulation::Calibration calibratedByRig(const simulation::ActiveSensorProfile& profile,
                                                  std::uint64_t seed) {
  const auto recording =
      simulation::recordCalibration(profile.sensor, profile.optics, profile.rig, seed);
  const auto estimate =
      triangulation::estimateParameters(recording, profile.sensor, profile.optics.beam_width);
  triangulation::Calibration calibration{
      profile.sensor, triangulation::tableOf(recording, profile.sensor.scan, "rig")};
  calibration.parameters.intrinsics = estimate.intrinsics;
  calibration.parameters.origin = estimate.origin;
  return calibration;
}

/// Lines of a sensor that a rig has calibrated, with the detector's bandwidth on: neighbours share
/// some of their light and noise. Ten rigs, every wall, 30 scans each.
inline void calibratedConsistency(simulation::ActiveSensorProfile profile) {
  profile.bandwidth = profile.sensor.scan.bandwidth = 1000.0;  // Hz, pears table 1
  NeesSum all;
  for (std::uint64_t rig = 1; rig <= 10; ++rig) {
    const auto calibration = calibratedByRig(profile, rig);
    for (const WallView& view : kWallViews) {
      WallScans scans(profile, view, calibration);
      NeesSum nees;
      for (std::uint64_t seed = 1; seed <= 30; ++seed) {
        const auto raw = scans.take(1000 * rig + seed);
        const auto found = scans.nees(scans.range(raw), raw.head_angles[0]);
        nees.add(found);
        all.add(found);
      }
      if (rig > 2) continue;
      std::printf("# sensor.lines: rig %d, %s: NEES %.2f\n", static_cast<int>(rig), view.name,
                  nees.sum / nees.lines);
    }
  }
  print("sensor.lines.nees", all.sum / all.lines, "of_2");
  print("sensor.lines.in_gate", 100.0 * all.inside / all.lines, "%");
}

}  // namespace sightline::bench
