#pragma once

#include "bench/figures.h"
#include "bench/gaze/features.h"
#include "bench/gaze/rig.h"
#include "sightline/lines/place_in_view.h"

namespace sightline::bench {

/// A box beside a wall, whose corner is looked at.
inline const char* const kCornerWorld = R"(
segments:
  - {from: [-3, 3.2], to: [7, 3.2]}
boxes:
  - {centre: [2.6, 1.5], size: [1.2, 1.0]}
)";
inline const Eigen::Vector2d kFixated{2.0, 1.0};

struct FixationCase {
  const char* name;
  double aside = 1.0;      // of the corner [m]
  double turn_rate = 0.0;  // of the robot, standing in front of the corner [rad/s]
  bool occluded = false;   // for two seconds, by somebody who walks by
};

struct FixationResult {
  double in_reach = 0.0;  // scans
  double in_view = 0.0;
  std::vector<double> reacquired;  // [s]
};

/// Drives past the corner, or turns before it, once the head has found it.
class FixationRun {
 public:
  FixationRun(const FixationCase& of, std::uint64_t seed)
      : case_(of),
        drive_(worldOf(), simulation::RobotConfig{}, startOf(of), seed, configOf(),
               {true, false, false, true}),
        rig_(drive_, {}, seed) {
    if (of.occluded) addPasserBy();
  }

  FixationResult result() {
    find();
    while (drive_.time() < end()) {
      command();
      rig_.step([&](const auto& estimates, const auto& T_map_base) {
        score(estimates, T_map_base);
        if (case_.occluded) time(estimates, T_map_base);
      });
    }
    return result_;
  }

 private:
  static world::World worldOf() { return world::World(config::Node::parse(kCornerWorld, "world")); }
  static pipeline::EstimatorsConfig configOf() {
    pipeline::EstimatorsConfig config;
    config.features.odometry = simulation::RobotConfig{}.odometry;
    config.input.feed.sweep_noise = config.features.odometry;
    config.input.feed.head_sigma = geometry::radians(0.36) * std::sqrt(0.25 + 1.0 / 12.0);
    return config;
  }
  static geometry::Pose2 startOf(const FixationCase& of) {
    if (of.turn_rate != 0.0) return {1.2, 1.0 - of.aside, 0.0};
    return {0.4, 1.0 - of.aside, 0.0};
  }
  double end() const { return case_.turn_rate != 0.0 ? kFound + 6.0 : kFound + 7.0; }

  // The head looks at where the corner is, and fixates what is found there.
  void find() {
    const geometry::Pose2 T_map_mount = startOf(case_) * rig_.T_base_mount();
    motion::HeadCommand look;
    look.mode = motion::HeadCommand::Mode::kPosition;
    look.position = rig_.gaze().config().field.aimAt(T_map_mount.inverse() * kFixated);
    drive_.carrier().commandHead(0, look);
    rig_.run(kFound, [](const auto&, const auto&) {});
    const geometry::Pose2 T_odom_map = drive_.simulation().robot().odometry().pose().mean *
                                       drive_.simulation().robot().T_map_base().inverse();
    is_found_ = rig_.gaze().fixateAt(T_odom_map * kFixated).success;
  }

  void command() {
    const double since = drive_.time() - kFound;
    if (case_.turn_rate == 0.0) {
      drive_.carrier().command({case_.occluded ? 0.1 : 0.5, 0.0});
    } else {
      // To and fro by 60° each way.
      const double phase = std::fmod(since * case_.turn_rate / geometry::radians(60.0) + 1.0, 4.0);
      drive_.carrier().command({0.0, phase < 2.0 ? case_.turn_rate : -case_.turn_rate});
    }
  }

  // Somebody whose way crosses that from the sensor to the corner.
  void addPasserBy() {
    simulation::Body body;
    body.radius = 0.35;
    body.top = 1.8;
    drive_.simulation().addMover(
        body, pathOf("{wait: 0.2, speed: 0.35, turn_rate: 1.0, waypoints: [[0.4, 1.75]]}"),
        {2.25, -0.7, std::atan2(2.45, -1.85)});
  }

