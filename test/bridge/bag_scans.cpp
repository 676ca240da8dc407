#include "sightline/bridge/bag_scans.h"

#include <limits>

#include <gmock/gmock.h>

#include "config_error.h"
#include "sightline/bridge/time.h"
#include "temporary_folder.h"

namespace sightline::bridge {
namespace {

using geometry::Pose2;
using test::errorOf;
using test::TemporaryFolder;
using testing::Contains;
using testing::HasSubstr;
using testing::Pair;

// A bag written message by message, each at its own stamp unless said otherwise.
class BagScansTest : public testing::Test {
 protected:
  void scanAt(double time, float time_increment = 0.0F) {
    sensor_msgs::LaserScan scan;
    scan.header.stamp = ros::Time(time);
    scan.header.frame_id = "laser";
    scan.angle_increment = 0.1F;
    scan.time_increment = time_increment;
    scan.range_max = 10.0F;
    scan.ranges.assign(11, 2.0F);
    write(scan);
  }

  void write(const sensor_msgs::LaserScan& scan) { bag_.write("/scan", scan.header.stamp, scan); }

  void transformAt(double time, const char* parent, const char* child, const Pose2& pose,
                   const char* topic = "/tf") {
    tf2_msgs::TFMessage message;
    message.transforms.resize(1);
    message.transforms[0].header.stamp = ros::Time(time);
    message.transforms[0].header.frame_id = parent;
    message.transforms[0].child_frame_id = child;
    message.transforms[0].transform = toTransform(pose);
    bag_.write(topic, ros::Time(time), message);
  }

  void mountLaser(const Pose2& pose = {}) {
    transformAt(10.0, "base_link", "laser", pose, "/tf_static");
  }

  std::vector<LocatedScan> read(bool use_wheels = true) {
    bag_.close();
    BagScans scans(folder_.path("a.bag"), {}, use_wheels);
    std::vector<LocatedScan> found;
    BagScans::Visitor visitor;
    visitor.scan = [&](const LocatedScan& located, const ros::Time& now) {
      found.push_back(located);
      released_.push_back(now.toSec());
    };
    visitor.message = [&](const rosbag::MessageInstance&) { ++messages_; };
    visitor.progress = [&](double share) { progress_ = share; };
    scans.read(visitor);
    dropped_ = scans.dropped();
    scans_ = scans.scans();
    return found;
  }

