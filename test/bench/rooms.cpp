// Figures of the room tracker, one a line: `name value unit`; lines that start with # explain.
//
// rooms.two_rooms.<scenario>.*: two rooms of 8x6 and 5x6 m joined by a door of 0.9 m, 120 s at 0.4
// m/s, 361 beams over 180° at 10 Hz to 8 m with 1 cm of noise (utm30lx: the profile of that name),
// odometry 2 % short with drift on top, errors of the pose at every scan. The tracker is told the
// true noise of these wheels, and that the map is exact. rooms.fr079.*: the Freiburg log against
// its hand-verified relations, on a map that was drawn over the scans of the same log.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <Eigen/LU>

#include "rooms/freiburg.h"
#include "scripted_transforms.h"
#include "sightline/geometry/angle.h"
#include "sightline/geometry/statistics.h"
#include "sightline/motion/pose_history.h"
#include "sightline/pipeline/scan_feed.h"
#include "sightline/scan/noise_model.h"
#include "sightline/simulation/simulation.h"
#include "sightline/tracking/room_tracker.h"

namespace {

using namespace sightline;
using geometry::Pose2;

constexpr int kRuns = 10;
constexpr double kSeconds = 120.0;

const char* const kRooms = R"(
rooms:
  east: {size: [5.0, 6.0], pose: [6.6, 0.0, 0.0]}
  west: {size: [8.0, 6.0], pose: [0.0, 0.0, 0.0]}
doors:
  - {between: [west, east], at: [4.05, 0.5], width: 0.9}
)";

const char* const kPath = R"(
speed: 0.4
turn_rate: 0.8
tolerance: 0.2
waypoints: [[-2, -2], [2, -2], [2, 0.5], [6, 0.5], [8, 2], [8, -2], [6, -2], [5, 0.5], [2, 0.5], [2, 2], [-3, 2],
            [-3, -2], [2, -2], [2, 0.5], [6, 0.5], [8, 2], [8, -2], [6, -2], [5, 0.5], [2, 0.5], [-3, 2]]
)";

struct Scenario {
  std::string name;
  double clutter = 0.0;          // share of the beams that something nearer stops
  double unreported_turn = 0.0;  // of the robot at half time [rad]
  bool utm30lx = false;          // 1081 beams over 270° at 40 Hz instead
};

struct Sample {
  double position_error = 0.0;  // m
  double heading_error = 0.0;   // rad
  double nees = 0.0;            // of x, y and heading
  double microseconds = 0.0;
};

world::RoomMap twoRooms() {
  return world::RoomMap(config::Node::parse(kRooms, "two rooms"));
}

simulation::ScannerProfile scannerProfile(const Scenario& scenario) {
  simulation::ScannerProfile profile;
  if (scenario.utm30lx) return profile;
  profile.beams = 361;
  profile.angle_min = -0.5 * geometry::kPi;
  profile.angle_max = 0.5 * geometry::kPi;
  profile.range_max = 8.0;
  profile.rate = 10.0;
  profile.noise.sigma = 0.01;
  return profile;
}

simulation::RobotConfig robotConfig() {
  simulation::RobotConfig config;
  config.odometry.scale_mean = 1.02;
  config.odometry.scale_sigma = 0.0;
  config.odometry.heading_bias_per_metre = 0.0;
  config.odometry.steering_bias = 0.0;
  config.odometry.steering_sigma = 0.01;
  return config;
}

tracking::TrackerConfig trackerConfig() {
  tracking::TrackerConfig config;
  // The map of this world is exact, and the errors of the wheels are known but for the scale.
  config.odometry = robotConfig().odometry;
  config.odometry.scale_mean = 1.0;
  config.odometry.scale_sigma = 0.02;
  config.wall.position_sigma = 0.0;
  config.wall.direction_sigma = 0.0;
  return config;
}

void addClutter(double share, std::mt19937_64& random, scan::Scan& scan) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (std::size_t i = 0; i < scan.beams(); ++i) {
    if (unit(random) >= share) continue;
    const double reach = scan.isValid(i) ? scan.ranges()[i] : scan.geometry()->rangeMax();
    scan.setRange(i, 0.3 + (reach - 0.3) * unit(random));
  }
}

class Run {
 public:
  Run(const Scenario& scenario, std::uint64_t seed, const tracking::TrackerConfig& config)
      : scenario_(scenario),
        random_(seed),
        simulation_(world::World::of(twoRooms()), robotConfig(), start_, seed),
        feed_(feedConfig(config), {}, {}, transforms_),
        tracker_(config, twoRooms()) {
    transforms_.mount("", Pose2());
    feed_.addScanner();
    simulation_.carrier().addScanner(scannerProfile(scenario), {});
    simulation_.carrier().follow(simulation::Path(config::Node::parse(kPath, "path")));
    tracker_.setPose({start_, Eigen::Vector3d(0.01, 0.01, 0.0025).asDiagonal()});
  }

