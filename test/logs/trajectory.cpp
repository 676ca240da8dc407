#include "sightline/logs/trajectory.h"

#include <cmath>

#include <gmock/gmock.h>

#include "config_error.h"
#include "temporary_folder.h"

namespace sightline::logs {
namespace {

using geometry::Pose2;
using test::errorOf;
using test::TemporaryFolder;

TEST(Trajectory, ComesBackAsWritten) {
  const TemporaryFolder folder;
  TrajectoryWriter writer(folder.path("a.tum"));
  const std::vector<Pose2> poses = {{1.25, -2.5, 3.0}, {0, 0, -3.1}, {1e-6, 40.0, 0.0}};
  for (std::size_t i = 0; i < poses.size(); ++i) {
    writer.add(1071078718462310000 + static_cast<std::int64_t>(i), poses[i]);
  }
  writer.close();
  const Trajectory read = readTrajectory(folder.path("a.tum"));
  ASSERT_EQ(read.size(), poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    EXPECT_EQ(read[i].stamp, 1071078718462310000 + static_cast<std::int64_t>(i));
    EXPECT_NEAR((read[i].pose.coordinates() - poses[i].coordinates()).norm(), 0.0, 1e-8);
  }
}

TEST(Trajectory, ReadsBothFormsAndSorts) {
  const TemporaryFolder folder;
  const Trajectory read = readTrajectory(
      folder.write("a.tum", "# t x y theta\n2.5 3 4 0.5\n\n1 1 2 9 0 0 1 1 # a quarter turn\n"));
  ASSERT_EQ(read.size(), 2U);
  EXPECT_EQ(read[0].stamp, 1000000000);
  EXPECT_NEAR(read[0].pose.theta(), M_PI / 2, 1e-12);
  EXPECT_EQ(read[1].pose.coordinates(), Eigen::Vector3d(3.0, 4.0, 0.5));
}

TEST(Trajectory, SaysWhatIsWrongAndWhere) {
  const TemporaryFolder folder;
  const auto reason = [&](const std::string& content) {
    const std::string path = folder.write("a.tum", content);
    const std::string what = errorOf([&] { readTrajectory(path); }).what();
    return what.substr(what.find("a.tum"));
  };
  EXPECT_EQ(reason("1 2 3 4\n1 2 3\n"), "a.tum:2: expected 4 or 8 columns, found 3");
  EXPECT_EQ(reason("1 2 three 4\n"), "a.tum:1: a number: expected a number, found 'three'");
  EXPECT_EQ(reason("1 2 nan 4\n"), "a.tum:1: a number: expected a finite number, found 'nan'");
  EXPECT_EQ(reason("x 2 3 4\n"), "a.tum:1: a time: expected a time, found 'x'");
  EXPECT_EQ(reason("# nothing\n"), "a.tum: holds no poses");
  EXPECT_THROW(readTrajectory(folder.path("none")), config::Error);
}

TEST(Trajectory, SaysThatAFileCannotBeWritten) {
  const TemporaryFolder folder;
  EXPECT_THROW(TrajectoryWriter writer(folder.path("none/a.tum")), config::Error);
}

TEST(Relations, AreRead) {
  const TemporaryFolder folder;
  const auto relations =
      readRelations(folder.write("a", "# t1 t2\n1.5 2.5 1 2 9 9 9 0.5\n4 3 0 0 0 0 0 -0.5\n"));
  ASSERT_EQ(relations.size(), 2U);
  EXPECT_EQ(relations[0].first, 1500000000);
  EXPECT_EQ(relations[0].second, 2500000000);
  EXPECT_EQ(relations[0].motion.coordinates(), Eigen::Vector3d(1.0, 2.0, 0.5));
  EXPECT_EQ(errorOf([&] { readRelations(folder.write("b", "1 2 3 4 5 6 7\n")); }).reason(),
            "expected 8 columns, found 7");
  EXPECT_EQ(errorOf([&] { readRelations(folder.write("c", "")); }).reason(), "holds no relations");
}

}  // namespace
}  // namespace sightline::logs
