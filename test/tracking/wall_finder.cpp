#include "sightline/tracking/wall_finder.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "numeric_jacobian.h"
#include "sightline/motion/sweep.h"
#include "simulated_room.h"

namespace sightline::tracking {
namespace {

using geometry::Pose2;

const char* const kHall = "rooms: {hall: {size: [6.0, 4.0]}}";
const std::vector<world::WallIndex> kWalls{{0, 0}, {0, 1}, {0, 2}, {0, 3}};

TrackerConfig wallsAsDrawn() {
  TrackerConfig config;
  config.wall.position_sigma = 0.0;
  config.wall.direction_sigma = 0.0;
  return config;
}

PoseFilter filterAt(const TrackerConfig& config, const Pose2& pose) {
  return {config.odometry, {pose, Eigen::Vector3d(0.01, 0.01, 0.003).asDiagonal()}};
}

TEST(WallFinder, FindsTheWallsFromAVaguePose) {
  const TrackerConfig config = wallsAsDrawn();
  test::SimulatedRooms rooms(kHall);
  const Pose2 truth(0.4, -0.3, 0.6);
  const Sweep sweep = readSweep(rooms.look(truth, 1), {});
  const auto walls = WallFinder(config)
                         .find(filterAt(config, {0.5, -0.2, 0.65}), rooms.map, kWalls, sweep)
                         .front();
  int found = 0;
  for (const WallFit& wall : walls) {
    if (!wall.fit) continue;
    ++found;
    const auto expected =
        geometry::transform(truth.inverse(), rooms.map.rooms()[0].walls[wall.wall].segment.line());
    const Eigen::Vector2d error = geometry::difference(wall.fit->line, expected);
    EXPECT_LT(std::abs(error[0]), 5.0 * std::sqrt(wall.fit->line.covariance(0, 0)));
    EXPECT_LT(std::abs(error[1]), 5.0 * std::sqrt(wall.fit->line.covariance(1, 1)));
  }
  EXPECT_GE(found, 3);
}

// Mean NEES of the fits of all walls in scans from one pose.
double meanNees(test::SimulatedRooms& rooms, const Pose2& truth, int scans, int least_fits) {
  const TrackerConfig config = wallsAsDrawn();
  double sum = 0.0;
  int count = 0;
  for (int i = 0; i < scans; ++i) {
    const Sweep sweep = readSweep(rooms.look(truth, i + 1), {});
    const auto found = WallFinder(config).find(filterAt(config, truth), rooms.map, kWalls, sweep);
    for (const auto& wall : found.front()) {
      if (!wall.fit) continue;
      const auto expected = geometry::transform(
          truth.inverse(), rooms.map.rooms()[0].walls[wall.wall].segment.line());
      sum += test::normalisedSquare<2>(geometry::difference(wall.fit->line, expected),
                                       wall.fit->line.covariance);
      ++count;
    }
  }
  EXPECT_GT(count, least_fits);
  return sum / count;
}

TEST(WallFinder, CovarianceOfItsFitsHolds) {
  test::SimulatedRooms rooms(kHall, 5);
  const double nees = meanNees(rooms, {0.4, -0.3, 0.6}, 400, 1000);
  // Residuals that exceed the noise widen the covariance, never the other way: a little below two.
  EXPECT_GT(nees, 1.7);
  EXPECT_LT(nees, 2.1);
}

// Of a wall that leaves the reach of the sensor, the beams at the limit return only what noise
// brings nearer.
TEST(WallFinder, AWallThatLeavesTheReachIsNotTurned) {
  simulation::ScannerProfile profile = test::SimulatedRooms::profile();
  profile.range_max = 2.5;
  profile.noise.sigma = 0.04;
  test::SimulatedRooms rooms(kHall, 7, profile);
  EXPECT_LT(meanNees(rooms, {0.0, 0.4, 0.6}, 400, 300), 2.2);
}

TEST(WallFinder, ABeamBelongsToOneWall) {
  const TrackerConfig config = wallsAsDrawn();
  test::SimulatedRooms rooms(kHall);
  const Pose2 truth(2.5, 1.5, 0.8);
  const Sweep sweep = readSweep(rooms.look(truth, 1), {});
  std::vector<int> uses(sweep.points.size(), 0);
  const auto found = WallFinder(config).find(filterAt(config, truth), rooms.map, kWalls, sweep);
  for (const auto& wall : found.front()) {
    if (!wall.fit) continue;
    for (const std::size_t beam : wall.fit->accepted_beams) ++uses[beam];
  }
  EXPECT_LE(*std::max_element(uses.begin(), uses.end()), 1);
  EXPECT_GT(std::accumulate(uses.begin(), uses.end(), 0), 300);
}

TEST(WallFinder, MotionJacobianIsTheDerivativeOfTheFit) {
  const TrackerConfig config = wallsAsDrawn();
  simulation::ScannerProfile profile = test::SimulatedRooms::profile();
  profile.rate = 5.0;
  profile.revolution = 0.1;
  const test::SimulatedRooms rooms(kHall);
  const Pose2 truth(0.4, -0.3, 0.6);
  const scan::Scan still =
      simulation::Scanner(profile, {}, 1).sweep(rooms.world, 1, [&](std::int64_t) {
        return truth;
      });
  const auto fitWith = [&](const Eigen::Vector3d& motion) {
    scan::Scan scan = still;
    scan.setSensorMotion(motion::sweepMotion(*scan.geometry(), Pose2(motion), {}));
    return WallFinder(config)
        .find(filterAt(config, truth), rooms.map, kWalls, readSweep(scan, {}))
        .front();
  };
  const Eigen::Vector3d motion(0.002, 0.001, 0.001);
  const auto reference = fitWith(motion);
  for (std::size_t i = 0; i < reference.size(); ++i) {
    if (!reference[i].fit) continue;
    const auto line = [&](const Eigen::Vector3d& m) -> Eigen::Vector2d {
      const auto fit = fitWith(m)[i].fit.value().line;
      return {fit.rho, fit.phi};
    };
    const auto numeric = test::numericJacobian<2, 3>(
        line, motion,
        [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) -> Eigen::Vector2d { return a - b; },
        1e-5);
    // A constant velocity moves each knot by its share.
    Eigen::Matrix<double, 2, 3> by_twist = Eigen::Matrix<double, 2, 3>::Zero();
    for (int knot = 0; knot < kKnots; ++knot) {
      by_twist += (knot + 1.0) / kKnots * reference[i].fit->motion_jacobian.middleCols<3>(3 * knot);
    }
    EXPECT_LT((by_twist - numeric).norm(), 0.05 * numeric.norm()) << "wall " << i;
  }
}

// A shelf of 0.3 m along the whole north wall, in a gate that is open for both, weighs as much as
// the wall in the south, and the two contradict each other: that the robot is where it is believed
// to be, with a shelf before the wall, is one of the choices.
TEST(WallFinder, AShelfThatContradictsAWallLeavesTheWall) {
  const TrackerConfig config = wallsAsDrawn();
  const world::RoomMap map(config::Node::parse(kHall, "rooms"));
  test::SimulatedRooms with_shelf("rooms: {hall: {size: [6.0, 3.7], pose: [0.0, -0.15, 0.0]}}");
  const Pose2 truth(0.4, -0.3, 0.6);
  const PoseFilter vague(config.odometry, {truth, Eigen::Vector3d(0.09, 0.09, 0.01).asDiagonal()});
  const Sweep sweep = readSweep(with_shelf.look(truth, 1), {});
  const auto choices = WallFinder(config).find(vague, map, kWalls, sweep);
  EXPECT_GT(choices.size(), 1U);
  EXPECT_TRUE(std::any_of(choices.begin(), choices.end(),
                          [](const auto& fits) { return fits[0].fit && !fits[2].fit; }));
  EXPECT_EQ(WallFinder(config).find(vague, map, kWalls, sweep, WallFinder::Lines::kHeaviest).size(),
            1U);
}

TEST(WallFinder, NoBeamsNoWalls) {
  const TrackerConfig config = wallsAsDrawn();
  const test::SimulatedRooms rooms(kHall);
  const auto found = WallFinder(config).find(filterAt(config, {}), rooms.map, kWalls, {});
  for (const auto& wall : found.front()) {
    EXPECT_FALSE(wall.fit);
    EXPECT_EQ(wall.refusal, WallRefusal::kTooFewBeams);
    EXPECT_EQ(wall.beams_in_gate, 0U);
  }
}

}  // namespace
}  // namespace sightline::tracking
