#include "sightline/bridge/missing_input.h"

#include <gtest/gtest.h>

namespace sightline::bridge {
namespace {

TEST(MissingInput, AdviceNamesTheTopicsThatThereAre) {
  EXPECT_EQ(adviceOn("/scan", "sensor_msgs/LaserScan", {"/front/scan", "/rear/scan"}),
            "sensor_msgs/LaserScan is on /front/scan, /rear/scan: name it, scan:=/front/scan for "
            "launch files");
}

TEST(MissingInput, AdviceSaysThatNobodyPublishes) {
  EXPECT_EQ(adviceOn("/scan", "sensor_msgs/LaserScan", {}),
            "nobody publishes sensor_msgs/LaserScan; rostopic info /scan");
}

}  // namespace
}  // namespace sightline::bridge
