#include "sightline/bridge/bag_feed.h"

#include <limits>

#include <gmock/gmock.h>
#include <tf2_msgs/TFMessage.h>

#include "config_error.h"
#include "sightline/bridge/imu_conversion.h"
#include "sightline/bridge/pose_conversion.h"
#include "sightline/bridge/time.h"
#include "temporary_folder.h"

namespace sightline::bridge {
namespace {

using geometry::Pose2;
using pipeline::LocatedScan;
using test::errorOf;
using test::TemporaryFolder;
using testing::Contains;
using testing::HasSubstr;
using testing::Pair;

// Bags written message by message, each at its own stamp unless said otherwise.
class BagFeedTest : public testing::Test {
 protected:
  void scanAt(double time, float time_increment = 0.0F, const std::string& topic = "/scan") {
    sensor_msgs::LaserScan scan;
    scan.header.stamp = ros::Time(time);
    scan.header.frame_id = "laser";
    scan.angle_increment = 0.1F;
    scan.time_increment = time_increment;
    scan.range_max = 10.0F;
    scan.ranges.assign(11, 2.0F);
    bag_.write(topic, scan.header.stamp, scan);
  }

  void transformAt(double time, const char* parent, const char* child, const Pose2& pose,
                   const char* topic = "/tf") {
    tf2_msgs::TFMessage message;
    message.transforms = {toTransformMessage(parent, child, nanoseconds(ros::Time(time)), pose)};
    bag_.write(topic, ros::Time(time), message);
  }

  void odometryAt(double time, double x) {
    nav_msgs::Odometry message;
    message.header.stamp = ros::Time(time);
    message.pose.pose = toPose({x, 0.0, 0.0});
    bag_.write("odom", ros::Time(time), message);
  }

  void mountLaser() { transformAt(10.0, "base_link", "laser", {0.2, 0, 0}, "/tf_static"); }

  std::vector<LocatedScan> read(const pipeline::EstimatorsConfig& config = {}) {
    bag_.close();
    feed_.emplace(std::vector<std::string>{folder_.path("a.bag")}, config, pipeline::FeedNeeds{});
    return readAll();
  }

  std::vector<LocatedScan> readAll() {
    std::vector<LocatedScan> found;
    BagFeed::Visitor visitor;
    visitor.scan = [&](LocatedScan located, const ros::Time& now) {
      found.push_back(std::move(located));
      released_.push_back(now.toSec());
    };
    visitor.message = [&](const rosbag::MessageInstance&) { ++messages_; };
    visitor.progress = [&](double ratio) { progress_ = ratio; };
    feed_->read(visitor);
    return found;
  }

  TemporaryFolder folder_;
  rosbag::Bag bag_{folder_.path("a.bag"), rosbag::bagmode::Write};
  std::optional<BagFeed> feed_;
  std::vector<double> released_;  // how far the bag was read for each scan [s]
  std::size_t messages_ = 0;
  double progress_ = 0.0;
};

TEST_F(BagFeedTest, ReadsScansAndTransforms) {
  mountLaser();
  transformAt(10.0, "odom", "base_link", {0.0, 0.0, 0.0});
  scanAt(10.1, 0.01F);  // until 10.2
  transformAt(10.15, "odom", "base_link", {0.15, 0.0, 0.0});
  transformAt(10.25, "odom", "base_link", {0.25, 0.0, 0.0});
  const auto found = read();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_DOUBLE_EQ(released_[0], 10.25);
  EXPECT_NEAR(found[0].T_odom_base->x(), 0.1, 1e-9);
  EXPECT_NEAR(found[0].T_base_sensor->x(), 0.2, 1e-12);
  EXPECT_NEAR(found[0].scan.sensorMotion().back().x(), 0.1, 1e-6);
  EXPECT_EQ(messages_, 5U);
  EXPECT_DOUBLE_EQ(progress_, 1.0);
}

TEST_F(BagFeedTest, GivesWhatWaitsAtTheEnd) {
  scanAt(10.0);
  const auto found = read();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_FALSE(found[0].T_base_sensor.has_value());
}

TEST_F(BagFeedTest, ReadsTheTopicOfOdometryWhereTransformsHaveNone) {
  mountLaser();
  for (int i = 0; i <= 4; ++i) odometryAt(10.0 + 0.1 * i, 0.1 * i);
  scanAt(10.1, 0.01F);
  odometryAt(10.6, 0.6);
  const auto found = read();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].T_odom_base->x(), 0.1, 1e-9);
  EXPECT_EQ(found[0].scan.sensorMotion().size(), 11U);
}

