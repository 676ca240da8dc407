#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "bench/figures.h"
#include "mapped_floor.h"

/// Figures of rooms fitted to simulated floors.
namespace sightline::bench {

inline double meanOf(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value / static_cast<double>(values.size());
  return sum;
}

inline double largestOf(const std::vector<double>& values) {
  return values.empty() ? 0.0 : *std::max_element(values.begin(), values.end());
}

// Errors of all floors of one kind.
class FitFigures {
 public:
  explicit FitFigures(std::string world) : name_("mapping.fit." + std::move(world)) {}

  void add(const RecordedDrive& drive, const geometry::Pose2& T_base_sensor,
           const world::RoomMap& truth) {
    const mapping::Survey survey = test::surveyOf(drive, T_base_sensor);
    const mapping::FittedRooms fitted = mapping::fitRooms(survey, {});
    add(fitted, truth, test::truthFromFitted(fitted, drive));
  }

  void add(const mapping::FittedRooms& fitted, const world::RoomMap& truth,
           const geometry::Pose2& T_truth_fitted,
           test::FloorComparison::Frame frame = test::FloorComparison::Frame::kFree) {
    const auto errors = test::FloorComparison(fitted, truth, T_truth_fitted).errors(frame);
    for (const test::SideError& side : errors.sides) {
      offset_.push_back(std::abs(side.offset));
      angle_.push_back(geometry::degrees(std::abs(side.angle)));
      nees_.push_back(side.nees);
      inside_.push_back(side.nees <= kChiSquare95Of2 ? 100.0 : 0.0);
    }
    rooms_ += errors.rooms;
    found_ += errors.found;
    fitted_ += fitted.rooms.size();
    invented_ += errors.invented;
    false_sides_ += errors.unmatched_sides;
    missing_ += errors.missing_doors;
    place_.insert(place_.end(), errors.door_place.begin(), errors.door_place.end());
    width_.insert(width_.end(), errors.door_width.begin(), errors.door_width.end());
    door_nees_.insert(door_nees_.end(), errors.door_nees.begin(), errors.door_nees.end());
  }

  void print() const {
    bench::print(name_ + ".wall_mean_m", meanOf(offset_), "m");
    bench::print(name_ + ".wall_max_m", largestOf(offset_), "m");
    bench::print(name_ + ".angle_deg", meanOf(angle_), "deg");
    bench::print(name_ + ".angle_max_deg", largestOf(angle_), "deg");
    bench::print(name_ + ".nees", meanOf(nees_), "1");
    bench::print(name_ + ".in_gate", meanOf(inside_), "%");
    bench::print(name_ + ".rooms_found", share(found_, rooms_), "%");
    bench::print(name_ + ".rooms_invented", share(invented_, fitted_), "%");
    bench::print(name_ + ".false_sides", static_cast<double>(false_sides_), "1");
    bench::print(name_ + ".door_place_m", meanOf(place_), "m");
    bench::print(name_ + ".door_width_m", meanOf(width_), "m");
    bench::print(name_ + ".door_nees", meanOf(door_nees_), "1");
    bench::print(name_ + ".missing_doors", static_cast<double>(missing_), "1");
  }

 private:
  static constexpr double kChiSquare95Of2 = 5.991;
  static double share(std::size_t part, std::size_t whole) {
    return 100.0 * static_cast<double>(part) / static_cast<double>(std::max<std::size_t>(1, whole));
  }

  std::string name_;
  std::vector<double> offset_, angle_, nees_, inside_, place_, width_, door_nees_;
  std::size_t rooms_ = 0, found_ = 0, fitted_ = 0, invented_ = 0, false_sides_ = 0, missing_ = 0;
};

}  // namespace sightline::bench
