// Line extraction: accuracy, covariance, completeness and time in a room with two boxes where the
// truth is known, beside the floor that an oracle reaches who knows which beam hit which wall; and
// what is explained of a real recording.
#include <chrono>
#include <cstdlib>
#include <string>

#include "lines/score.h"
#include "lines/view.h"
#include "lines/world.h"
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
  const auto& angles = scan.geometry->angles();
  const double time = microseconds([&] {
    for (std::size_t i = 0; i < scan.beams(); ++i) {
      x[i] = scan.ranges[i] * std::cos(angles[i]);
      y[i] = scan.ranges[i] * std::sin(angles[i]);
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

Score run(const std::string& name, const Sensor& sensor, WorldAt world_at) {
  lines::LineExtractor extractor(settings());
  std::mt19937 random(2026);
  Score score;
  for (int i = 0; i < kPoses; ++i) {
    const geometry::Pose2 pose = randomPose(random);
    const PlaneWorld world = world_at(pose, random);
    const View view = Viewer(world, sensor, pose).view(random);
    extractor.extract(view.scan);
    score.microseconds.push_back(microseconds([&] { extractor.extract(view.scan); }));
    score.conversion.push_back(convert(view.scan));
    score.add(view, extractor.extract(view.scan));
  }
  score.printFigures(name);
  return score;
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
  run("1081_s1", {1081, wide, 0.01}, plainRoom);
  run("1081_s3", {1081, wide, 0.03}, plainRoom);
  run("1081_s1_invalid5", {1081, wide, 0.01, 0.05}, plainRoom);
  run("720_wrap_s1", {720, whole_turn, 0.01}, plainRoom);
  run("1081_s1_moving", {1081, wide, 0.01, 0.0, 0.075}, plainRoom);
  return 0;
}