  // Time from the first scan that has nothing nearer before the corner to the first that shows it.
  void time(const pipeline::Estimates& estimates, const geometry::Pose2& T_map_base) {
    const Eigen::Vector2d p_sensor =
        estimates.located.T_base_sensor->inverse() * (T_map_base.inverse() * kFixated);
    const double stamp = 1e-9 * static_cast<double>(estimates.located.scan.stamp);
    const auto view = lines::lookAt(p_sensor, 0.03, estimates.located.scan);
    if (view == lines::PlaceInView::kHidden) {
      ++hidden_scans_;
      free_since_.reset();
      return;
    }
    if (hidden_scans_ < 10) return;
    if (!free_since_) free_since_ = stamp;
    for (const auto& feature : *estimates.features) {
      if (feature.id != rig_.gaze().state().target || feature.unseen > 0.0) continue;
      result_.reacquired.push_back(stamp - *free_since_);
      hidden_scans_ = 0;
      free_since_.reset();
      return;
    }
  }

  void score(const pipeline::Estimates& estimates, const geometry::Pose2& T_map_base) {
    const scan::Scan& scan = estimates.located.scan;
    const Eigen::Vector2d p_mount = (T_map_base * rig_.T_base_mount()).inverse() * kFixated;
    const Eigen::Vector2d p_sensor =
        estimates.located.T_base_sensor->inverse() * (T_map_base.inverse() * kFixated);
    const auto seen = lines::beamTowards(p_sensor, scan);
    const gaze::SensorField& field = rig_.gaze().config().field;
    const double limit = geometry::radians(90.0);
    // Throughout the sweep: at its start, and now that it has ended.
    const Eigen::Vector2d p_mount_end =
        (drive_.simulation().robot().T_map_base() * rig_.T_base_mount()).inverse() * kFixated;
    for (const Eigen::Vector2d& place : {p_mount, p_mount_end}) {
      if (!field.holds(place, std::clamp(field.aimAt(place), -limit, limit))) return;
    }
    result_.in_reach += 1.0;
    if (seen.in_field && is_found_) result_.in_view += 1.0;
  }

  static constexpr double kFound = 2.0;
  FixationCase case_;
  test::SimulatedDrive drive_;
  GazeRig rig_;
  FixationResult result_;
  bool is_found_ = false;
  int hidden_scans_ = 0;
  std::optional<double> free_since_;  // nothing nearer since [s]
};

inline void reacquisition(std::uint64_t seeds) {
  std::vector<double> times;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    const auto result = FixationRun({"occluded", 1.0, 0.0, true}, seed).result();
    times.insert(times.end(), result.reacquired.begin(), result.reacquired.end());
  }
  std::printf("# gaze.fixation: found again %zu times in %zu runs\n", times.size(),
              static_cast<std::size_t>(seeds));
  print("gaze.fixation.reacquire_s", median(times), "s");
  print("gaze.fixation.reacquire_p95_s", quantile(times, 0.95), "s");
}

inline void fixation(std::uint64_t seeds) {
  FixationResult all;
  for (const FixationCase& of : {FixationCase{"aside_1.0", 1.0}, FixationCase{"aside_1.5", 1.5},
                                 FixationCase{"turning", 1.0, geometry::radians(60.0)}}) {
    FixationResult sum;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      const FixationResult result = FixationRun(of, seed).result();
      sum.in_reach += result.in_reach;
      sum.in_view += result.in_view;
    }
    print(std::string("gaze.fixation.") + of.name + ".in_view", 100.0 * sum.in_view / sum.in_reach,
          "%");
    std::printf("# gaze.fixation.%s: %.0f scans within reach\n", of.name, sum.in_reach);
    all.in_reach += sum.in_reach;
    all.in_view += sum.in_view;
  }
  print("gaze.fixation.in_view", 100.0 * all.in_view / all.in_reach, "%");
  reacquisition(seeds);
}

}  // namespace sightline::bench
