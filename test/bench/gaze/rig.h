#pragma once

#include <memory>

#include "sightline/gaze/gaze_control.h"
#include "simulated_drive.h"

namespace sightline::bench {

inline simulation::ActiveSensorProfile activeSensor() {
  return simulation::ActiveSensorProfile::readFile(SIGHTLINE_SOURCE_DIR
                                                   "/config/sensors/synchronised_scan.yaml");
}

/// Head angles as the sensor of the paper tells them: steps of 0.36° (table 1), and noise of half
/// a step.
inline void coarsenHead(motion::RangeScan& scan, std::mt19937_64& random) {
  constexpr double kStep = geometry::radians(0.36);
  std::normal_distribution<double> error(0.0, 0.5 * kStep);
  for (double& angle : scan.head.angles) {
    angle = kStep * std::round((angle + error(random)) / kStep);
  }
}

/// A robot with the active sensor of the paper, whose head the gaze turns as the node does: by
/// odometry at 50 Hz, features and poses as they are found.
class GazeRig {
 public:
  GazeRig(test::SimulatedDrive& drive, const gaze::GazeConfig& config, std::uint64_t seed)
      : drive_(drive), gaze_(config), random_(seed) {
    simulation::Mounting mounting;
    mounting.x = 0.1;
    mounting.z = 0.4;
    drive.addActiveSensor(activeSensor(), mounting);
    drive.edit([this](motion::RangeScan& scan) { coarsenHead(scan, random_); });
    drive.listen([this](const simulation::Outputs& outputs) { hear(outputs); });
    gaze_.setMounting(T_base_mount_);
  }

  gaze::GazeControl& gaze() { return gaze_; }
  const geometry::Pose2& T_base_mount() const { return T_base_mount_; }

  void step(const test::SimulatedDrive::OnScan& on_scan) {
    drive_.step([&](const pipeline::Estimates& estimates, const geometry::Pose2& T_map_base) {
      tell(estimates);
      on_scan(estimates, T_map_base);
    });
    const std::int64_t now = drive_.simulation().time();
    if (now % 20'000'000 != 0) return;
    if (const auto command = gaze_.decide(now)) drive_.carrier().commandHead(0, *command);
  }
  void run(double seconds, const test::SimulatedDrive::OnScan& on_scan) {
    while (drive_.time() < seconds) step(on_scan);
  }

 private:
  void hear(const simulation::Outputs& outputs) {
    for (const auto& state : outputs.states) gaze_.takeOdometry(state.stamp, state.pose.mean);
    for (const auto& head : outputs.heads) gaze_.takeHead(head.stamp, head.angle);
  }
  gaze::SensorField fieldOf(const scan::Scan& scan) const {
    gaze::SensorField field = gaze_.config().field;
    const auto& angles = scan.geometry()->angles();
    field.centre = 0.5 * (angles.front() + angles.back());
    field.half_width = 0.5 * std::abs(angles.back() - angles.front());
    return field;
  }
  void tell(const pipeline::Estimates& estimates) {
    const std::int64_t stamp = estimates.located.scan.stamp;
    gaze_.setField(fieldOf(estimates.located.scan));
    if (estimates.features) gaze_.takeFeatures(stamp, *estimates.features);
    if (estimates.located.T_base_sensor) {
      gaze_.takeScan(estimates.located.scan,
                     T_base_mount_.inverse() * *estimates.located.T_base_sensor);
    }
    if (estimates.rooms) gaze_.takePose(stamp, estimates.rooms->pose);
  }

  test::SimulatedDrive& drive_;
  gaze::GazeControl gaze_;
  std::mt19937_64 random_;
  geometry::Pose2 T_base_mount_{0.1, 0.0, 0.0};
};

}  // namespace sightline::bench
