#include "sightline/driver/device_check.h"

#include <cmath>

#include <gtest/gtest.h>

#include "sightline/triangulation/projection_geometry.h"
#include "sightline/triangulation/sensor_profile.h"

namespace sightline::driver {
namespace {

using Verdict = CheckResult::Verdict;

// A step in a wall, as the sensor sees it with its head turned.
class DeviceCheckTest : public ::testing::Test {
 protected:
  double depthAt(double direction) const { return direction > 0.05 && has_step_ ? 0.8 : 1.2; }

  std::vector<TimedScan> scans(double head) const {
    const auto& parameters = calibration_.parameters;
    const triangulation::ProjectionGeometry geometry(parameters.intrinsics);
    triangulation::RawScan raw;
    const auto& pattern = *check_geometry_;
    for (std::size_t i = 0; i < pattern.beams(); ++i) {
      const double direction = pattern.angles()[is_reversed_ ? pattern.beams() - 1 - i : i];
      const double range = depthAt(direction + head) / std::cos(direction);
      auto pair = triangulation::photocurrentsAt(geometry.imagePosition(range, direction), 1e-8,
                                                 parameters.intrinsics.detector_length);
      if (is_exchanged_) std::swap(pair.first, pair.second);
      raw.currents.push_back(pair);
      raw.head_angles.push_back(head);
    }
    return std::vector<TimedScan>(10, TimedScan{raw, 0.15});
  }

  triangulation::Calibration calibration_ = triangulation::SensorProfile{}.calibrated();
  DeviceCheck check_{calibration_};
  std::shared_ptr<const scan::ScanGeometry> check_geometry_ =
      triangulation::Ranger(calibration_).geometry();
  bool has_step_ = true;
  bool is_reversed_ = false;
  bool is_exchanged_ = false;
};

TEST_F(DeviceCheckTest, GoodDeviceIsRight) {
  EXPECT_EQ(check_.ofLight(scans(0.0)).verdict, Verdict::kRight);
  EXPECT_EQ(check_.ofTiming(scans(0.0)).verdict, Verdict::kRight);
  const auto head = check_.ofHead(scans(0.0), scans(0.15), 0.15);
  ASSERT_EQ(head.size(), 2U);
  EXPECT_EQ(head[0].verdict, Verdict::kRight) << head[0].found;
  EXPECT_EQ(head[1].verdict, Verdict::kRight) << head[1].found;
}

TEST_F(DeviceCheckTest, ExchangedCurrentsAreNamed) {
  has_step_ = false;
  EXPECT_EQ(check_.ofWall(scans(0.0), 1.2).verdict, Verdict::kRight)
      << check_.ofWall(scans(0.0), 1.2).found;
  is_exchanged_ = true;
  const auto found = check_.ofWall(scans(0.0), 1.2);
  EXPECT_EQ(found.verdict, Verdict::kWrong);
  EXPECT_NE(found.found.find("their order is wrong"), std::string::npos) << found.found;
}

TEST_F(DeviceCheckTest, ReversedSweepIsNamed) {
  is_reversed_ = true;
  const auto found = check_.ofHead(scans(0.0), scans(0.15), 0.15);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[1].verdict, Verdict::kWrong);
  has_step_ = false;
  const auto flat = check_.ofHead(scans(0.0), scans(0.15), 0.15);
  EXPECT_EQ(flat[1].verdict, Verdict::kUndetermined) << flat[1].found;
}

TEST_F(DeviceCheckTest, HeadThatTurnsTheOtherWayIsNamed) {
  const auto found = check_.ofHead(scans(0.0), scans(-0.15), 0.15);
  EXPECT_EQ(found[0].verdict, Verdict::kWrong);
}

TEST_F(DeviceCheckTest, SaturationIsWrong) {
  auto bright = scans(0.0);
  for (std::size_t i = 0; i < 10; ++i) bright[0].scan.currents[i].first = std::nan("");
  EXPECT_EQ(check_.ofLight(bright).verdict, Verdict::kRight) << "a glint";
  for (auto& scan : bright) {
    for (std::size_t i = 0; i < 10; ++i) scan.scan.currents[i].first = std::nan("");
  }
  EXPECT_EQ(check_.ofLight(bright).verdict, Verdict::kWrong);
}

}  // namespace
}  // namespace sightline::driver
