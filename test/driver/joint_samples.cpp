#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sightline/driver/joint_samples.h"
#include "sightline/driver/scan_queue.h"

namespace sightline::driver {
namespace {

using testing::ElementsAre;

TEST(JointSamples, HeadThatStandsIsToldOnce) {
  EXPECT_THAT(jointSamples(std::vector<double>(256, 0.5), 0.5, 2500.0), ElementsAre(255));
  EXPECT_THAT(jointSamples({0.5}, 0.5, 2500.0), ElementsAre(0));
}

TEST(JointSamples, HeadThatCameToAStandIsToldFromTheBeginning) {
  EXPECT_THAT(jointSamples(std::vector<double>(256, 0.5), 0.4, 2500.0), ElementsAre(0, 255));
}

TEST(JointSamples, HeadThatTurnsIsToldEveryHundredthOfASecond) {
  std::vector<double> angles(256, 0.5);
  angles[200] = 0.6;
  EXPECT_THAT(jointSamples(angles, 0.5, 2500.0),
              ElementsAre(0, 25, 50, 75, 100, 125, 150, 175, 200, 225, 250, 255));
  EXPECT_THAT(jointSamples({0.1, 0.2, 0.3}, 0.0, 10.0), ElementsAre(0, 1, 2)) << "slow sampling";
}

TEST(JointSamples, RateIsThatOfTheHead) {
  std::vector<double> angles;
  for (int i = 0; i < 256; ++i) angles.push_back(1e-4 * std::round(1e4 * 0.8 * i / 2500.0));
  for (const std::size_t i : {0, 100, 255}) EXPECT_NEAR(jointRate(angles, i, 2500.0), 0.8, 0.03);
  EXPECT_EQ(jointRate({0.3}, 0, 2500.0), 0.0);
}

TEST(ScanQueue, IsFirstInFirstOutAndBounded) {
  ScanQueue queue(2);
  for (int i = 0; i < 3; ++i) {
    triangulation::RawScan scan;
    scan.stamp = i;
    queue.push(scan);
  }
  EXPECT_EQ(queue.overruns(), 1U);
  EXPECT_EQ(queue.pop()->stamp, 1);
  EXPECT_EQ(queue.pop()->stamp, 2);
  queue.close();
  EXPECT_FALSE(queue.pop());
}

}  // namespace
}  // namespace sightline::driver
