#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "bench/figures.h"
#include "bench/rooms/recorded_drive.h"
#include "mapped_floor.h"
#include "sightline/mapping/path_adjuster.h"

namespace sightline::bench {

/// Four corridors round a block, 2 m wide and with a door niche here and there, 220 m along the
/// middle; driven round once, and on along the first corridor.
class CorridorRing {
 public:
  explicit CorridorRing(std::uint64_t seed) : random_(seed) {
    addBlock(-1.0);
    addBlock(1.0);
  }

  DriveSetup drive() const {
    DriveSetup setup;
    setup.world = world_;
    setup.start = {5.0, 0.0, 0.0};
    setup.path.speed = 0.8;
    setup.path.turn_rate = 0.8;
    setup.path.waypoints_map = {
        {kLength, 0.0}, {kLength, kDepth}, {0.0, kDepth}, {0.0, 0.0}, {40.0, 0.0}};
    setup.scanner.beams = 361;
    setup.scanner.angle_min = -0.5 * geometry::kPi;
    setup.scanner.angle_max = 0.5 * geometry::kPi;
    setup.scanner.range_max = 20.0;
    setup.scanner.rate = 5.0;
    setup.scanner.noise.sigma = 0.01;
    setup.robot.odometry.scale_mean = 0.97;
    setup.robot.odometry.scale_sigma = 0.0;
    setup.seconds = (2.0 * (kLength + kDepth) + 36.0) / setup.path.speed + 25.0;
    return setup;
  }

 private:
  static constexpr double kLength = 72.0;
  static constexpr double kDepth = 38.0;

  double draw(double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(random_);
  }

  // The walls on one side of the middle, `side` metres outwards.
  void addBlock(double side) {
    const Eigen::Vector2d corners[4] = {{-side, -side},
                                        {kLength + side, -side},
                                        {kLength + side, kDepth + side},
                                        {-side, kDepth + side}};
    for (int i = 0; i < 4; ++i) addWall(corners[i], corners[(i + 1) % 4], side);
  }

  // With niches as deep as a door frame, 4 to 12 m apart.
  void addWall(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double side) {
    const Eigen::Vector2d along = (to - from).normalized();
    const Eigen::Vector2d outwards = side * Eigen::Vector2d(along.y(), -along.x());
    const double length = (to - from).norm();
    Eigen::Vector2d last = from;
    for (double at = draw(2.0, 8.0); at + 2.0 < length; at += draw(4.0, 12.0)) {
      const Eigen::Vector2d begin = from + at * along;
      const Eigen::Vector2d end = begin + 0.9 * along;
      const Eigen::Vector2d deep = draw(0.08, 0.3) * outwards;
      for (const auto& [a, b] :
           {std::pair(last, begin), std::pair(begin, Eigen::Vector2d(begin + deep)),
            std::pair(Eigen::Vector2d(begin + deep), Eigen::Vector2d(end + deep)),
            std::pair(Eigen::Vector2d(end + deep), end)}) {
        add(a, b);
      }
      last = end;
    }
    add(last, to);
  }

  void add(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    world::WorldSegment wall;
    wall.segment = {a, b};
    world_.add(wall);
  }

  std::mt19937_64 random_;
  world::World world_;
};

/// Loops of an adjusted path that join places which are not one: off by five standard deviations
/// and more in what they claim to tell, which along a corridor is little.
inline std::size_t falseLoops(const mapping::Survey& survey, const mapping::AdjustedPath& path,
                              const RecordedDrive& drive) {
  std::vector<geometry::Pose2> truth(survey.keys().size());
  for (auto point = survey.path().rbegin(); point != survey.path().rend(); ++point) {
    truth[point->key] = *drive.truth.at(point->stamp);  // the first scan of a key scan comes last
  }
  return static_cast<std::size_t>(std::count_if(
      path.relations.begin(), path.relations.end(), [&](const mapping::Relation& relation) {
        const auto step = geometry::between(truth[relation.from], truth[relation.to]);
        const Eigen::Vector3d off =
            relation.T_from_to.coordinates() - geometry::Pose2(step).coordinates();
        const Eigen::Vector3d error(off.x(), off.y(), geometry::wrapAngle(off.z()));
        return relation.is_loop && error.dot(relation.information * error) > 75.0;
      }));
}

/// Error of the last pose, seen from where the path first came by.
inline double closingError(const std::vector<geometry::StampedPose2>& poses,
                           const RecordedDrive& drive) {
  const auto truthAt = [&](const geometry::StampedPose2& pose) {
    return *drive.truth.at(pose.stamp);
  };
  const geometry::Pose2 end = truthAt(poses.back());
  const auto half = poses.begin() + static_cast<std::ptrdiff_t>(poses.size() / 2);
  const auto first = std::min_element(poses.begin(), half, [&](const auto& a, const auto& b) {
    return (truthAt(a).translation() - end.translation()).norm() <
           (truthAt(b).translation() - end.translation()).norm();
  });
  const auto step = geometry::between(truthAt(*first), end);
  const auto found = geometry::between(first->pose, poses.back().pose);
  return (step.translation() - found.translation()).norm();
}

inline void printLoops(std::uint64_t first, std::uint64_t seeds) {
  double closed = 0.0;
  double worst = 0.0;
  double false_loops = 0.0;
  double loops = 0.0;
  for (std::uint64_t seed = first; seed < first + seeds; ++seed) {
    const DriveSetup setup = CorridorRing(seed).drive();
    const RecordedDrive drive = recordDrive(setup, seed);
    const mapping::Survey survey = test::surveyOf(drive, {});
    const auto path = mapping::PathAdjuster(survey.keys(), {}).adjust();
    const auto poses = mapping::posesOf(survey.path(), survey.keys(), path.keys);
    const double off = closingError(poses, drive);
    worst = std::max(worst, off);
    closed += off < 0.3 ? 100.0 / static_cast<double>(seeds) : 0.0;
    false_loops += static_cast<double>(falseLoops(survey, path, drive));
    loops += static_cast<double>(path.loops) / static_cast<double>(seeds);
  }
  print("mapping.loop_200m.closed", closed, "%");
  print("mapping.loop_200m.end_m", worst, "m");
  print("mapping.loop_200m.loops", loops, "1");
  print("mapping.loop_200m.false_loops", false_loops, "1");
}

}  // namespace sightline::bench
