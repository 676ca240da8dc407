#include "sightline/triangulation/calibration_table.h"

#include <cmath>
#include <limits>

#include "config_error.h"

namespace sightline::triangulation {
namespace {

using test::errorOf;
using Reach = CalibrationTable::Reach;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(CalibrationTable, IsExactAtItsTargets) {
  const std::vector<double> depths{0.5, 1.0, 2.0};
  const CalibrationTable table(depths, {{3e-3, 1e-3, -1e-3}, {kNan, 2e-3, 0.0}});
  EXPECT_EQ(table.beams(), 2U);
  EXPECT_EQ(table.depths(), depths);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto found = table.lookUp(0, table.imagePositions(0)[i]);
    EXPECT_EQ(found.reach, Reach::kWithin);
    EXPECT_NEAR(found.depth, depths[i], 1e-12);
  }
  EXPECT_TRUE(std::isnan(table.imagePositions(1)[0]));
  EXPECT_EQ(table.imagePositions(1)[2], 0.0);
}

TEST(CalibrationTable, InterpolatesInInverseDepth) {
  const CalibrationTable table({0.5, 1.0}, {{3e-3, 1e-3}});
  const auto found = table.lookUp(0, 2e-3);
  EXPECT_NEAR(found.depth, 1.0 / 1.5, 1e-12);
  const double step = 1e-9;
  const double gain =
      (table.lookUp(0, 2e-3 + step).depth - table.lookUp(0, 2e-3 - step).depth) / (2.0 * step);
  EXPECT_NEAR(found.gain, gain, 1e-3);
  EXPECT_LT(found.gain, 0.0);
}

TEST(CalibrationTable, SaysWhatIsBeyondIt) {
  const CalibrationTable table({0.5, 1.0, 2.0}, {{kNan, 2e-3, 0.0}});
  EXPECT_EQ(table.lookUp(0, 2.5e-3).reach, Reach::kNearer);
  EXPECT_NEAR(table.lookUp(0, 2.5e-3).depth, 1.0, 1e-12);
  EXPECT_EQ(table.lookUp(0, -1e-3).reach, Reach::kFarther);
  EXPECT_NEAR(table.lookUp(0, -1e-3).depth, 2.0, 1e-12);
}

TEST(CalibrationTable, RefusesEmptyTruncatedAndNonMonotonicTables) {
  const auto fault = [](std::vector<double> depths, std::vector<std::vector<double>> rows) {
    return errorOf([&] { CalibrationTable(std::move(depths), std::move(rows), "c.yaml"); });
  };
  EXPECT_EQ(fault({}, {}).key(), "depths");
  EXPECT_EQ(fault({1.0}, {{0.0}}).key(), "depths");
  EXPECT_EQ(fault({1.0, 2.0}, {}).reason(), "is empty");
  EXPECT_EQ(fault({2.0, 1.0}, {{1.0, 0.0}}).key(), "depths");
  EXPECT_EQ(fault({-1.0, 1.0}, {{1.0, 0.0}}).key(), "depths");
  EXPECT_EQ(fault({1.0, HUGE_VAL}, {{1.0, 0.0}}).key(), "depths");
  EXPECT_EQ(fault({1.0, 2.0}, {{1.0, 0.0}, {1.0}}).key(), "image_positions[1]");
  EXPECT_EQ(fault({1.0, 2.0}, {{1.0, kNan}}).reason(), "fewer than two targets were seen");
  EXPECT_EQ(fault({1.0, 2.0, 3.0}, {{1.0, kNan, 0.0}}).reason(), "a gap at a depth of 2 m");
  EXPECT_EQ(fault({1.0, 2.0}, {{1.0, HUGE_VAL}}).key(), "image_positions[0]");
  const auto rising = fault({1.0, 2.0, 3.0}, {{2.0, 1.0, 1.0}});
  EXPECT_STREQ(rising.what(),
               "c.yaml: image_positions[0]: the image position does not fall from 2 m to 3 m");
}

TEST(CalibrationTable, ReadsYaml) {
  const CalibrationTable table(config::Node::parse(
      "depths: [1, 2, 3]\nimage_positions:\n  - [3e-3, 1e-3, .nan]\n", "c.yaml"));
  EXPECT_EQ(table.beams(), 1U);
  EXPECT_TRUE(std::isnan(table.imagePositions(0)[2]));
  const auto fault = [](const char* text) {
    return errorOf([&] { CalibrationTable(config::Node::parse(text, "c.yaml")); });
  };
  EXPECT_EQ(fault("depths: [1, 2]\n").source(), "c.yaml");
  EXPECT_EQ(fault("{depths: [1, 2], image_positions: [[1, x]]}").line(), 1);
  EXPECT_EQ(fault("{depths: [1, 2], image_positions: [[1, 0]], more: 1}").key(), "more");
}

}  // namespace
}  // namespace sightline::triangulation
