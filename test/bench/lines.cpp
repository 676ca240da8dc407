// Line extraction: accuracy, covariance, completeness and time in a room with two boxes where the
// truth is known, beside the floor that an oracle reaches who knows which beam hit which wall; and
// what is explained of a real recording.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "lines/cost.h"
#include "lines/known_walls.h"
#include "lines/motion.h"
#include "lines/recording.h"
#include "lines/scenario.h"
#include "lines/standing.h"
#include "live_node.h"
#include "sightline/LineSegmentArray.h"
#include "sightline/bridge/scan_conversion.h"
#include "sightline/lines/line_extractor.h"
#include "sightline/lines/plain_extractor.h"

namespace sightline::bench {
namespace {

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

/// Worlds and scanners unlike those above.
void otherWorlds() {
  const double wide = 1.5 * geometry::kPi;
  const double half_turn = geometry::kPi;
  Sensor with_outliers{1081, wide, 0.01};
  with_outliers.outlier_share = 0.05;
  Sensor proportional{1081, wide, 0.002};
  proportional.sigma_per_metre = 0.01;
  Sensor counts_5cm{361, half_turn, 0.01};
  counts_5cm.step = 0.05;
  Sensor counts_1cm{361, half_turn, 0.005};
  counts_1cm.step = 0.01;
  Sensor cheap{640, 2.0 * geometry::kPi, 0.02};
  cheap.sigma_per_metre = 0.01;
  cheap.angular_sigma = geometry::radians(0.1);
  Sensor turning{1081, wide, 0.01, 0.0, 0.1};
  turning.turn_rate = 3.0;
  run("office_s1", {1081, wide, 0.01}, office);
  run("office_s3", {1081, wide, 0.03}, office);
  run("corridor_s1", {1081, wide, 0.01}, corridor);
  run("hall_s1", {1081, wide, 0.01}, hall);
  run("obtuse_s1", {1081, wide, 0.01}, obtuseRoom);
  run("obtuse_s3", {1081, wide, 0.03}, obtuseRoom);
  boundOfObtuse("obtuse_s1", {1081, wide, 0.01}, kPoses);
  boundOfObtuse("obtuse_s3", {1081, wide, 0.03}, kPoses);
  run("outliers5", with_outliers, lRoom);
  run("proportional", proportional, lRoom);
  run("counts_5cm", counts_5cm, lRoom);
  run("counts_1cm", counts_1cm, lRoom);
  run("cheap", cheap, lRoom);
  run("turning_3rad", turning, lRoom);
}

/// A recording with the noise learned, as the node has it, and with 1 cm given.
void runRecording(const std::string& name, const std::vector<scan::Scan>& scans,
                  bool stands_still = false) {
  for (const bool is_given : {false, true}) {
    lines::LineExtractor extractor(settings());
    scan::LearnedNoise noise;
    Explained explained;
    Standing standing;
    std::vector<double> times;
    for (scan::Scan scan : scans) {
      is_given ? scan::applyNoise({}, scan) : noise.apply(scan);
      times.push_back(microseconds([&] { extractor.extract(scan); }));
      const auto& segments = extractor.extract(scan);
      explained.add(scan, segments, extractor.arcs());
      standing.add(segments);
    }
    const std::string prefix = "lines." + name + (is_given ? ".given_1cm." : ".");
    explained.printFigures(prefix);
    print(prefix + "us_median", median(times), "us");
    if (stands_still) standing.printFigures(prefix);
  }
}

void runRecordings() {
  const char* const data = std::getenv("SIGHTLINE_DATA");
  if (!data) {
    std::printf("# lines.two_hokuyos: SIGHTLINE_DATA does not say where the recordings are\n");
    return;
  }
  const std::string folder(data);
  const std::string standing = folder + "/two_hokuyos.bag";
  runRecording("two_hokuyos", readScans(standing, "/front_scan"), true);
  runRecording("two_hokuyos_rear", readScans(standing, "/rear_scan"), true);
  runRecording("fr079", readLog(folder + "/fr079.clf.gz"));
  runRecording("intel_part", readLog(folder + "/intel_part.clf.gz"));
}

/// The recursion as the paper has it, beside the figures of the whole method in the same room.
void runPlainMethod() {
  std::mt19937 random(2026);
  for (const int start_beams : {5, 20}) {
    lines::LineExtractorConfig config = settings();
    config.start_beams = start_beams;
    lines::PlainExtractor extractor(config);
    Score score;
    for (int i = 0; i < kPoses; ++i) {
      const Scene scene = plainRoom(random);
      const Sensor sensor{1081, 1.5 * geometry::kPi, 0.01};
      const View view = Viewer(scene.world, sensor, scene.pose).view(random);
      score.microseconds.push_back(microseconds([&] { extractor.extract(view.scan); }));
      score.conversion.push_back(convert(view.scan));
      score.add(view, extractor.extract(view.scan));
    }
    score.printFigures("1081_s1.plain_k" + std::to_string(start_beams));
  }
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

void rooms() {
  const double half_turn = geometry::kPi;
  const double wide = 1.5 * half_turn;
  run("361_s1", {361, half_turn, 0.01}, plainRoom);
  run("361_s3", {361, half_turn, 0.03}, plainRoom);
  const Score standing = run("1081_s1", {1081, wide, 0.01}, plainRoom);
  run("1081_s3", {1081, wide, 0.03}, plainRoom);
  run("1081_s1_invalid5", {1081, wide, 0.01, 0.05}, plainRoom);
  run("1081_s1_door", {1081, wide, 0.01}, doorRoom);
  run("1081_s1_legs8", {1081, wide, 0.01}, legsRoom);
  run("720_wrap_s1", {720, 2.0 * half_turn, 0.01}, plainRoom);
  const Score moving = run("1081_s1_moving", {1081, wide, 0.01, 0.0, 0.075}, plainRoom);
  print("lines.1081_s1_moving.rho_over_standing",
        median(moving.errors.rho_mm) / median(standing.errors.rho_mm), "1");
  print("lines.1081_s1_moving.phi_over_standing",
        median(moving.errors.phi_mrad) / median(standing.errors.phi_mrad), "1");
}

void cost() {
  measureCost();
  print("lines.allocations", static_cast<double>(allocated), "1");
}

void singleWalls() {
  runSingleWall("wall_facing", -1.5, 2.0);
  runSingleWall("wall_aside", 0.0, 2.0);
  runSingleWall("wall_oblique", 2.0, 1.5);
  motionConsistency();
}

/// A part of the benchmark, which may be asked for by name.
struct LinesPart {
  const char* name;
  void (*measure)();
};
constexpr LinesPart kLinesParts[] = {
    {"rooms", rooms},       {"worlds", otherWorlds},   {"cost", cost},
    {"walls", singleWalls}, {"plain", runPlainMethod}, {"recordings", runRecordings},
    {"node", runNode},
};

}  // namespace
}  // namespace sightline::bench

int main(int argc, char** argv) {
  for (const auto& part : sightline::bench::kLinesParts) {
    const bool is_asked =
        argc < 2 || std::find(argv + 1, argv + argc, std::string(part.name)) != argv + argc;
    if (is_asked) part.measure();
    std::fflush(stdout);
  }
  return 0;
}
