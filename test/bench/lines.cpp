// Line extraction: accuracy, covariance, completeness and time in a room with two boxes where the
// truth is known, beside the floor that an oracle reaches who knows which beam hit which wall; and
// what is explained of a real recording.
#include <chrono>
#include <cstdlib>
#include <string>

#include "allocations.h"
#include "lines/door.h"
#include "lines/motion.h"
#include "lines/recording.h"
#include "lines/round_things.h"
#include "lines/score.h"
#include "lines/view.h"
#include "lines/world.h"
#include "live_node.h"
#include "sightline/LineSegmentArray.h"
#include "sightline/bridge/scan_conversion.h"
#include "sightline/lines/line_extractor.h"

namespace sightline::bench {
namespace {

constexpr int kPoses = 1000;

lines::LineExtractorConfig settings() {
  lines::LineExtractorConfig config;
  config.min_length = 0.5;
  config.min_beams = 10;
  return config;
}

template <class Action>
double microseconds(Action action) {
  const auto begin = std::chrono::steady_clock::now();
  action();
  const auto end = std::chrono::steady_clock::now();
  return std::chrono::duration<double, std::micro>(end - begin).count();
}

/// The yardstick of the times: the same scan turned into x and y with the library's functions.
double convert(const scan::Scan& scan) {
  static std::vector<double> x(4096), y(4096);
  const auto& angles = scan.geometry()->angles();
  const double time = microseconds([&] {
    for (std::size_t i = 0; i < scan.beams(); ++i) {
      x[i] = scan.ranges()[i] * std::cos(angles[i]);
      y[i] = scan.ranges()[i] * std::sin(angles[i]);
    }
  });
  // Or the optimiser would leave the work out.
  asm volatile("" : : "r"(x.data()), "r"(y.data()) : "memory");
  return time;
}

using WorldAt = PlaneWorld (*)(const geometry::Pose2& pose, std::mt19937& random);
PlaneWorld plainRoom(const geometry::Pose2&, std::mt19937&) {
  return roomWithBoxes();
}
PlaneWorld doorRoom(const geometry::Pose2&, std::mt19937&) {
  return roomWithDoor();
}

/// Once for all scenarios: what is allocated by scans after the first.
std::size_t allocated = 0;

Score run(const std::string& name, const Sensor& sensor, WorldAt world_at) {
  lines::LineExtractor extractor(settings());
  std::mt19937 random(2026);
  Score score;
  DoorScore door;
  RoundScore legs;
  for (int i = 0; i < kPoses; ++i) {
    const geometry::Pose2 pose = randomPose(random);
    const PlaneWorld world = world_at(pose, random);
    const View view = Viewer(world, sensor, pose).view(random);
    const std::size_t before = allocations;
    extractor.extract(view.scan);
    if (i > 0) allocated += allocations - before;
    score.microseconds.push_back(microseconds([&] { extractor.extract(view.scan); }));
    score.conversion.push_back(convert(view.scan));
    const auto& segments = extractor.extract(view.scan);
    const std::vector<int> matched = score.add(view, segments);
    if (world_at == doorRoom) door.add(view, pose, segments, matched);
    legs.add(view, world, pose, extractor.arcs());
  }
  score.printFigures(name);
  if (world_at == doorRoom) door.printFigures(name);
  if (world_at == roomWithLegs) legs.printFigures(name);
  return score;
}

/// A wall of three metres, from x = `from` on and `distance` ahead of a sensor at the origin.
void runSingleWall(const std::string& name, double from, double distance) {
  PlaneWorld world;
  world.walls.push_back({{from + 3.0, distance}, {from, distance}});
  lines::LineExtractor extractor(settings());
  std::mt19937 random(7);
  Score score;
  for (int i = 0; i < 4 * kPoses; ++i) {
    const geometry::Pose2 pose(0.0, 0.0, 0.5 * geometry::kPi);
    const View view = Viewer(world, {361, geometry::kPi, 0.01}, pose).view(random);
    score.add(view, extractor.extract(view.scan));
  }
  print("lines." + name + ".found", score.foundPercent(), "%");
  print("lines." + name + ".in_gate", score.errors.share(), "%");
  print("lines." + name + ".nees", score.errors.meanNees(), "1");
}

void runRecording() {
  const char* const data = std::getenv("SIGHTLINE_DATA");
  if (!data) {
    std::printf("# lines.two_hokuyos: SIGHTLINE_DATA does not say where the recording is\n");
    return;
  }
  scan::NoiseModel unknown;
  unknown.kind = scan::NoiseKind::kEstimated;
  lines::LineExtractor extractor(settings());
  Explained explained;
  std::vector<double> times;
  for (const auto& scan :
       readScans(std::string(data) + "/two_hokuyos.bag", "/front_scan", unknown)) {
    times.push_back(microseconds([&] { extractor.extract(scan); }));
    explained.add(scan, extractor.extract(scan), extractor.arcs());
  }
  explained.printFigures("lines.two_hokuyos.");
  print("lines.two_hokuyos.us_median", median(times), "us");
}

void runNode() {
  std::mt19937 random(11);
  const PlaneWorld world = roomWithBoxes();
  std::vector<sensor_msgs::LaserScan> messages;
  for (int i = 0; i < 40; ++i) {
    const View view = Viewer(world, Sensor(), randomPose(random)).view(random);
    messages.push_back(bridge::toMessage(view.scan));
  }
  const NodeLoad load = measureNode<sensor_msgs::LaserScan, LineSegmentArray>(
      {std::string(SIGHTLINE_PROGRAMS) + "/line_extractor"}, "scan", "lines", messages, 40.0, 20.0);
  print("lines.node.answered", 100.0 * static_cast<double>(load.latencies_ms.size()) / 800.0, "%");
  print("lines.node.latency_median_ms", median(load.latencies_ms), "ms");
  print("lines.node.latency_p99_ms", quantile(load.latencies_ms, 0.99), "ms");
  print("lines.node.cpu_percent", load.cpu_percent, "%");
}

}  // namespace
}  // namespace sightline::bench

int main() {
  using namespace sightline::bench;
  const double half_turn = sightline::geometry::kPi;
  const double whole_turn = 2.0 * half_turn;
  const double wide = 1.5 * half_turn;
  run("361_s1", {361, half_turn, 0.01}, plainRoom);
  run("361_s3", {361, half_turn, 0.03}, plainRoom);
  const Score standing = run("1081_s1", {1081, wide, 0.01}, plainRoom);
  run("1081_s3", {1081, wide, 0.03}, plainRoom);
  run("1081_s1_invalid5", {1081, wide, 0.01, 0.05}, plainRoom);
  run("1081_s1_door", {1081, wide, 0.01}, doorRoom);
  run("1081_s1_legs8", {1081, wide, 0.01}, roomWithLegs);
  run("720_wrap_s1", {720, whole_turn, 0.01}, plainRoom);
  const Score moving = run("1081_s1_moving", {1081, wide, 0.01, 0.0, 0.075}, plainRoom);
  print("lines.1081_s1_moving.rho_over_standing",
        median(moving.errors.rho_mm) / median(standing.errors.rho_mm), "1");
  print("lines.1081_s1_moving.phi_over_standing",
        median(moving.errors.phi_mrad) / median(standing.errors.phi_mrad), "1");
  print("lines.allocations", static_cast<double>(allocated), "1");
  runSingleWall("wall_facing", -1.5, 2.0);
  runSingleWall("wall_aside", 0.0, 2.0);
  runSingleWall("wall_oblique", 2.0, 1.5);
  motionConsistency();
  runRecording();
  runNode();
  return 0;
}
