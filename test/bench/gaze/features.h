#pragma once

#include "bench/gaze/feature_score.h"
#include "simulated_drive.h"

namespace sightline::bench {

/// A room with boxes, a bay and a pillar, in which somebody walks and something is pushed.
inline const char* const kFeatureWorld = R"(
segments:
  - {from: [0, 0], to: [7, 0]}
  - {from: [7, 0], to: [7, 3]}
  - {from: [7, 3], to: [8, 3]}
  - {from: [8, 3], to: [8, 5]}
  - {from: [8, 5], to: [0, 5]}
  - {from: [0, 5], to: [0, 0]}
boxes:
  - {centre: [2.0, 3.6], size: [1.0, 0.6], yaw: 0.3}
  - {centre: [5.2, 1.0], size: [0.8, 0.8], yaw: 0.0}
  - {centre: [5.5, 4.2], size: [1.2, 0.5], yaw: -0.2}
discs:
  - {centre: [3.6, 2.6], radius: 0.2}
)";
inline const char* const kFeaturePath =
    "{speed: 0.5, turn_rate: 1.0, tolerance: 0.2, repeat: true,"
    " waypoints: [[3, 1.2], [4.2, 2.2], [6.4, 2.4], [6.6, 3.6], [4.4, 3.4], [3, 4.2], [1, 2.4]]}";

struct FeatureScenario {
  const char* name;
  bool box = false;
  bool person = false;
  bool plain_settings = false;  // nothing is known of the wheels
};

inline simulation::Path pathOf(const char* text) {
  return simulation::Path(config::Node::parse(text, "path"));
}

inline void addMovers(const FeatureScenario& scenario, simulation::Simulation& simulation) {
  if (scenario.box) {  // its face, pushed along
    simulation::Body face;
    face.radius = 0.0;
    face.width = 0.6;
    simulation.addMover(face,
                        pathOf("{speed: 0.3, turn_rate: 0.5, repeat: true, waypoints: [[4.2, 0.6], "
                               "[1.0, 0.6]]}"),
                        {2.0, 0.6, 0.0});
  }
  if (scenario.person) {
    simulation::Body person;
    person.radius = 0.2;
    simulation.addMover(person,
                        pathOf("{speed: 1.2, turn_rate: 1.0, repeat: true, waypoints: [[3.0, 4.4], "
                               "[1.0, 4.4], [0.7, 1.0], [4.0, 1.8]]}"),
                        {4.4, 4.4, 3.0});
  }
}

inline FeatureScore featuresOf(const FeatureScenario& scenario, std::uint64_t seed) {
  const world::World world(config::Node::parse(kFeatureWorld, "world"));
  simulation::RobotConfig robot;
  pipeline::EstimatorsConfig config;
  config.input.feed.noise = {scan::NoiseKind::kConstant};
  if (!scenario.plain_settings) {
    config.features.odometry = robot.odometry;
    config.input.feed.sweep_noise = robot.odometry;
  }
  test::SimulatedDrive drive(world, robot, {1.0 + 0.05 * static_cast<double>(seed % 7), 1.2, 0.0},
                             seed, config, {true, false, false, true});
  simulation::ScannerProfile profile;
  profile.rate = 10.0;
  drive.addScanner(profile);
  addMovers(scenario, drive.simulation());
  drive.carrier().follow(pathOf(kFeaturePath));
  FeatureScore score(world);
  drive.run(60.0, [&](const pipeline::Estimates& estimates, const geometry::Pose2& T_map_base) {
    score.add(estimates, T_map_base);
  });
  return score;
}

inline void features(const FeatureScenario& scenario, std::uint64_t seeds) {
  FeatureScore all = featuresOf(scenario, 1);
  for (std::uint64_t seed = 2; seed <= seeds; ++seed) all.add(featuresOf(scenario, seed));
  const std::string name = std::string("gaze.features.") + scenario.name;
  print(name + ".nees", all.nees(), "of_2");
  print(name + ".in_gate", all.inGate(), "%");
  print(name + ".id_changes", all.idChanges(10.0), "1/min");
  print(name + ".static_recall", all.recall(), "%");
  print(name + ".static_precision", all.precision(), "%");
}

}  // namespace sightline::bench