  std::vector<Sample> samples() {
    while (simulation_.time() < static_cast<std::int64_t>(kSeconds * 1e9)) {
      auto finished = simulation_.step().sweeps;
      truth_.add(simulation_.time(), simulation_.robot().T_map_base());
      transforms_.drive(simulation_.time(), slip() * simulation_.robot().odometry().pose().mean);
      for (auto& sweep : finished) take(sweep.scan);
      track();
    }
    return samples_;
  }

 private:
  // The wheels miss a turn on the spot: from then on the odometry is turned the other way about the
  // robot.
  Pose2 slip() {
    if (scenario_.unreported_turn == 0.0 ||
        simulation_.time() < static_cast<std::int64_t>(5e8 * kSeconds))
      return {};
    if (!slipped_) {
      const Pose2 here = simulation_.robot().odometry().pose().mean;
      T_slip_ = here * Pose2(0.0, 0.0, -scenario_.unreported_turn) * here.inverse();
      slipped_ = true;
    }
    return T_slip_;
  }

  static pipeline::FeedConfig feedConfig(const tracking::TrackerConfig& config) {
    pipeline::FeedConfig feed;
    feed.noise.kind = scan::NoiseKind::kConstant;
    feed.sweep_noise = config.odometry;
    return feed;
  }

  void take(scan::Scan& scan) {
    addClutter(scenario_.clutter, random_, scan);
    feed_.add(0, std::move(scan), simulation_.time());
  }

  void track() {
    const auto begin = std::chrono::steady_clock::now();
    while (const auto result = feed_.next(simulation_.time())) {
      const auto& located = result->located;
      if (!located || !located->T_odom_base) continue;
      const auto update =
          tracker_.update(located->scan, *located->T_odom_base, *located->T_base_sensor);
      const std::chrono::duration<double, std::micro> spent =
          std::chrono::steady_clock::now() - begin;
      if (update) score(*update, *truth_.at(result->stamp), spent.count());
    }
  }

  void score(const tracking::TrackerUpdate& update, const Pose2& truth, double microseconds) {
    Eigen::Vector3d error = update.pose.mean.coordinates() - truth.coordinates();
    error[2] = geometry::wrapAngle(error[2]);
    samples_.push_back({error.head<2>().norm(), std::abs(error[2]),
                        error.dot(update.pose.covariance.inverse() * error), microseconds});
  }

  Scenario scenario_;
  Pose2 start_{-2.0, 1.0, -1.5};
  std::mt19937_64 random_;
  simulation::Simulation simulation_;
  test::ScriptedTransforms transforms_;
  pipeline::ScanFeed feed_;
  tracking::RoomTracker tracker_;
  motion::PoseHistory truth_;
  bool slipped_ = false;
  Pose2 T_slip_;
  std::vector<Sample> samples_;
};

double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

void print(const std::string& name, const std::vector<Sample>& samples) {
  std::vector<double> position;
  std::vector<double> nees;
  std::vector<double> time;
  double square = 0.0;
  double heading = 0.0;
  double nees_sum = 0.0;
  double inside = 0.0;
  for (const Sample& sample : samples) {
    position.push_back(sample.position_error);
    time.push_back(sample.microseconds);
    square += sample.position_error * sample.position_error;
    heading += sample.heading_error * sample.heading_error;
    nees_sum += sample.nees;
    inside += sample.nees <= geometry::kChiSquare95Of3 ? 1.0 : 0.0;
  }
  const auto count = static_cast<double>(samples.size());
  fmt::print("{}.rmse {:.4f} m\n", name, std::sqrt(square / count));
  fmt::print("{}.max {:.4f} m\n", name, quantile(position, 1.0));
  fmt::print("{}.heading_rmse {:.3f} deg\n", name, geometry::degrees(std::sqrt(heading / count)));
  fmt::print("{}.nees {:.2f} 1\n", name, nees_sum / count);
  fmt::print("{}.in_gate {:.1f} %\n", name, 100.0 * inside / count);
  fmt::print("{}.us_median {:.1f} us\n", name, quantile(time, 0.5));
  fmt::print("{}.us_p99 {:.1f} us\n", name, quantile(time, 0.99));
}

void benchmark(const Scenario& scenario, const std::string& variant,
               const tracking::TrackerConfig& config) {
  std::vector<Sample> samples;
  for (int run = 0; run < kRuns; ++run) {
    const auto of_run = Run(scenario, static_cast<std::uint64_t>(run + 1), config).samples();
    samples.insert(samples.end(), of_run.begin(), of_run.end());
  }
  print("rooms.two_rooms." + scenario.name + variant, samples);
}

}  // namespace

int main() {
  auto plain = trackerConfig();
  plain.method = tracking::Method::kPlain;
  const Scenario clean{"clean", 0.0, 0.0};
  benchmark(clean, "", trackerConfig());
  benchmark(clean, "_plain", plain);
  benchmark({"clutter50", 0.5, 0.0}, "", trackerConfig());
  benchmark({"clutter70", 0.7, 0.0}, "", trackerConfig());
  benchmark({"utm30lx", 0.0, 0.0, true}, "", trackerConfig());
  benchmark({"turn46", 0.0, geometry::radians(46.0)}, "", trackerConfig());
  bench::printFreiburg();
  return 0;
}
