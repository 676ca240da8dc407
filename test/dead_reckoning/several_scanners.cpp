// Odometry from a scanner in front and one behind, of which each alone sees too little.
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "dead_reckoning/simulated_scans.h"
#include "sightline/dead_reckoning/dead_reckoner.h"
#include "sightline/logs/nees.h"

namespace sightline::dead_reckoning {
namespace {

using geometry::Pose2;

// A corridor of 13 m with nothing in it but its ends, of which a scanner that reaches 7 m sees one
// for half of the way.
world::World closedCorridor() {
  return world::World(config::Node::parse(R"(
segments:
  - {from: [-6.5, -1.0], to: [6.5, -1.0]}
  - {from: [6.5, -1.0], to: [6.5, 1.0]}
  - {from: [6.5, 1.0], to: [-6.5, 1.0]}
  - {from: [-6.5, 1.0], to: [-6.5, -1.0]}
)",
                                          "closed corridor"));
}

struct Seen {
  scan::Scan scan;
  std::size_t scanner;
};

// Two scanners of 180 degrees, of which the second looks back; its scans are taken `lag` later.
class TwoScanners {
 public:
  TwoScanners(world::World world, double reach, double lag, std::uint64_t seed)
      : front_(world, test::scanner(181, geometry::kPi, reach), seed),
        rear_(world, test::scanner(181, geometry::kPi, reach), seed + 100),
        lag_(lag) {}

  static Pose2 mounting(std::size_t scanner) {
    return scanner == 0 ? Pose2(0.3, 0.0, 0.0) : Pose2(-0.3, 0.05, geometry::kPi);
  }
  template <class Path>
  std::vector<Seen> look(int round, const Path& path) {
    const double time = 0.1 * round;
    return {{front_.look(path(time) * mounting(0), time), 0},
            {rear_.look(path(time + lag_) * mounting(1), time + lag_), 1}};
  }

 private:
  test::Viewer front_;
  test::Viewer rear_;
  double lag_;
};

// Down the corridor and back, with a gentle start.
Pose2 alongCorridor(double time) {
  return {4.0 * (1.0 - std::cos(0.3 * time)) - 4.0, 0.05 * std::sin(0.5 * time),
          0.05 * std::sin(0.4 * time)};
}

class SeveralScanners : public testing::TestWithParam<double> {};

TEST_P(SeveralScanners, HoldTogetherWhatEachAloneLoses) {
  double together = 0.0;
  double alone[2] = {};
  DeadReckoner both({});
  DeadReckoner single[2] = {DeadReckoner({}), DeadReckoner({})};
  TwoScanners scanners(closedCorridor(), 7.0, GetParam(), 1);
  for (int round = 0; round < 120; ++round) {
    for (const Seen& seen : scanners.look(round, alongCorridor)) {
      const double time = 1e-9 * static_cast<double>(seen.scan.stamp);
      const Pose2 truth = geometry::between(alongCorridor(0.0), alongCorridor(time));
      const Pose2 mounting = TwoScanners::mounting(seen.scanner);
      const auto update = both.update(seen.scan, mounting, {}, {}, seen.scanner);
      ASSERT_TRUE(update);
      EXPECT_FALSE(update->isFlagged()) << round << " " << seen.scanner;
      together =
          std::max(together, geometry::between(truth, update->pose.mean).translation().norm());
      const auto by_itself = single[seen.scanner].update(seen.scan, mounting);
      const double off = geometry::between(truth, by_itself->pose.mean).translation().norm();
      alone[seen.scanner] = std::max(alone[seen.scanner], off);
    }
  }
  EXPECT_LT(together, 0.06);
  EXPECT_GT(alone[0], 0.2);
  EXPECT_GT(alone[1], 0.2);
}

TEST_P(SeveralScanners, StepsAreAsUncertainAsTheyAre) {
  double sum = 0.0;
  double steps = 0.0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    DeadReckoner both({});
    TwoScanners scanners(test::furnishedRoom(), 7.0, GetParam(), seed);
    const auto path = [](double time) {
      // From rest: a reckoner takes it that its carrier stands at first.
      const double driven = time - 0.5 * std::tanh(2.0 * time);
      return Pose2(-1.5, 0.5, 0.0) * Pose2::exp(driven * Eigen::Vector3d(0.3, 0.0, 0.25));
    };
    Pose2 before;
    for (int round = 0; round < 60; ++round) {
      for (const Seen& seen : scanners.look(round, path)) {
        const Pose2 truth = path(1e-9 * static_cast<double>(seen.scan.stamp));
        const auto update =
            both.update(seen.scan, TwoScanners::mounting(seen.scanner), {}, {}, seen.scanner);
        ASSERT_TRUE(update);
        if (round > 15) {
          sum += logs::nees(update->step, geometry::between(before, truth));
          steps += 1.0;
          EXPECT_NEAR(update->twist.mean.x(), 0.3, 0.15);
          EXPECT_NEAR(update->twist.mean.z(), 0.25, 0.15);
        }
        before = truth;
      }
    }
  }
  EXPECT_GT(sum / steps, 1.2);  // steps of 50 ms are a little too careful
  EXPECT_LT(sum / steps, 4.5);
}

INSTANTIATE_TEST_SUITE_P(Lags, SeveralScanners, testing::Values(0.0, 0.012, 0.05));

TEST(SeveralScannersOnce, AnOlderScanIsLeftOut) {
  DeadReckoner both({});
  TwoScanners scanners(test::furnishedRoom(), 7.0, 0.05, 1);
  const auto path = [](double) { return Pose2(-1.5, 0.5, 0.0); };
  const auto seen = scanners.look(0, path);
  ASSERT_TRUE(both.update(seen[1].scan, TwoScanners::mounting(1), {}, {}, 1));
  EXPECT_FALSE(both.update(seen[0].scan, TwoScanners::mounting(0), {}, {}, 0));
}

// The scanner behind is silent while the robot drives on, so that what it sees then is new to all.
TEST(SeveralScannersOnce, OneThatComesBackJoins) {
  DeadReckoner both({});
  TwoScanners scanners(test::furnishedRoom(), 7.0, 0.05, 1);
  const auto path = [](double time) { return Pose2(-2.0 + 0.5 * time, 0.5, 0.3 * time); };
  for (int round = 0; round < 70; ++round) {
    for (const Seen& seen : scanners.look(round, path)) {
      if (seen.scanner == 1 && round > 2 && round < 50) continue;
      const auto update =
          both.update(seen.scan, TwoScanners::mounting(seen.scanner), {}, {}, seen.scanner);
      ASSERT_TRUE(update);
      EXPECT_FALSE(update->isFlagged()) << round << " " << seen.scanner;
      const Pose2 truth =
          geometry::between(path(0.0), path(1e-9 * static_cast<double>(seen.scan.stamp)));
      EXPECT_LT(geometry::between(truth, update->pose.mean).translation().norm(), 0.04) << round;
    }
  }
}

}  // namespace
}  // namespace sightline::dead_reckoning
