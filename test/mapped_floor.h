#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "bench/rooms/recorded_drive.h"
#include "scripted_transforms.h"
#include "sightline/fitting/rigid_alignment.h"
#include "sightline/mapping/room_fitter.h"
#include "sightline/pipeline/scan_feed.h"

/// Rooms fitted to a simulated drive, against the floor that was driven.
namespace sightline::test {

/// Hands the scans of a drive to `take`, located as those of a recording are, with the settings
/// shipped.
template <class Take>
void readDrive(const bench::RecordedDrive& drive, const geometry::Pose2& T_base_sensor,
               bool with_wheels, const Take& take) {
  ScriptedTransforms transforms;
  transforms.mount("", T_base_sensor);
  pipeline::FeedNeeds needs;
  needs.odometry = with_wheels;
  pipeline::ScanFeed feed({}, {}, needs, transforms);
  feed.addScanner();
  const auto takeAll = [&](auto next) {
    while (auto result = next()) {
      if (result->located) take(std::move(*result->located));
    }
  };
  std::size_t reported = 0;
  for (const bench::RecordedDrive::Sweep& sweep : drive.sweeps) {
    for (; with_wheels && reported < drive.odometry.size() &&
           drive.odometry[reported].stamp <= sweep.arrival;
         ++reported) {
      transforms.drive(drive.odometry[reported].stamp, drive.odometry[reported].pose);
    }
    feed.add(0, sweep.scan, sweep.arrival);
    takeAll([&] { return feed.next(sweep.arrival); });
  }
  takeAll([&] { return feed.flush(); });
}

inline mapping::Survey surveyOf(const bench::RecordedDrive& drive,
                                const geometry::Pose2& T_base_sensor, bool with_wheels = true) {
  mapping::Survey survey{pipeline::EstimatorsConfig()};
  readDrive(drive, T_base_sensor, with_wheels,
            [&](pipeline::LocatedScan located) { survey.take(std::move(located)); });
  return survey;
}

/// From the frame of fitted rooms to that of the truth, by least squares over the path: the first
/// pose may be the one that is off.
inline geometry::Pose2 truthFromFitted(const mapping::FittedRooms& fitted,
                                       const bench::RecordedDrive& drive) {
  std::vector<fitting::PointPair> pairs;
  for (const geometry::StampedPose2& pose : fitted.poses) {
    pairs.push_back({drive.truth.at(pose.stamp)->translation(), pose.pose.translation()});
  }
  return *fitting::alignPoints(pairs);
}

/// A side of a fitted room against the wall that it stands for.
struct SideError {
  double offset = 0.0;  ///< of its middle [m], positive towards the inside, all rooms aligned
  double angle = 0.0;   ///< [rad]
  double nees = 0.0;    ///< 2 expected, all rooms aligned
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  ///< of offset and angle
  Eigen::Vector3d by_frame = Eigen::Vector3d::Zero();  ///< ∂offset/∂(x, y, θ) of the rooms' frame
};

struct FloorErrors {
  std::vector<SideError> sides;
  std::size_t rooms = 0;     ///< of the truth
  std::size_t found = 0;     ///< of them
  std::size_t invented = 0;  ///< fitted rooms of which a room of the truth holds less than half
  std::size_t unmatched_sides = 0;  ///< sides with wall on them where there is none
  std::vector<double> door_place;   ///< [m]
  std::vector<double> door_width;
  std::vector<double> door_nees;  ///< 2 expected
  std::size_t missing_doors = 0;  ///< crossings of the path without one
};

class FloorComparison {
 public:
  FloorComparison(const mapping::FittedRooms& fitted, const world::RoomMap& truth,
                  const geometry::Pose2& T_truth_fitted)
      : fitted_(fitted), truth_(truth), T_(T_truth_fitted) {}

  /// Whether the map's frame is a choice, as of a recording, or given, as of a grid.
  enum class Frame { kFree, kGiven };

  FloorErrors errors(Frame frame = Frame::kFree) const {
    FloorErrors errors;
    errors.rooms = truth_.rooms().size();
    for (std::size_t r = 0; r < truth_.rooms().size(); ++r) {
      double best = 0.0;
      for (const auto& room : fitted_.rooms)
        best = std::max(best, overlap(room, truth_.rooms()[r]).of_both);
      errors.found += best >= 0.7 ? 1 : 0;
    }
    for (const auto& room : fitted_.rooms) {
      double inside = 0.0;
      for (const auto& true_room : truth_.rooms())
        inside = std::max(inside, overlap(room, true_room).of_first);
      errors.invented += inside < 0.5 ? 1 : 0;
      for (std::size_t i = 0; i < room.sides.size(); ++i) addSide(room, i, errors);
    }
    addDoors(errors);
    if (frame == Frame::kFree) align(errors.sides);
    weigh(errors.sides);
    return errors;
  }

