#include <cstdlib>
#include <map>
#include <set>
#include <string>

#include <gtest/gtest.h>
#include <ros/ros.h>
#include <sensor_msgs/LaserScan.h>

#include "nodes/launch.h"
#include "nodes/recorder.h"
#include "sightline/LineSegmentArray.h"

namespace sightline {
namespace {

using test::Launch;
using test::Recorder;

std::string recording(const std::string& name) {
  const char* folder = std::getenv("SIGHTLINE_DATA");
  return folder ? std::string(folder) + "/" + name : "";
}

// Every scan has its lines, with its stamp and frame.
void expectOneToOne(const std::vector<sensor_msgs::LaserScan>& scans,
                    const std::vector<LineSegmentArray>& lines) {
  std::map<ros::Time, std::string> frames;
  for (const auto& scan : scans) frames[scan.header.stamp] = scan.header.frame_id;
  std::set<ros::Time> answered;
  std::size_t segments = 0;
  for (const auto& array : lines) {
    EXPECT_TRUE(answered.insert(array.header.stamp).second) << "two answers to one scan";
    EXPECT_EQ(frames[array.header.stamp], array.header.frame_id);
    segments += array.segments.size();
  }
  EXPECT_EQ(answered.size(), frames.size());
  EXPECT_GT(segments, 2 * lines.size());
}

TEST(Replay, LinesOnBothScannersAtTheRateOfTheScans) {
  const std::string bag = recording("two_hokuyos.bag");
  if (bag.empty()) GTEST_SKIP() << "SIGHTLINE_DATA is not set";
  Recorder<sensor_msgs::LaserScan> front("front_scan");
  Recorder<sensor_msgs::LaserScan> rear("rear_scan");
  Recorder<LineSegmentArray> front_lines("front_scan/lines");
  Recorder<LineSegmentArray> rear_lines("rear_scan/lines");
  const Launch launch("replay.launch delay:=4 rate:=2 play_arguments:=--keep-alive bag:=" + bag +
                      " config:=" SIGHTLINE_SOURCE_DIR "/config/replay/two_hokuyos.yaml");
  front.atLeast(331);
  rear.atLeast(330);
  front_lines.atLeast(331);
  rear_lines.atLeast(330);
  expectOneToOne(front.all(), front_lines.all());
  expectOneToOne(rear.all(), rear_lines.all());
}

}  // namespace
}  // namespace sightline
