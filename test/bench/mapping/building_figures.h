#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "bench/figures.h"
#include "mapped_floor.h"
#include "mapping/other_buildings.h"
#include "sightline/mapping/replay.h"
#include "sightline/mapping/wheel_fit.h"
#include "temporary_folder.h"

/// Figures of rooms fitted to buildings of which the walls are known, but no rooms.
namespace sightline::bench {

class BuildingFigures {
 public:
  explicit BuildingFigures(const OtherBuilding& building)
      : name_("mapping.building." + building.name + "."),
        world_(building.setup.world),
        drive_(recordDrive(building.setup, 1)),
        survey_(test::surveyOf(drive_, {})),
        fitted_(mapping::fitRooms(survey_, {})) {}

  void print() const {
    put("rooms", static_cast<double>(fitted_.rooms.size()), "1");
    if (fitted_.rooms.empty()) return;
    put("missing_doors", static_cast<double>(fitted_.missing_doors.size()), "1");
    put("path_max_m", pathError(), "m");
    printWalls();
    put("explained", 100.0 * explained(), "%");
    printReplay();
  }

 private:
  void put(const char* figure, double value, const char* unit) const {
    bench::print(name_ + figure, value, unit);
  }

  double pathError() const {
    const geometry::Pose2 T = test::truthFromFitted(fitted_, drive_);
    double most = 0.0;
    for (const auto& pose : fitted_.poses) {
      const auto truth = drive_.truth.at(pose.stamp)->translation();
      most = std::max(most, (T * pose.pose.translation() - truth).norm());
    }
    return most;
  }

  double toWorld(const Eigen::Vector2d& place) const {
    double least = 1e9;
    for (const auto& piece : world_.segments())
      least = std::min(least, piece.segment.distance(place));
    return least;
  }

  // Distance of what the rooms call wall from the walls there are.
  void printWalls() const {
    constexpr double kStep = 0.05;
    const geometry::Pose2 T = test::truthFromFitted(fitted_, drive_);
    std::vector<double> off;
    for (const auto& room : fitted_.rooms) {
      for (std::size_t i = 0; i < room.sides.size(); ++i) {
        const geometry::Segment side = room.side(i);
        for (const world::Span& span : room.spans[i]) {
          for (double at = span.from; at < span.to; at += kStep)
            off.push_back(toWorld(T * Eigen::Vector2d(side.start + at * side.direction())));
        }
      }
    }
    put("wall_m", median(off), "m");
    put("wall_95_m", quantile(off, 0.95), "m");
    put("wall_length_m", kStep * static_cast<double>(off.size()), "m");
  }

  // Share of the points on surfaces that lie within 6 cm of wall that faces them.
  double explained() const {
    double on = 0.0;
    double all = 0.0;
    for (std::size_t k = 0; k < survey_.keys().size(); ++k) {
      const geometry::Pose2& pose = fitted_.path.keys[k];
      for (const auto& point : survey_.keys()[k].surfaces.points) {
        if (!point.hasNormal()) continue;
        all += 1.0;
        on += isExplained(pose * point.position, pose.rotation() * point.normal) ? 1.0 : 0.0;
      }
    }
    return on / std::max(1.0, all);
  }
  bool isExplained(const Eigen::Vector2d& place, const Eigen::Vector2d& facing) const {
    for (const auto& room : fitted_.rooms) {
      for (std::size_t i = 0; i < room.sides.size(); ++i) {
        const geometry::Segment side = room.side(i);
        if (side.leftNormal().dot(facing) < 0.9) continue;
        for (const world::Span& span : room.spans[i]) {
          const geometry::Segment wall{side.start + span.from * side.direction(),
                                       side.start + span.to * side.direction()};
          if (wall.distance(place) < 0.06) return true;
        }
      }
    }
    return false;
  }

  // The room tracker with its defaults over the drive, as fit_rooms ends.
  void printReplay() const {
    const test::TemporaryFolder folder;
    folder.write("rooms.yaml", mapping::roomsText(fitted_));
    pipeline::EstimatorsConfig config;
    config.rooms.emplace();
    config.rooms->map = folder.path("rooms.yaml");
    const auto wheels = mapping::fitWheels(survey_, fitted_.poses);
    mapping::Replay replay(mapping::withWheels(config, wheels), fitted_.poses,
                           mapping::odometryOf(survey_));
    test::readDrive(drive_, {}, /*with_wheels=*/true,
                    [&](pipeline::LocatedScan located) { replay.take(std::move(located)); });
    replay.finish();
    put("replay_right", 100.0 * replay.rightShare(), "%");
    put("replay_mean_m", replay.meanDifference(), "m");
    put("keeps_itself", replay.isGood() ? 1.0 : 0.0, "1");
  }

  std::string name_;
  world::World world_;
  RecordedDrive drive_;
  mapping::Survey survey_;
  mapping::FittedRooms fitted_;
};

}  // namespace sightline::bench
