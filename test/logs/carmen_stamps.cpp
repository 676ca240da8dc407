#include "sightline/logs/carmen_stamps.h"

#include <algorithm>

#include <gmock/gmock.h>

#include "sightline/logs/carmen_odometry.h"
#include "temporary_folder.h"

namespace sightline::logs {
namespace {

using testing::ElementsAre;

constexpr std::int64_t kTenth = 100'000'000;  // ns

CarmenLog logStamped(const std::vector<std::int64_t>& stamps) {
  CarmenLog log;
  for (const std::int64_t stamp : stamps) {
    CarmenLaser laser;
    laser.stamp = stamp;
    laser.robot = geometry::Pose2(static_cast<double>(log.scans.size()), 0.0, 0.0);
    log.scans.push_back(laser);
  }
  return log;
}

bool rise(const std::vector<std::int64_t>& stamps) {
  return std::adjacent_find(stamps.begin(), stamps.end(), std::greater_equal<>()) == stamps.end();
}

TEST(RisingStamps, AreTheLoggedOnesWhereTheseRise) {
  const CarmenLog log = logStamped({50 * kTenth, 52 * kTenth, 53 * kTenth});
  EXPECT_TRUE(hasUsableStamps(log));
  EXPECT_THAT(risingStamps(log), ElementsAre(50 * kTenth, 52 * kTenth, 53 * kTenth));
}

TEST(RisingStamps, ShareTheirMeanWhereTheyAreOutOfOrder) {
  const CarmenLog log = logStamped({50 * kTenth, 56 * kTenth, 52 * kTenth, 60 * kTenth});
  EXPECT_FALSE(hasUsableStamps(log));
  EXPECT_EQ(countNotRising(log), 1U);
  const auto stamps = risingStamps(log);
  EXPECT_EQ(stamps.front(), 50 * kTenth);
  EXPECT_EQ(stamps.back(), 60 * kTenth);
  EXPECT_EQ((stamps[1] + stamps[2]) / 2, 54 * kTenth);
  EXPECT_TRUE(rise(stamps));
}

TEST(RisingStamps, OfALogWithoutTimesAreASecondApartAndAfter1970) {
  for (const std::int64_t stamp : {std::int64_t{0}, -7000 * kTenth}) {
    const auto stamps = risingStamps(logStamped({stamp, stamp, stamp}));
    EXPECT_THAT(stamps, ElementsAre(10 * kTenth, 20 * kTenth, 30 * kTenth));
  }
}

TEST(RisingStamps, GoOnWhereTheClockWasSet) {
  const auto stamps = risingStamps(logStamped(
      {50000 * kTenth, 50002 * kTenth, 100 * kTenth, 102 * kTenth, kTenth * 90000 * 86400}));
  EXPECT_THAT(stamps, ElementsAre(50000 * kTenth, 50002 * kTenth, 50004 * kTenth, 50006 * kTenth,
                                  50008 * kTenth));
}

TEST(RisingStamps, AreThoseOfTheOdometryWhereTheLinesLie) {
  CarmenLog log = logStamped({50 * kTenth, 49 * kTenth, 60 * kTenth});
  for (int i = 0; i < 6; ++i) log.odometry.push_back({(50 + i) * kTenth, {9.0, 0.0, 0.0}, {}});
  const auto odometry = odometryOf(log);
  const auto stamps = risingStamps(log);
  ASSERT_EQ(odometry.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(odometry[i].stamp, stamps[i]);
    EXPECT_EQ(odometry[i].robot.x(), static_cast<double>(i));
  }
}

TEST(LoggedStamps, ComeBackFromTheirFile) {
  const test::TemporaryFolder folder;
  writeStamps(folder.path("a.stamps"), {{5'000'001'000, 7'000'000'000}, {6'000'000'000, 4}});
  const Trajectory trajectory{{5'000'001'000, {1.0, 0.0, 0.0}},
                              {5'500'000'000, {2.0, 0.0, 0.0}},
                              {6'000'000'000, {3.0, 0.0, 0.0}}};
  const auto logged = atLoggedStamps(trajectory, readStamps(folder.path("a.stamps")));
  ASSERT_EQ(logged.size(), 2U);
  EXPECT_EQ(logged[0].stamp, 4);
  EXPECT_EQ(logged[0].pose.x(), 3.0);
  EXPECT_EQ(logged[1].stamp, 7'000'000'000);
}

TEST(LoggedStamps, AFileWithoutThemIsAnError) {
  const test::TemporaryFolder folder;
  EXPECT_THROW(readStamps(folder.write("a.stamps", "")), config::Error);
  EXPECT_THROW(readStamps(folder.write("b.stamps", "1.0\n")), config::Error);
  EXPECT_THROW(writeStamps(folder.path("none/a.stamps"), {}), config::Error);
}

}  // namespace
}  // namespace sightline::logs
