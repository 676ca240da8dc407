#include "sightline/logs/mrclam.h"

#include <gtest/gtest.h>

#include "config_error.h"
#include "temporary_folder.h"

namespace sightline::logs {
namespace {

void writeSet(const test::TemporaryFolder& folder, const std::string& measurements) {
  folder.write("Barcodes.dat", "# Subject #    Barcode #\n  1 \t   5\n  6 \t  72\n");
  folder.write("Landmark_Groundtruth.dat", "# head\n  6 \t 0.5 \t -4.25 \t 0.0001 \t 0.0002\n");
  folder.write("Robot1_Groundtruth.dat",
               "10.000 \t 1.0 \t 2.0 \t 0.5\n10.100 \t 1.1 \t 2.0 \t 0.5\n");
  folder.write("Robot1_Odometry.dat", "10.000 \t 0.1 \t -0.4\n");
  folder.write("Robot1_Measurement.dat", measurements);
}

TEST(Mrclam, ReadsAFolder) {
  const test::TemporaryFolder folder;
  writeSet(folder,
           "# head\n10.050 \t 72 \t 3.5 \t -0.25\n10.051 \t 99 \t 2.0 \t 0.1\n10.290 \t 5 \t 1.0 "
           "\t 0.0\n");
  const MrclamSet set = readMrclam(folder.path(""));
  ASSERT_EQ(set.robots.size(), 1U);
  ASSERT_EQ(set.landmarks.size(), 1U);
  EXPECT_EQ(set.landmarks[0].place.y(), -4.25);
  const MrclamRobot& robot = set.robots[0];
  EXPECT_EQ(robot.truth.size(), 2U);
  ASSERT_EQ(robot.looks.size(), 2U) << "sightings a millisecond apart are of one image";
  EXPECT_EQ(robot.looks[0].stamp, 10'050'000'000);
  EXPECT_EQ(robot.looks[0].sightings[0].subject, 6);
  EXPECT_EQ(robot.looks[0].sightings[1].subject, 0);
  EXPECT_EQ(robot.looks[1].sightings[0].subject, 1);
  EXPECT_EQ(robot.velocities[0].angular, -0.4);
}

TEST(Mrclam, NamesFileAndLine) {
  const test::TemporaryFolder folder;
  writeSet(folder, "10.050 \t 72 \t 3.5 \t -0.25\n10.290 \t 72 \t x \t 0.1\n");
  const auto error = test::errorOf([&] { readMrclam(folder.path("")); });
  EXPECT_EQ(error.line(), 2);
  EXPECT_NE(error.source().find("Robot1_Measurement.dat"), std::string::npos);
  const test::TemporaryFolder empty;
  EXPECT_NE(test::errorOf([&] { readMrclam(empty.path("")); }).source().find("Barcodes.dat"),
            std::string::npos);
}

TEST(Mrclam, PutsEmptyLooksBack) {
  std::vector<MrclamLook> looks;
  for (const int image : {0, 1, 2, 3, 4, 5, 9, 10, 11, 12, 13, 16}) {
    looks.push_back({1'000'000'000 + 235'000'000LL * image, {{6, 1.0, 0.1}}});
  }
  const std::int64_t period = cameraPeriod(looks);
  EXPECT_EQ(period, 235'000'000);
  const auto all = withEmptyLooks(looks, period);
  ASSERT_EQ(all.size(), 17U);
  EXPECT_TRUE(all[6].sightings.empty());
  EXPECT_EQ(all[6].stamp, 1'000'000'000 + 235'000'000LL * 6);
  EXPECT_EQ(all[9].sightings.size(), 1U);
  EXPECT_EQ(withEmptyLooks(looks, 0).size(), looks.size());
}

}  // namespace
}  // namespace sightline::logs
