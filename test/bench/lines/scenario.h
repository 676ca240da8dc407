#pragma once

#include <chrono>
#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "bench/allocations.h"
#include "door.h"
#include "round_things.h"
#include "scenes.h"
#include "score.h"
#include "sightline/lines/line_extractor.h"
#include "sightline/scan/learned_noise.h"
#include "view.h"

namespace sightline::bench {

constexpr int kPoses = 1000;

/// Once for all scenarios: what is allocated by scans after the first.
inline std::size_t allocated = 0;

inline lines::LineExtractorConfig settings() {
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
inline double convert(const scan::Scan& scan) {
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

using Draw = std::function<Scene(std::mt19937&)>;

inline Scene plainRoom(std::mt19937& random) {
  const geometry::Pose2 pose = randomPose(random);
  return {roomWithBoxes(), pose};
}
inline Scene doorRoom(std::mt19937& random) {
  const geometry::Pose2 pose = randomPose(random);
  return {roomWithDoor(), pose};
}
inline Scene legsRoom(std::mt19937& random) {
  const geometry::Pose2 pose = randomPose(random);
  return {roomWithLegs(pose, random), pose};
}

/// What one extractor does with the scans of a scenario.
struct Entry {
  lines::LineExtractor extractor{settings()};
  Score score;
  DoorScore door;
  RoundScore round;

  void take(const View& view, const Scene& scene, const scan::Scan& scan) {
    const std::size_t before = allocations;
    extractor.extract(scan);
    if (!score.microseconds.empty()) allocated += allocations - before;
    score.microseconds.push_back(microseconds([&] { extractor.extract(scan); }));
    score.conversion.push_back(convert(scan));
    const auto& segments = extractor.extract(scan);
    const std::vector<int> matched = score.add(view, segments);
    door.add(view, scene.pose, segments, matched);
    round.add(view, scene.world, scene.pose, extractor.arcs());
  }

  void printFigures(const std::string& name) const {
    score.printFigures(name);
    if (door.isSeen()) door.printFigures(name);
    if (round.isSeen()) round.printFigures(name);
  }
};

/// Ratio of the learned standard deviation to the true one, of the median beam of each scan.
class SigmaRatio {
 public:
  void add(const scan::Scan& given, const scan::Scan& learned) {
    std::vector<double> ratios;
    for (std::size_t i = 0; i < given.beams(); ++i) {
      if (!given.isValid(i) || given.rangeVariances()[i] == 0.0) continue;
      ratios.push_back(std::sqrt(learned.rangeVariances()[i] / given.rangeVariances()[i]));
    }
    if (!ratios.empty()) of_scans_.push_back(median(ratios));
  }
  void printFigures(const std::string& name) const {
    if (of_scans_.empty()) return;
    print("lines." + name + ".sigma_p10", quantile(of_scans_, 0.1), "of_true");
    print("lines." + name + ".sigma_p99", quantile(of_scans_, 0.99), "of_true");
  }

 private:
  std::vector<double> of_scans_;
};

/// Runs one scenario with the noise given, and with the noise learned from the same scans: by one
/// scanner, and by one that sees each scene first. Returns the figures with the noise given.
inline Score run(const std::string& name, const Sensor& sensor, const Draw& draw,
                 int poses = kPoses) {
  std::mt19937 random(2026);
  Entry given;
  Entry estimated;
  scan::LearnedNoise noise;
  SigmaRatio ratio;
  SigmaRatio first_ratio;
  for (int i = 0; i < poses; ++i) {
    const Scene scene = draw(random);
    const View view = Viewer(scene.world, sensor, scene.pose).view(random);
    given.take(view, scene, view.scan);
    scan::Scan scan = view.scan;
    noise.apply(scan);
    estimated.take(view, scene, scan);
    ratio.add(view.scan, scan);
    scan::LearnedNoise().apply(scan);
    first_ratio.add(view.scan, scan);
  }
  given.printFigures(name);
  estimated.printFigures(name + ".estimated");
  ratio.printFigures(name + ".estimated");
  first_ratio.printFigures(name + ".first_scan");
  return given.score;
}

}  // namespace sightline::bench
