#include "sightline/tracking/jamb_finder.h"

#include <cmath>
#include <cstdint>

#include <gtest/gtest.h>

#include "sightline/tracking/pose_track.h"
#include "simulated_room.h"

namespace sightline::tracking {
namespace {

using geometry::Pose2;

// A corridor without ends in sight, and offices beside it.
const char* const kEndless = R"(
rooms:
  corridor: {size: [60.0, 2.3]}
  a: {size: [3.0, 3.0], pose: [0.0, 2.77, 0.0]}
  b: {size: [3.0, 3.0], pose: [4.0, 2.77, 0.0]}
doors:
  - {between: [corridor, a], at: [0.0, 1.21], width: 0.9}
  - {between: [corridor, b], at: [4.0, 1.21], width: 0.9}
)";

geometry::UncertainPose2 about(const Pose2& pose, double along) {
  return {pose, Eigen::Vector3d(along * along, 1e-4, 1e-5).asDiagonal()};
}

class JambFinderTest : public ::testing::Test {
 protected:
  std::vector<SeenJamb> jambsFrom(const Pose2& truth, const geometry::UncertainPose2& believed) {
    const TrackerConfig config;
    const Sweep sweep = readSweep(rooms_.look(truth, 0), {});
    return findJambs(config, PoseFilter(config.odometry, believed), rooms_.map, 0, sweep);
  }

  test::SimulatedRooms rooms_{kEndless};
};

TEST_F(JambFinderTest, SeesJambsWhereTheyAre) {
  const Pose2 truth(-1.2, 0.1, 0.1);
  const auto jambs = jambsFrom(truth, about(truth, 0.1));
  ASSERT_GE(jambs.size(), 1U);
  for (const SeenJamb& seen : jambs) {
    const auto expected = geometry::transform(truth.inverse(), seen.jamb.lineIn(rooms_.map));
    const auto line = geometry::describedLike(expected, seen.line);
    EXPECT_NEAR(line.rho, expected.rho, 0.05);
    EXPECT_NEAR(geometry::wrapAngle(line.phi - expected.phi), 0.0, 1e-6);
  }
}

TEST_F(JambFinderTest, FindsNoneWhereTheDoorIsShut) {
  test::SimulatedRooms shut("rooms:\n  corridor: {size: [60.0, 2.3]}\n");
  const Pose2 truth(-1.2, 0.1, 0.1);
  const TrackerConfig config;
  const Sweep sweep = readSweep(shut.look(truth, 0), {});
  EXPECT_TRUE(
      findJambs(config, PoseFilter(config.odometry, about(truth, 0.1)), rooms_.map, 0, sweep)
          .empty());
}

// A track without rivals, from one place to another, told of its motion exactly.
class JambTrackTest : public JambFinderTest {
 protected:
  geometry::UncertainPose2 trackedFrom(Pose2 truth, const geometry::UncertainPose2& believed,
                                       const Pose2& step, int scans) {
    const TrackingContext context{config_, rooms_.map};
    PoseTrack track(context, believed, 0);
    for (int i = 0; i < scans; ++i) {
      const scan::Scan scan = rooms_.look(truth, std::int64_t{100'000'000} * (i + 1));
      track.update(context, {scan, truth, {}});
      truth_ = truth;
      truth = truth * step;
    }
    return track.pose();
  }

  TrackerConfig config_;
  Pose2 truth_;  // at the last scan
};

TEST_F(JambTrackTest, CorrectThePoseAlongACorridorWithoutEnds) {
  config_.neighbours = false;
  const Pose2 start(-2.0, 0.1, 0.05);
  for (const bool are_landmarks : {true, false}) {
    config_.doors.are_landmarks = are_landmarks;
    const auto pose =
        trackedFrom(start, about(Pose2(0.15, 0.0, 0.0) * start, 0.2), {0.03, 0.0, 0.0}, 40);
    const double error = pose.mean.x() - truth_.x();
    const double sigma = std::sqrt(pose.covariance(0, 0));
    EXPECT_EQ(sigma < 0.1, are_landmarks) << sigma;
    EXPECT_LT(std::abs(error), are_landmarks ? 0.05 : 0.3);
    EXPECT_LT(std::abs(error), 3.0 * sigma);
  }
}

TEST_F(JambTrackTest, StandingDoesNotMakeTheMapBetter) {
  config_.neighbours = false;
  config_.doors.asked_from = 0.0;
  const Pose2 truth(-1.2, 0.1, 0.05);
  const auto pose = trackedFrom(truth, about(truth, 0.2), {}, 100);
  EXPECT_GT(std::sqrt(pose.covariance(0, 0)), 0.5 * config_.doors.position_sigma);
}

}  // namespace
}  // namespace sightline::tracking
