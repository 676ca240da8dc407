#include "sightline/scan/turn_gatherer.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "sightline/geometry/angle.h"

namespace sightline::scan {
namespace {

using geometry::kPi;
using geometry::radians;

// The beam that leaves in a direction, of 360, comes back with this range.
double rangeAt(double angle) {
  return 2.0 + std::cos(angle);
}

// A part that begins in a direction, at a time [s].
Scan part(double begin, int beams, double time, double increment = radians(1.0)) {
  const auto geometry = ScanGeometry::uniform(begin, increment, static_cast<std::size_t>(beams),
                                              0.1 / 360.0, 0.1, 10.0);
  std::vector<double> ranges;
  for (const double angle : geometry->angles()) ranges.push_back(rangeAt(angle));
  Scan scan(geometry, static_cast<std::int64_t>(std::llround(1e9 * time)), ranges);
  scan.frame = "laser";
  return scan;
}

void expectTurn(const Scan& turn, std::size_t beams) {
  EXPECT_EQ(turn.beams(), beams);
  EXPECT_EQ(turn.frame, "laser");
  for (std::size_t i = 0; i < turn.beams(); ++i) {
    EXPECT_NEAR(turn.ranges()[i], rangeAt(turn.geometry()->angles()[i]), 1e-6);
  }
}

TEST(TurnGatherer, LetsWholeSweepsPass) {
  TurnGatherer gatherer;
  for (int i = 0; i < 5; ++i) {
    const auto scan = gatherer.add(part(radians(-135.0), 270, 0.1 * i));
    ASSERT_TRUE(scan);
    EXPECT_EQ(scan->beams(), 270U);
  }
}

// Some drivers say another first angle each time.
TEST(TurnGatherer, LetsSweepsPassThatBeginALittleElsewhere) {
  TurnGatherer gatherer;
  for (int i = 0; i < 10; ++i) {
    const auto scan = gatherer.add(part(-kPi + radians(0.3 * i), 358, 0.1 * i));
    ASSERT_TRUE(scan);
    EXPECT_EQ(scan->beams(), 358U);
  }
}

TEST(TurnGatherer, GathersPartsToATurn) {
  for (const double sense : {1.0, -1.0}) {
    for (const int parts : {2, 3, 12, 36}) {
      TurnGatherer gatherer;
      const int beams = 360 / parts;
      std::vector<Scan> found;
      for (int i = 0; i < 5 * parts; ++i) {
        const double begin = geometry::wrapAngle(sense * radians(1.0) * beams * i);
        auto scan = gatherer.add(part(begin, beams, 0.1 / parts * i, sense * radians(1.0)));
        if (scan) found.push_back(*scan);
      }
      ASSERT_GE(found.size(), 5U) << parts;
      EXPECT_EQ(found[0].beams(), static_cast<std::size_t>(beams)) << "the first one passes";
      for (std::size_t i = 1; i < found.size(); ++i) expectTurn(found[i], 360);
      EXPECT_NEAR(found[1].duration(), 0.1 * 359.0 / 360.0, 1e-6);
      EXPECT_EQ(found[2].stamp - found[1].stamp, 100'000'000);
    }
  }
}

TEST(TurnGatherer, GoesOnWhereAPartIsLost) {
  TurnGatherer gatherer;
  std::vector<Scan> found;
  for (int i = 0; i < 60; ++i) {
    if (i == 17 || i == 30) continue;
    auto scan = gatherer.add(part(geometry::wrapAngle(radians(30.0) * i), 30, 0.1 / 12 * i));
    if (scan) found.push_back(*scan);
  }
  ASSERT_GE(found.size(), 4U);
  for (std::size_t i = 1; i < found.size(); ++i) {
    expectTurn(found[i], found[i].beams());
    EXPECT_GE(found[i].beams(), 330U);
  }
}

TEST(TurnGatherer, GathersASectorThatComesInParts) {
  TurnGatherer gatherer;
  std::vector<Scan> found;
  for (int i = 0; i < 12; ++i) {
    auto scan = gatherer.add(part(radians(-135.0 + 90.0 * (i % 3)), 90, 0.033 * i));
    if (scan) found.push_back(*scan);
  }
  ASSERT_GE(found.size(), 3U);
  for (std::size_t i = 2; i < found.size(); ++i) EXPECT_EQ(found[i].beams(), 270U);
}

}  // namespace
}  // namespace sightline::scan
