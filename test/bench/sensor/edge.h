#pragma once

#include <string>

#include "bench/figures.h"
#include "sightline/lines/line_extractor.h"
#include "sightline/lines/plain_extractor.h"
#include "sightline/plot/figure.h"
#include "sightline/simulation/active_sensor.h"

namespace sightline::bench {

/// Scans of the convex edge of pears figs 4 and 5, the head still, straight ahead.
class EdgeScans {
 public:
  explicit EdgeScans(const simulation::ActiveSensorProfile& profile)
      : profile_(profile),
        ranger_(profile.calibrated()),
        world_(world::World::readFile(SIGHTLINE_SOURCE_DIR "/config/worlds/edge.yaml")) {}

  /// Scan from `ahead` [m] along the direction of sight: z of pears.
  scan::Scan from(double ahead, std::uint64_t seed) const {
    simulation::ActiveSensor sensor(profile_, seed);
    const Eigen::Isometry3d T_map_mount(Eigen::Translation3d(ahead, -1.5, 1.0));
    const auto end = static_cast<std::int64_t>(1e9 * profile_.sensor.scan.scanPeriod());
    const auto raw = sensor.advance(world_, end, [&](std::int64_t) { return T_map_mount; });
    return ranger_.range(raw.at(0)).scan;
  }

 private:
  simulation::ActiveSensorProfile profile_;
  triangulation::Ranger ranger_;
  world::World world_;
};

/// Over the scans of 100 seeds.
struct EdgeSegments {
  int two = 0;  ///< scans of exactly two segments
  double mean = 0.0;
};

template <class Extractor>
EdgeSegments countSegments(const EdgeScans& scans, double ahead, Extractor extractor) {
  EdgeSegments result;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const std::size_t segments = extractor.extract(scans.from(ahead, seed)).size();
    result.two += segments == 2 ? 1 : 0;
    result.mean += 0.01 * static_cast<double>(segments);
  }
  return result;
}

inline void edges(const simulation::ActiveSensorProfile& profile) {
  const EdgeScans scans(profile);
  const lines::LineExtractor full;
  const lines::PlainExtractor plain;
  print("sensor.figure4.two_segments", countSegments(scans, 0.5, full).two, "of_100");
  print("sensor.figure5.two_segments", countSegments(scans, 0.0, full).two, "of_100");
  std::printf("# plain: the recursion alone at the default gate; pears shows 2 and 4 segments\n");
  print("sensor.figure4.plain_segments", countSegments(scans, 0.5, plain).mean, "segments");
  print("sensor.figure5.plain_segments", countSegments(scans, 0.0, plain).mean, "segments");
}

/// Draws the mean number of segments against the gate g of eq. 33, which pears section 4.7 leaves
/// open.
inline void drawSegmentsAgainstGate(const simulation::ActiveSensorProfile& profile,
                                    const std::string& path) {
  const EdgeScans scans(profile);
  plot::Panel panel{
      "A convex edge of two faces", "gate g [sigma]", "segments, mean of 100", "", 0.0, {}};
  for (const double ahead : {0.5, 0.0}) {
    const std::string view = ahead == 0.5 ? ", view of figure 4" : ", view of figure 5";
    plot::Series plain{"recursion alone" + view, plot::Style::kLineAndPoints, {}};
    plot::Series full{"line extractor" + view, plot::Style::kLineAndPoints, {}};
    for (double gate = 1.5; gate <= 6.0; gate += 0.5) {
      lines::LineExtractorConfig config;
      config.gate = gate;
      plain.points.push_back(
          {gate, countSegments(scans, ahead, lines::PlainExtractor(config)).mean});
      full.points.push_back({gate, countSegments(scans, ahead, lines::LineExtractor(config)).mean});
    }
    for (const plot::Series& series : {plain, full}) {
      std::printf("# segments against the gate, %s:", series.title.c_str());
      for (const auto& point : series.points) std::printf(" %.1f: %.2f", point.x, point.y);
      std::printf("\n");
      panel.series.push_back(series);
    }
  }
  plot::writePng({1000, 600, 1, {panel}}, path);
  std::printf("# segments against the gate are drawn in %s\n", path.c_str());
}

}  // namespace sightline::bench
