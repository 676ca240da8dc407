#include <algorithm>
#include <functional>
#include <vector>

#include <gtest/gtest.h>

#include "lines/room_scan.h"
#include "sightline/config/error.h"
#include "sightline/lines/line_extractor.h"

// No setting makes a search endless: each is run at both ends of its range, in scenes that have the
// most to search.
namespace sightline::lines {
namespace {

bool isAccepted(const LineExtractorConfig& config) {
  try {
    config::validate(config);
    return true;
  } catch (const config::Error&) {
    return false;
  }
}

void expectEveryScanToEnd(const LineExtractorConfig& config) {
  test::Gauss gauss(9);
  test::ScanOf room = test::room();
  room.posts = {{{1.5, 0.8}, 0.2}, {{2.0, -1.0}, 0.1}, {{0.5, 1.0}, 0.03}};
  std::vector<double> clutter, stairs, gaps;
  for (int i = 0; i < 1081; ++i) {
    clutter.push_back(gauss.uniform(0.5, 30.0));
    stairs.push_back(1.0 + 0.1 * ((i / 6) % 7) + gauss(0.01));
    gaps.push_back(i % 11 < 5 ? 3.0 + gauss(0.01) : test::kNan);
  }
  LineExtractor extractor(config);
  for (const bool circle : {false, true}) {
    if (circle) room.angle_increment = 2.0 * geometry::kPi / 1081.0;
    for (const auto& scan : {room.take(gauss), room.withRanges(clutter), room.withRanges(stairs),
                             room.withRanges(gaps)}) {
      for (const auto& segment : extractor.extract(scan)) {
        EXPECT_TRUE(segment.line.covariance.allFinite());
        EXPECT_GE(segment.beams, static_cast<std::size_t>(config.min_beams));
      }
      for (const auto& arc : extractor.arcs()) {
        EXPECT_LE(arc.radius, config.max_radius);
        EXPECT_GE(arc.beams, static_cast<std::size_t>(config.min_arc_beams));
      }
    }
  }
}

template <class Number>
void expectLimits(Number LineExtractorConfig::*setting, Number low, Number high, Number step) {
  for (const Number end : {low, high}) {
    LineExtractorConfig config;
    config.*setting = end;
    ASSERT_TRUE(isAccepted(config)) << end;
    expectEveryScanToEnd(config);
    config.*setting = end == low ? low - step : high + step;
    EXPECT_FALSE(isAccepted(config)) << config.*setting;
  }
}

TEST(SettingLimits, EveryScanEnds) {
  expectLimits(&LineExtractorConfig::gate, 1.0, 10.0, 0.01);
  expectLimits(&LineExtractorConfig::misfit, 1.0, 10.0, 0.01);
  expectLimits(&LineExtractorConfig::max_gap, 0.0, 100.0, 0.1);
  expectLimits(&LineExtractorConfig::max_gap_beams, 0, 1000, 1);
  expectLimits(&LineExtractorConfig::min_length, 0.0, 100.0, 0.1);
  expectLimits(&LineExtractorConfig::min_beams, 3, 1'000'000, 1);
  expectLimits(&LineExtractorConfig::max_radius, 0.0, 100.0, 0.1);
  expectLimits(&LineExtractorConfig::min_arc_beams, 4, 1'000'000, 1);
  expectLimits(&LineExtractorConfig::start_beams, 2, 1000, 1);
}

// The widest gaps together with the shortest walls: every search at its longest.
TEST(SettingLimits, TogetherTheyEnd) {
  LineExtractorConfig config;
  config.max_gap = 100.0;
  config.max_gap_beams = 1000;
  config.min_length = 0.0;
  config.min_beams = 3;
  config.max_radius = 100.0;
  config.min_arc_beams = 4;
  for (const double gate : {1.0, 10.0}) {
    for (const double misfit : {1.0, 10.0}) {
      config.gate = gate;
      config.misfit = misfit;
      expectEveryScanToEnd(config);
    }
  }
}

}  // namespace
}  // namespace sightline::lines
