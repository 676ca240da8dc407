#include "sightline/targets/bearing_detector.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "config_error.h"

namespace sightline::targets {
namespace {

using geometry::kPi;
using geometry::radians;
using testing::DoubleNear;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

constexpr double kBright = 15000.0;

/// A wall 3 m around a scanner, dull, into which things are put by beam.
class BrightScan {
 public:
  BrightScan(double from_degrees, double increment_degrees, std::size_t beams)
      : geometry_(scan::ScanGeometry::uniform(radians(from_degrees), radians(increment_degrees),
                                              beams, 1e-4, 0.1, 30.0)),
        ranges_(beams, 3.0),
        intensities_(beams, 2000.0) {}

  BrightScan& put(double degrees, double range, double intensity = kBright) {
    const double first = geometry::degrees(geometry_->angles().front());
    const double step = geometry::degrees(geometry_->angleIncrement());
    const auto beam = static_cast<std::size_t>(std::lround((degrees - first) / step));
    ranges_.at(beam) = range;
    intensities_.at(beam) = intensity;
    return *this;
  }
  scan::Scan scan() const { return {geometry_, 77, ranges_, intensities_}; }
  scan::Scan withoutIntensities() const { return {geometry_, 77, ranges_}; }

 private:
  std::shared_ptr<const scan::ScanGeometry> geometry_;
  std::vector<double> ranges_;
  std::vector<double> intensities_;
};

BrightScan usual() {
  return {-135.0, 1.0, 271};
}

auto near(double degrees, double tolerance = 1e-9) {
  return DoubleNear(radians(degrees), tolerance);
}

TEST(BearingDetector, MakesOneBearingOfACluster) {
  const BearingSet set =
      BearingDetector().detect(usual().put(10, 2.0).put(11, 2.0).put(12, 2.0).put(-60, 4.0).scan());
  EXPECT_THAT(set.bearings, UnorderedElementsAre(near(11.0), near(-60.0)));
  EXPECT_EQ(set.stamp, 77);
  EXPECT_EQ(set.range_max, 5.0);
  EXPECT_NEAR(set.sigma, radians(1.0) / std::sqrt(12.0), 1e-12);
}

TEST(BearingDetector, ASetWithoutBearingsIsOne) {
  const BearingSet set = BearingDetector().detect(usual().scan());
  EXPECT_THAT(set.bearings, IsEmpty());
  EXPECT_NEAR(set.field_of_view.max, radians(135.0), 1e-9);
}

TEST(BearingDetector, TellsTargetsApartByRangeAndByBearing) {
  // Neighbours in bearing, apart in range; and a pair within the diameter around one behind it.
  EXPECT_EQ(BearingDetector().detect(usual().put(10, 2.0).put(11, 2.5).scan()).bearings.size(), 2u);
  EXPECT_THAT(
      BearingDetector().detect(usual().put(10, 2.0).put(11, 4.0).put(12, 2.0).scan()).bearings,
      UnorderedElementsAre(near(11.0), near(11.0)));
  EXPECT_EQ(BearingDetector().detect(usual().put(10, 2.0).put(16, 2.0).scan()).bearings.size(), 2u);
}

TEST(BearingDetector, NoClusterIsWiderThanItsDiameter) {
  BrightScan wide = usual();
  for (int degrees = -20; degrees <= 20; ++degrees) wide.put(degrees, 2.0);
  BearingDetectorConfig config;
  config.cluster_diameter = 0.2;
  // 41 beams 35 mm apart, six of them within 0.2 m.
  EXPECT_EQ(BearingDetector(config).detect(wide.scan()).bearings.size(), 7u);
}

TEST(BearingDetector, LeavesOutWhatIsDullOrFarOrNoRange) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  BearingDetectorConfig config;
  config.range_min = 0.5;
  const BearingSet set = BearingDetector(config).detect(usual()
                                                            .put(0, 2.0, 10999.0)
                                                            .put(20, 5.1)
                                                            .put(30, 0.4)
                                                            .put(40, nan)
                                                            .put(50, infinity)
                                                            .put(60, 2.0, nan)
                                                            .put(70, -infinity)
                                                            .put(80, 2.0, 11000.0)
                                                            .scan());
  EXPECT_THAT(set.bearings, ElementsAre(near(80.0)));
}

TEST(BearingDetector, KeepsToTheFieldOfViewOfScannerAndSettings) {
  BearingDetectorConfig config;
  config.field_of_view = {-1.0, radians(30.0)};
  const BearingSet set = BearingDetector(config).detect(
      usual().put(30, 2.0).put(31, 3.0).put(-57, 2.0).put(-58, 4.0).scan());
  EXPECT_THAT(set.bearings, UnorderedElementsAre(near(30.0), near(-57.0)));
  EXPECT_EQ(set.field_of_view.min, -1.0);
  const BearingSet narrow = BearingDetector(config).detect(BrightScan(-20.0, 1.0, 31).scan());
  EXPECT_NEAR(narrow.field_of_view.min, radians(-20.0), 1e-9);
  EXPECT_NEAR(narrow.field_of_view.max, radians(10.0), 1e-9);
  EXPECT_THROW(BearingDetector(config).detect(BrightScan(60.0, 1.0, 31).scan()), scan::InvalidScan);
}

TEST(BearingDetector, FindsOneTargetAcrossTheSeamOfATurn) {
  BearingDetectorConfig config;
  config.field_of_view = {-kPi, kPi};
  // Full turns that begin behind the sensor, and ahead of it.
  for (const double first : {-180.0, 0.0}) {
    BrightScan turn(first, 1.0, 360);
    for (const double degrees : {-2.0, -1.0, 0.0, 1.0, 2.0}) {
      turn.put(degrees + first + (degrees < 0.0 ? 360.0 : 0.0), 1.5);
    }
    const BearingSet set = BearingDetector(config).detect(turn.scan());
    ASSERT_EQ(set.bearings.size(), 1u) << first;
    EXPECT_NEAR(geometry::wrapAngle(set.bearings[0] - radians(first)), 0.0, 1e-9);
    EXPECT_EQ(set.field_of_view.min, -kPi);
  }
}

TEST(BearingDetector, TakesAnglesThatCountOnBeyondHalfATurn) {
  BearingDetectorConfig config;
  config.field_of_view = {-kPi, kPi};
  // From 225 to 315 degrees, which is to the right.
  const BearingSet set =
      BearingDetector(config).detect(BrightScan(225.0, 1.0, 91).put(270.0, 2.0).scan());
  EXPECT_THAT(set.bearings, ElementsAre(near(-90.0)));
  EXPECT_NEAR(set.field_of_view.min, radians(-135.0), 1e-9);
  EXPECT_NEAR(set.field_of_view.max, radians(-45.0), 1e-9);
}

TEST(BearingDetector, TakesAScannerThatTurnsClockwise) {
  const BearingSet set = BearingDetector().detect(BrightScan(90.0, -1.0, 181).put(10, 2.0).scan());
  EXPECT_THAT(set.bearings, ElementsAre(near(10.0)));
  EXPECT_NEAR(set.field_of_view.max, radians(90.0), 1e-9);
}

TEST(BearingDetector, TakesTheMotionWithinTheSweepOut) {
  scan::Scan scan = usual().put(45, 2.0).scan();
  std::vector<geometry::Pose2> motion;
  for (std::size_t i = 0; i < scan.beams(); ++i) motion.emplace_back(0.0, 0.0, 1e-4 * i);
  scan.setSensorMotion(motion);
  EXPECT_THAT(BearingDetector().detect(scan).bearings,
              ElementsAre(DoubleNear(radians(45.0) + 180 * 1e-4, 1e-9)));
}

TEST(BearingDetector, RefusesScansWithoutIntensities) {
  EXPECT_THROW(BearingDetector().detect(usual().withoutIntensities()), scan::InvalidScan);
  EXPECT_THROW(BearingDetector().detect(scan::Scan()), scan::InvalidScan);
}

TEST(BearingDetector, RefusesSettingsThatDoNotFit) {
  BearingDetectorConfig config;
  config.range_min = 6.0;
  EXPECT_EQ(test::errorOf([&] { config.check("s"); }).key(), "range_min");
  config = {};
  config.field_of_view = {1.0, 1.0};
  EXPECT_EQ(test::errorOf([&] { config.check("s"); }).key(), "field_of_view");
  config = {};
  config.cluster_diameter = -1.0;
  EXPECT_EQ(test::errorOf([&] { config.check("s"); }).key(), "cluster_diameter");
}

}  // namespace
}  // namespace sightline::targets