TEST_F(BagFeedTest, ReadsAnInertialSensor) {
  mountLaser();
  for (int i = 0; i <= 40; ++i) {
    const auto stamp = nanoseconds(ros::Time(10.0 + 0.01 * i));
    bag_.write("imu", ros::Time(10.0 + 0.01 * i), toImuMessage(stamp, "base_link", {}, 0.5));
  }
  scanAt(10.1);
  scanAt(10.3);
  const auto found = read();
  ASSERT_EQ(found.size(), 2U);
  EXPECT_NEAR(*found[1].turn, 0.1, 1e-6);
  EXPECT_TRUE(found[0].attitude.has_value());
}

TEST_F(BagFeedTest, ReadsRangeScansWithTheirHead) {
  transformAt(10.0, "base_link", "mount", {0.1, 0.0, 0.0}, "/tf_static");
  motion::RangeScan range_scan;
  const auto geometry = scan::ScanGeometry::uniform(-0.1, 0.1, 3, 4e-4, 0.4, 2.5);
  range_scan.scan =
      scan::Scan(geometry, nanoseconds(ros::Time(10.0)), {1.0, 1.1, 1.2}, {1e-9, 1e-9, 1e-9});
  range_scan.scan.setRangeVariances({1e-6, 2e-6, 3e-6});
  range_scan.head = {{0.2, 0.21, 0.22}, "mount", {0.05, 0.0}};
  bag_.write("/range_scan", ros::Time(10.0), toMessage(range_scan));
  pipeline::EstimatorsConfig config;
  config.input.range_scans = {"range_scan"};
  const auto found = read(config);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].scan.rangeVariances()[1], 2e-6, 1e-15);
  EXPECT_NEAR(found[0].T_base_sensor->theta(), 0.2, 1e-9);
  EXPECT_NEAR(found[0].scan.sensorMotion().back().theta(), 0.02, 1e-9);
}

TEST_F(BagFeedTest, FindsTopicsWithAndWithoutALeadingSlash) {
  scanAt(10.0, 0.0F, "scan");
  pipeline::EstimatorsConfig config;
  config.input.scans = {"/scan"};
  EXPECT_EQ(read(config).size(), 1U);
}

TEST_F(BagFeedTest, ReadsSeveralBagsAsOne) {
  mountLaser();
  scanAt(10.0);
  bag_.close();
  bag_.open(folder_.path("b.bag"), rosbag::bagmode::Write);
  scanAt(11.0);
  bag_.close();
  feed_.emplace(std::vector<std::string>{folder_.path("a.bag"), folder_.path("b.bag")},
                pipeline::EstimatorsConfig{}, pipeline::FeedNeeds{});
  const auto found = readAll();
  ASSERT_EQ(found.size(), 2U);
  EXPECT_TRUE(found[1].T_base_sensor.has_value()) << "the first bag alone tells";
}

TEST_F(BagFeedTest, TakesMountingsFromTheSettings) {
  scanAt(10.0);
  pipeline::EstimatorsConfig config;
  config.mountings["laser"] = Pose2(0.4, 0.0, 0.1);
  const auto found = read(config);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].T_base_sensor->x(), 0.4, 1e-12);
}

TEST_F(BagFeedTest, CountsMalformedScansByReason) {
  mountLaser();
  transformAt(10.0, "odom", "base_link", {});
  sensor_msgs::LaserScan scan;
  scan.header.stamp = ros::Time(10.1);
  scan.header.frame_id = "laser";
  scan.angle_increment = 0.1F;
  scan.range_max = 10.0F;
  bag_.write("/scan", scan.header.stamp, scan);  // no beams
  scan.ranges.assign(3, 1.0F);
  scan.header.stamp = ros::Time(0);
  bag_.write("/scan", ros::Time(10.1), scan);
  scan.header.stamp = ros::Time(10.1);
  scan.angle_increment = std::numeric_limits<float>::quiet_NaN();
  bag_.write("/scan", scan.header.stamp, scan);
  scanAt(10.2);
  transformAt(10.3, "odom", "base_link", {});
  EXPECT_EQ(read().size(), 1U);
  EXPECT_EQ(feed_->scans(), 4U);
  EXPECT_EQ(feed_->dropped().size(), 3U);
  EXPECT_THAT(feed_->dropped(), Contains(Pair("a stamp of zero", 1U)));
}

TEST_F(BagFeedTest, NamesTheTopicsThatThereAre) {
  scanAt(10.0);
  bag_.close();
  pipeline::EstimatorsConfig config;
  config.input.scans = {"front"};
  const auto error = errorOf([&] { BagFeed({folder_.path("a.bag")}, config, {}); });
  EXPECT_THAT(error.source(), HasSubstr("a.bag"));
  EXPECT_EQ(error.reason(), "no scans on /front; there are: /scan");
}

TEST_F(BagFeedTest, RefusesWhatIsNoBag) {
  for (const std::string& path : {folder_.write("b.bag", "not a bag"), folder_.path("none.bag")}) {
    EXPECT_EQ(errorOf([&] { BagFeed({path}, {}, {}); }).source(), path);
  }
}

}  // namespace
}  // namespace sightline::bridge