 private:
  struct Overlap {
    double of_both = 0.0;   // intersection over union
    double of_first = 0.0;  // share of the first
  };

  // Takes out what a shift and a turn of all rooms together explain: where a map begins is a
  // choice.
  static void align(std::vector<SideError>& sides) {
    Eigen::Matrix3d information = 1e-9 * Eigen::Matrix3d::Identity();
    Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
    for (const SideError& side : sides) {
      information += side.by_frame * side.by_frame.transpose();
      gradient += side.offset * side.by_frame;
    }
    const Eigen::Vector3d step = -information.ldlt().solve(gradient);
    for (SideError& side : sides) {
      side.offset += side.by_frame.dot(step);
      side.angle += step[2];
    }
  }

  static void weigh(std::vector<SideError>& sides) {
    for (SideError& side : sides) {
      const Eigen::Vector2d error(side.offset, side.angle);
      side.nees = error.dot(side.covariance.ldlt().solve(error));
    }
  }

  // By a lattice of points.
  Overlap overlap(const mapping::RoomOutline& room, const world::Room& true_room) const {
    constexpr double kStep = 0.1;
    Eigen::Vector2d low = Eigen::Vector2d::Constant(1e9);
    Eigen::Vector2d high = -low;
    const auto hold = [&](const Eigen::Vector2d& p) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    };
    for (std::size_t i = 0; i < room.sides.size(); ++i) hold(T_ * room.side(i).start);
    for (const auto& wall : true_room.walls) hold(wall.segment.start);
    double first = 0.0;
    double second = 0.0;
    double both = 0.0;
    const geometry::Pose2 back = T_.inverse();
    for (double x = low.x() + 0.5 * kStep; x < high.x(); x += kStep) {
      for (double y = low.y() + 0.5 * kStep; y < high.y(); y += kStep) {
        const bool a = room.contains(back * Eigen::Vector2d(x, y));
        const bool b = true_room.contains({x, y});
        first += a ? 1.0 : 0.0;
        second += b ? 1.0 : 0.0;
        both += a && b ? 1.0 : 0.0;
      }
    }
    return {both / std::max(1.0, first + second - both), both / std::max(1.0, first)};
  }

  // Sides that were seen and hold wall are held against the nearest wall that faces as they do.
  void addSide(const mapping::RoomOutline& room, std::size_t i, FloorErrors& errors) const {
    if (!room.sides[i].is_seen || room.spans[i].empty()) return;
    const geometry::Segment side = T_ * room.side(i);
    const world::Wall* nearest = nullptr;
    double least = 0.25;
    for (const auto& true_room : truth_.rooms()) {
      for (const auto& wall : true_room.walls) {
        if (wall.segment.leftNormal().dot(side.leftNormal()) < 0.99) continue;
        if (wall.segment.distance(side.midpoint()) > 0.5 * side.length()) continue;
        const double off =
            std::abs(wall.segment.leftNormal().dot(side.midpoint() - wall.segment.start));
        if (off < least) nearest = &wall;
        least = std::min(least, off);
      }
    }
    if (nearest == nullptr) {
      ++errors.unmatched_sides;
      return;
    }
    const Eigen::Vector2d normal = nearest->segment.leftNormal();
    const Eigen::Vector2d mine = side.leftNormal();
    const Eigen::Vector2d error(normal.dot(side.midpoint() - nearest->segment.start),
                                std::asin(normal.x() * mine.y() - normal.y() * mine.x()));
    const Eigen::Vector2d middle = side.midpoint();
    errors.sides.push_back(
        {error[0],
         error[1],
         0.0,
         room.sides[i].covariance,
         {normal.x(), normal.y(), normal.y() * middle.x() - normal.x() * middle.y()}});
  }

  void addDoors(FloorErrors& errors) const {
    errors.missing_doors = fitted_.missing_doors.size();
    for (const auto& door : fitted_.doors) {
      const Eigen::Vector2d centre = T_ * door.centre_map;
      const auto nearer = [&](const world::Door& a, const world::Door& b) {
        return (a.centre_map - centre).norm() < (b.centre_map - centre).norm();
      };
      const auto nearest = std::min_element(truth_.doors().begin(), truth_.doors().end(), nearer);
      if (nearest == truth_.doors().end() || (nearest->centre_map - centre).norm() > 1.0) continue;
      errors.door_place.push_back((nearest->centre_map - centre).norm());
      errors.door_width.push_back(std::abs(nearest->width - door.width));
      const Eigen::Vector2d off = T_.inverse() * nearest->centre_map - door.centre_map;
      errors.door_nees.push_back(off.dot(door.covariance.ldlt().solve(off)));
    }
  }

  const mapping::FittedRooms& fitted_;
  const world::RoomMap& truth_;
  geometry::Pose2 T_;
};

}  // namespace sightline::test