  TemporaryFolder folder_;
  rosbag::Bag bag_{folder_.path("a.bag"), rosbag::bagmode::Write};
  std::vector<double> released_;  // how far the bag was read for each scan [s]
  std::map<std::string, std::size_t> dropped_;
  std::size_t scans_ = 0;
  std::size_t messages_ = 0;
  double progress_ = 0.0;
};

TEST_F(BagScansTest, WaitForTheOdometryToCoverTheSweep) {
  mountLaser({0.2, 0.0, 0.0});
  transformAt(10.0, "odom", "base_link", {0.0, 0.0, 0.0});
  scanAt(10.1, 0.01F);  // until 10.2
  transformAt(10.15, "odom", "base_link", {0.15, 0.0, 0.0});
  transformAt(10.25, "odom", "base_link", {0.25, 0.0, 0.0});
  const auto found = read();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_DOUBLE_EQ(released_[0], 10.25);
  EXPECT_NEAR(found[0].T_odom_base->x(), 0.1, 1e-9);
  EXPECT_NEAR(found[0].T_base_sensor->x(), 0.2, 1e-12);
  ASSERT_EQ(found[0].scan.sensorMotion().size(), 11U);
  EXPECT_NEAR(found[0].scan.sensorMotion().back().x(), 0.1, 1e-6);
  EXPECT_EQ(messages_, 5U);
  EXPECT_DOUBLE_EQ(progress_, 1.0);
}

TEST_F(BagScansTest, GoOnWithoutOdometryThatDoesNotCome) {
  mountLaser();
  scanAt(10.0);  // before the odometry begins
  transformAt(10.1, "odom", "base_link", {});
  for (int i = 1; i < 20; ++i) transformAt(10.1 + 0.1 * i, "odom", "base_link", {0.1 * i, 0, 0});
  scanAt(11.05);
  scanAt(12.5);  // after it has ended
  const auto found = read();
  ASSERT_EQ(found.size(), 3U);
  EXPECT_FALSE(found[0].T_odom_base.has_value());
  EXPECT_TRUE(found[0].T_base_sensor.has_value());
  EXPECT_NEAR(released_[0], 11.05, 0.06);
  EXPECT_NEAR(found[1].T_odom_base->x(), 0.95, 1e-6);
  EXPECT_FALSE(found[2].T_odom_base.has_value());
}

TEST_F(BagScansTest, TakeScansOfABagWithoutTransforms) {
  scanAt(10.0);
  scanAt(12.0);
  const auto found = read();
  ASSERT_EQ(found.size(), 2U);
  EXPECT_FALSE(found[0].T_base_sensor.has_value());
}

TEST_F(BagScansTest, LeaveTheWheelsAlone) {
  mountLaser();
  transformAt(10.0, "odom", "base_link", {});
  scanAt(10.1, 0.01F);
  transformAt(11.0, "odom", "base_link", {1.0, 0.0, 0.0});
  const auto found = read(/*use_wheels=*/false);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_FALSE(found[0].T_odom_base.has_value());
  EXPECT_TRUE(found[0].scan.sensorMotion().empty());
}

TEST_F(BagScansTest, CountMalformedScansByReason) {
  mountLaser();
  transformAt(10.0, "odom", "base_link", {});
  sensor_msgs::LaserScan scan;
  scan.header.stamp = ros::Time(10.1);
  scan.header.frame_id = "laser";
  scan.angle_increment = 0.1F;
  scan.range_max = 10.0F;
  write(scan);  // no beams
  scan.ranges.assign(3, 1.0F);
  scan.intensities.assign(2, 1.0F);
  write(scan);
  scan.intensities.clear();
  scan.angle_increment = std::numeric_limits<float>::quiet_NaN();
  write(scan);
  scanAt(10.2);
  transformAt(10.3, "odom", "base_link", {});
  EXPECT_EQ(read().size(), 1U);
  EXPECT_EQ(scans_, 4U);
  EXPECT_EQ(dropped_.size(), 3U);
  EXPECT_THAT(dropped_, Contains(Pair("2 intensities for 3 ranges", 1U)));
}

TEST_F(BagScansTest, ReadAnUpsideDownScannerAsAnUprightOne) {
  tf2_msgs::TFMessage message;
  message.transforms.resize(1);
  message.transforms[0].header.stamp = ros::Time(10.0);
  message.transforms[0].header.frame_id = "base_link";
  message.transforms[0].child_frame_id = "laser";
  message.transforms[0].transform.rotation.x = 1.0;  // half a turn about x
  bag_.write("/tf_static", ros::Time(10.0), message);
  transformAt(10.0, "odom", "base_link", {});
  scanAt(10.1);
  transformAt(10.2, "odom", "base_link", {});
  const auto found = read();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].scan.geometry()->angles().back(), -1.0, 1e-6);
}

TEST_F(BagScansTest, NameTheTopicsThatThereAre) {
  scanAt(10.0);
  bag_.close();
  pipeline::OfflineConfig config;
  config.scans = {"front"};
  const auto error = errorOf([&] { BagScans(folder_.path("a.bag"), config, true); });
  EXPECT_THAT(error.source(), HasSubstr("a.bag"));
  EXPECT_EQ(error.reason(), "no sensor_msgs/LaserScan on /front; there are: /scan");
}

TEST_F(BagScansTest, RefuseWhatIsNoBag) {
  for (const std::string& path : {folder_.write("b.bag", "not a bag"), folder_.path("none.bag")}) {
    EXPECT_EQ(errorOf([&] { BagScans(path, {}, true); }).source(), path);
  }
}

}  // namespace
}  // namespace sightline::bridge
