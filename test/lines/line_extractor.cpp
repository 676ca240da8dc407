#include "sightline/lines/line_extractor.h"

#include <gtest/gtest.h>

#include "config_error.h"
#include "lines/room_scan.h"

namespace sightline::lines {
namespace {

using geometry::EndKind;
using geometry::LineSegment;
using test::Gauss;
using test::ScanOf;

/// Five segments: the blind sector takes the middle out of the wall behind the sensor.
ScanOf room() {
  ScanOf scan;
  scan.walls = test::rectangle(-1.0, -2.5, 4.0, 2.0);
  return scan;
}

TEST(LineExtractor, finds_each_wall_of_a_room_once) {
  Gauss gauss(1);
  LineExtractor extractor;
  for (int i = 0; i < 50; ++i) {
    const auto& segments = extractor.extract(room().take(gauss));
    ASSERT_EQ(segments.size(), 5u);
  }
}

TEST(LineExtractor, refuses_settings_out_of_range) {
  LineExtractorConfig config;
  config.gate = 0.0;
  EXPECT_EQ(test::errorOf([&] { LineExtractor extractor(config); }).key(), "gate");
}

}  // namespace
}  // namespace sightline::lines
