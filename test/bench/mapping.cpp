// Figures of rooms from recordings, one a line: `name value unit`; lines that start with # explain.
//
// mapping.fit.<world>.*: rooms fitted to a simulated drive with odometry 2 % short, against the
// floor that was driven: two rooms of 8x6 and 5x6 m; floors of 4 to 12 rooms along a corridor drawn
// at random, bare and furnished. wall_mean_m, wall_max_m, angle_deg (mean): sides that hold wall
// against the walls they stand for, the whole map shifted and turned as fits best; nees (2
// expected), in_gate: by their covariances; rooms_found, rooms_invented: of all rooms; false_sides:
// sides that stand for no wall; door_place_m, door_width_m: mean; door_nees (2 expected);
// missing_doors: crossings without one; people: bare floors with people who walk through about 5 %
// of the beams; grid: bare floors as grids of 5 cm. mapping.loop_200m.*: a ring of corridors driven
// round once and on, wheels 3 % long: closed: rings whose end comes to lie within 0.3 m;
// false_loops: relations that join places that are not one; end_m: largest error of an end.
// mapping.fr079.poses.*: the adjusted path of the Freiburg log, with its wheels repaired, against
// its hand-verified relations; mapping.fr079_laser_only.poses.*: without wheels;
// mapping.intel_part.poses.*. mapping.fr079.*: the rooms fitted to that log, tracked on the same
// log; fr079_split: fitted to the first half, the second where it is in the same rooms;
// fr079_laser_only: fitted and tracked without wheels.
// mapping.building.<name>.*: buildings that are not made of rectangles, odometry 2 % short: a round
// hall, a room with a bay and an apse, an oblique room, a bent corridor, a corridor of 70 m seen
// with beams of a degree. rooms; missing_doors; path_max_m: largest error of a pose, the path laid
// over the true one; wall_m, wall_95_m: distance of what the rooms call wall from the nearest wall,
// median and 95 %; wall_length_m; explained: share of the points on surfaces within 6 cm of wall of
// a room that faces them; replay_right, replay_mean_m, keeps_itself: the replay that fit_rooms ends
// with. mapping.seconds, mapping.peak_mb: reading it and fitting rooms, processor time.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "bench/figures.h"
#include "bench/rooms/two_room_runs.h"
#include "mapping/building_figures.h"
#include "mapping/corridor_ring.h"
#include "mapping/fit_figures.h"
#include "mapping/random_floor.h"
#include "mapping/recordings.h"
#include "mapping/walking_people.h"

namespace {

using namespace sightline;

void printTwoRooms(std::uint64_t seeds) {
  bench::FitFigures figures("two_rooms");
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    bench::DriveSetup setup;
    setup.world = world::World::of(test::twoRooms());
    setup.start = bench::kStart;
    setup.path = simulation::Path(config::Node::parse(test::kTwoRoomsPath, "path"));
    setup.scanner = test::scannerProfile({});
    setup.robot = test::robotConfig();
    setup.seconds = test::kTwoRoomsSeconds;
    figures.add(bench::recordDrive(setup, seed), setup.T_base_sensor, test::twoRooms());
  }
  figures.print();
}

struct Seeds {
  std::uint64_t first;
  std::uint64_t count;
};

void printFloors(const std::string& world, bool is_furnished, const Seeds& seeds) {
  bench::FitFigures figures(world);
  for (std::uint64_t seed = seeds.first; seed < seeds.first + seeds.count; ++seed) {
    const bench::RandomFloor floor(seed, is_furnished);
    figures.add(bench::recordDrive(floor.drive(), seed), {}, floor.map());
  }
  figures.print();
}

void printFloorsWithPeople(const Seeds& seeds) {
  bench::FitFigures figures("people");
  double beams = 0.0;
  for (std::uint64_t seed = seeds.first; seed < seeds.first + seeds.count; ++seed) {
    const bench::RandomFloor floor(seed, /*is_furnished=*/false);
    bench::RecordedDrive drive = bench::recordDrive(floor.drive(), seed);
    beams += 100.0 * bench::addPeople(drive, seed) / static_cast<double>(seeds.count);
    figures.add(drive, {}, floor.map());
  }
  bench::print("mapping.fit.people.beams", beams, "%");
  figures.print();
}

// The floors as grids of 5 cm.
void printGrids(const Seeds& seeds) {
  constexpr double kCell = 0.05;
  bench::FitFigures figures("grid");
  for (std::uint64_t seed = seeds.first; seed < seeds.first + seeds.count; ++seed) {
    const bench::RandomFloor floor(seed, /*is_furnished=*/false);
    mapping::GridMap grid;
    grid.cells = world::drawRooms(floor.map(), kCell);
    grid.T_map_grid = geometry::Pose2(grid.cells.origin, 0.0);
    grid.cells.origin.setZero();
    const auto survey = mapping::surveyGrid(grid, mapping::kMiddleOfCell);
    figures.add(mapping::fitRooms(survey, {}), floor.map(), {},
                test::FloorComparison::Frame::kGiven);
  }
  figures.print();
}

void printBuildings(const Seeds& seeds) {
  for (const bench::OtherBuilding& building :
       {bench::roundHall(), bench::bayRoom(), bench::obliqueRoom(), bench::bentCorridor(),
        bench::longCorridor(seeds.first)}) {
    bench::BuildingFigures(building).print();
  }
}

}  // namespace

// usage: bench_mapping [FLOORS [SEED [PART...]]]      floors of each kind, 20 by default, from a
// seed on, by default 1; parts: two_rooms bare furnished people grid buildings loops recordings
int main(int argc, char** argv) {
  const Seeds seeds{static_cast<std::uint64_t>(argc > 2 ? std::atoi(argv[2]) : 1),
                    static_cast<std::uint64_t>(argc > 1 ? std::atoi(argv[1]) : 20)};
  const std::vector<std::string> parts(argv + std::min(argc, 3), argv + argc);
  const auto is_asked = [&](const char* part) {
    return parts.empty() || std::count(parts.begin(), parts.end(), part) > 0;
  };
  std::setvbuf(stdout, nullptr, _IOLBF, 0);  // it takes minutes
  if (is_asked("two_rooms")) printTwoRooms(std::min<std::uint64_t>(seeds.count, 5));
  if (is_asked("bare")) printFloors("bare", /*is_furnished=*/false, seeds);
  if (is_asked("furnished")) printFloors("furnished", /*is_furnished=*/true, seeds);
  if (is_asked("people")) printFloorsWithPeople(seeds);
  if (is_asked("grid")) printGrids(seeds);
  if (is_asked("buildings")) printBuildings(seeds);
  if (is_asked("loops")) bench::printLoops(seeds.first, std::min<std::uint64_t>(seeds.count, 5));
  if (is_asked("recordings")) bench::printRecordings();
  return 0;
}
