#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>

#include "scripted_transforms.h"
#include "sightline/geometry/isometry.h"
#include "sightline/pipeline/estimators.h"
#include "sightline/pipeline/scan_feed.h"
#include "sightline/simulation/simulation.h"

namespace sightline::test {

/// A simulated robot with one sensor, through the feed and the estimators as in a node.
class SimulatedDrive {
 public:
  using OnScan = std::function<void(const pipeline::Estimates&, const geometry::Pose2& T_map_base)>;

  SimulatedDrive(world::World world, const simulation::RobotConfig& robot,
                 const geometry::Pose2& start, std::uint64_t seed,
                 const pipeline::EstimatorsConfig& config, const pipeline::EstimatorSet& set)
      : simulation_(std::move(world), robot, start, seed),
        feed_(config.input.feed, {}, {}, transforms_),
        estimators_(config, set) {
    feed_.addScanner();
  }

  simulation::Simulation& simulation() { return simulation_; }
  simulation::Carrier& carrier() { return simulation_.carrier(); }
  pipeline::Estimators& estimators() { return estimators_; }
  double time() const { return 1e-9 * static_cast<double>(simulation_.time()); }

  void addScanner(const simulation::ScannerProfile& profile,
                  const simulation::Mounting& mounting = {}) {
    carrier().addScanner(profile, mounting);
    transforms_.mount("laser", mounting.T_base_sensor());
  }
  void addTurret(const simulation::ScannerProfile& profile, const simulation::Mounting& mounting,
                 const motion::HeadLimits& limits) {
    carrier().addScanner(profile, mounting, limits);
    has_turret_ = true;
    tellTurret();
  }
  void addActiveSensor(const simulation::ActiveSensorProfile& profile,
                       const simulation::Mounting& mounting = {}) {
    carrier().addActiveSensor(profile, mounting);
    transforms_.mount("active_sensor", mounting.T_base_sensor());
  }
  /// Changes what an active sensor reports, before anybody sees it.
  void edit(std::function<void(motion::RangeScan&)> edit) { edit_ = std::move(edit); }

  /// Hears what the robot reports besides its scans.
  void listen(std::function<void(const simulation::Outputs&)> on_outputs) {
    on_outputs_ = std::move(on_outputs);
  }

  /// Moves on by one step of the simulation.
  void step(const OnScan& on_scan) {
    simulation::Outputs outputs = simulation_.step();
    truth_.add(simulation_.time(), simulation_.robot().T_map_base());
    for (const auto& state : outputs.states) transforms_.drive(state.stamp, state.pose.mean);
    if (has_turret_) tellTurret();
    if (on_outputs_) on_outputs_(outputs);
    for (auto& finished : outputs.sweeps) {
      finished.scan.frame = "laser";
      feed_.add(0, std::move(finished.scan), simulation_.time());
    }
    for (auto& finished : outputs.range_scans) take(finished.range_scan);
    while (auto result = feed_.next(simulation_.time())) {
      if (!result->located) continue;
      const auto estimates = estimators_.take(std::move(*result->located));
      on_scan(estimates, *truth_.at(result->stamp));
    }
  }
  void run(double seconds, const OnScan& on_scan) {
    while (time() < seconds) step(on_scan);
  }

 private:
  void tellTurret() {
    const std::int64_t now = simulation_.time();
    transforms_.turret("laser", now, geometry::inPlane(carrier().T_base_sensor(0, now)));
  }
  void take(motion::RangeScan& scan) {
    scan.scan.frame = "projection";
    scan.head.mount_frame = "active_sensor";
    if (edit_) edit_(scan);
    feed_.add(0, std::move(scan), simulation_.time());
  }

  simulation::Simulation simulation_;
  bool has_turret_ = false;
  ScriptedTransforms transforms_;
  pipeline::ScanFeed feed_;
  pipeline::Estimators estimators_;
  motion::PoseHistory truth_;
  std::function<void(motion::RangeScan&)> edit_;
  std::function<void(const simulation::Outputs&)> on_outputs_;
};

}  // namespace sightline::test
