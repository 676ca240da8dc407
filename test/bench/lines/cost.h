#pragma once

#include <string>
#include <vector>

#include "scenario.h"
#include "sightline/scan/noise_model.h"

namespace sightline::bench {

/// Median time of the scans of a world, in a tight loop: each is filled with its variances and
/// extracted [µs].
template <class Fill>
double medianCost(const std::vector<scan::Scan>& scans, const Fill& fill) {
  lines::LineExtractor extractor(settings());
  std::vector<double> times;
  for (int round = 0; round < 10; ++round) {
    for (const scan::Scan& of : scans) {
      scan::Scan scan = of;
      times.push_back(microseconds([&] {
        fill(scan);
        extractor.extract(scan);
      }));
    }
  }
  return median(times);
}

struct Cost {
  double given;
  double estimated;
};

inline Cost costOf(const std::string& name, std::size_t beams, const Draw& draw) {
  std::mt19937 random(9);
  std::vector<scan::Scan> scans;
  for (int i = 0; i < 50; ++i) {
    const Scene scene = draw(random);
    const Sensor sensor{beams, 1.5 * geometry::kPi, 0.01};
    scans.push_back(Viewer(scene.world, sensor, scene.pose).view(random).scan);
  }
  scan::LearnedNoise noise;
  const Cost cost{medianCost(scans, [](scan::Scan& scan) { applyNoise({}, scan); }),
                  medianCost(scans, [&](scan::Scan& scan) { noise.apply(scan); })};
  const std::string prefix = "lines.cost." + name + "_" + std::to_string(beams) + ".";
  print(prefix + "given", cost.given, "us");
  print(prefix + "estimated", cost.estimated, "us");
  return cost;
}

inline void measureCost() {
  for (const std::size_t beams : {180, 361, 1081, 4320}) {
    const Cost plain = costOf("plain", beams, plainRoom);
    const Cost cluttered = costOf("office", beams, office);
    const Cost obtuse = costOf("obtuse", beams, obtuseRoom);
    const std::string prefix = "lines.cost." + std::to_string(beams) + ".";
    print(prefix + "obtuse_over_plain", obtuse.given / plain.given, "1");
    print(prefix + "office_over_plain", cluttered.given / plain.given, "1");
    print(prefix + "estimated_over_given", plain.estimated / plain.given, "1");
  }
}

}  // namespace sightline::bench
