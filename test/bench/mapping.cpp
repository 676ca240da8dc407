// Figures of rooms from recordings, one a line: `name value unit`; lines that start with # explain.
//
// mapping.fit.<world>.*: rooms fitted to a simulated drive with odometry 2 % short, against the
// floor that was driven: two rooms of 8x6 and 5x6 m; floors of 4 to 12 rooms along a corridor drawn
// at random, bare and furnished. wall_mean_m, wall_max_m, angle_deg (mean): sides that hold wall
// against the walls they stand for, the whole map shifted and turned as fits best; nees (2
// expected), in_gate: by their covariances; rooms_found, rooms_invented: of all rooms; false_sides:
// sides that stand for no wall; door_place_m, door_width_m: mean; missing_doors: crossings without
// one. mapping.fr079.poses.*: the adjusted path of the Freiburg log, with its wheels repaired,
// against its hand-verified relations; mapping.fr079_laser_only.poses.*: without wheels;
// mapping.intel_part.poses.*. mapping.fr079.*: the rooms fitted to that log, tracked on the same
// log; fr079_split: fitted to the first half, tracked on the second where it is in the same rooms.
// mapping.seconds, mapping.peak_mb: reading it and fitting rooms, processor time.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "bench/figures.h"
#include "bench/rooms/two_room_runs.h"
#include "mapped_floor.h"
#include "mapping/random_floor.h"
#include "mapping/recordings.h"

namespace {

using namespace sightline;

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value / static_cast<double>(values.size());
  return sum;
}

double largest(const std::vector<double>& values) {
  return values.empty() ? 0.0 : *std::max_element(values.begin(), values.end());
}

// Errors of all floors of one kind.
class FitFigures {
 public:
  explicit FitFigures(std::string world) : name_("mapping.fit." + std::move(world)) {}

  void add(const bench::DriveSetup& setup, const world::RoomMap& truth, std::uint64_t seed) {
    const bench::RecordedDrive drive = bench::recordDrive(setup, seed);
    const mapping::Survey survey = test::surveyOf(drive, setup.T_base_sensor);
    const mapping::FittedRooms fitted = mapping::fitRooms(survey, {});
    const auto errors =
        test::FloorComparison(fitted, truth, test::truthFromFitted(fitted, drive)).errors();
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
  }

  void print() const {
    bench::print(name_ + ".wall_mean_m", mean(offset_), "m");
    bench::print(name_ + ".wall_max_m", largest(offset_), "m");
    bench::print(name_ + ".angle_deg", mean(angle_), "deg");
    bench::print(name_ + ".angle_max_deg", largest(angle_), "deg");
    bench::print(name_ + ".nees", mean(nees_), "1");
    bench::print(name_ + ".in_gate", mean(inside_), "%");
    bench::print(name_ + ".rooms_found", share(found_, rooms_), "%");
    bench::print(name_ + ".rooms_invented", share(invented_, fitted_), "%");
    bench::print(name_ + ".false_sides", static_cast<double>(false_sides_), "1");
    bench::print(name_ + ".door_place_m", mean(place_), "m");
    bench::print(name_ + ".door_width_m", mean(width_), "m");
    bench::print(name_ + ".missing_doors", static_cast<double>(missing_), "1");
  }

 private:
  static constexpr double kChiSquare95Of2 = 5.991;
  static double share(std::size_t part, std::size_t whole) {
    return 100.0 * static_cast<double>(part) / static_cast<double>(std::max<std::size_t>(1, whole));
  }

  std::string name_;
  std::vector<double> offset_, angle_, nees_, inside_, place_, width_;
  std::size_t rooms_ = 0, found_ = 0, fitted_ = 0, invented_ = 0, false_sides_ = 0, missing_ = 0;
};

void printTwoRooms(std::uint64_t seeds) {
  FitFigures figures("two_rooms");
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    bench::DriveSetup setup;
    setup.world = world::World::of(test::twoRooms());
    setup.start = bench::kStart;
    setup.path = simulation::Path(config::Node::parse(test::kTwoRoomsPath, "path"));
    setup.scanner = test::scannerProfile({});
    setup.robot = test::robotConfig();
    setup.seconds = test::kTwoRoomsSeconds;
    figures.add(setup, test::twoRooms(), seed);
  }
  figures.print();
}

void printFloors(const std::string& world, bool is_furnished, std::uint64_t first,
                 std::uint64_t floors) {
  FitFigures figures(world);
  for (std::uint64_t seed = first; seed < first + floors; ++seed) {
    const bench::RandomFloor floor(seed, is_furnished);
    figures.add(floor.drive(), floor.map(), seed);
  }
  figures.print();
}

}  // namespace

// usage: bench_mapping [FLOORS [SEED]]      floors of either kind, 20 by default, from a seed on,
// by default 1
int main(int argc, char** argv) {
  const auto floors = static_cast<std::uint64_t>(argc > 1 ? std::atoi(argv[1]) : 20);
  const auto first = static_cast<std::uint64_t>(argc > 2 ? std::atoi(argv[2]) : 1);
  std::setvbuf(stdout, nullptr, _IOLBF, 0);  // it takes minutes
  printTwoRooms(std::min<std::uint64_t>(floors, 5));
  printFloors("bare", /*is_furnished=*/false, first, floors);
  printFloors("furnished", /*is_furnished=*/true, first, floors);
  bench::printRecordings();
  return 0;
}
