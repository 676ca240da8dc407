#pragma once

#include <string>
#include <vector>

#include <fmt/format.h>

#include "bench/rooms/two_room_runs.h"

/// The scenarios in the two rooms, and what is printed of them.
namespace sightline::bench {

/// Time from which a run is right for good, less `since` [s].
inline double rightForGoodAfter(const std::vector<TrackedScan>& run, double since) {
  double last_wrong = since;
  for (const TrackedScan& scan : run) {
    if (!scan.isRight()) last_wrong = scan.time;
  }
  return std::max(0.0, last_wrong - since);
}

inline double claimedWrong(const std::vector<TrackedScan>& run) {
  double seconds = 0.0;
  for (const TrackedScan& scan : run) {
    seconds += !scan.isRight() && scan.isClaimed() ? kScanPeriod : 0.0;
  }
  return seconds;
}

/// Time at which the first door is passed: truth east of the wall [s].
inline double firstDoor(const std::vector<TrackedScan>& run) {
  for (const TrackedScan& scan : run) {
    if (scan.truth.x() > 4.1) return scan.time;
  }
  return run.empty() ? 0.0 : run.back().time;
}

inline void printKidnap(TwoRoomRuns& runs, int seeds) {
  double recovered = 0.0;
  double wrong = 0.0;
  for (int seed = 1; seed <= seeds; ++seed) {
    const RecordedDrive& other = runs.eastern(seed);
    const TwoRoomRun run{
        "kidnap", [&](RecordedDrive& drive, auto) { moveUnnoticed(drive, other, kKidnapTime); },
        startAt(kStart)};
    const auto scans = runs.trackedBy(run, seed);
    recovered = std::max(recovered, rightForGoodAfter(scans, kKidnapTime));
    wrong = std::max(wrong, claimedWrong(scans));
  }
  print("rooms.two_rooms.kidnap.recovered_s", recovered, "s");
  print("rooms.two_rooms.kidnap.wrong_s", wrong, "s");
}

/// Prints the share of the runs that are right for good from 10 s after the first door on, and the
/// longest time of a wrong claim.
inline void printStart(TwoRoomRuns& runs, const std::string& name,
                       const std::optional<geometry::UncertainPose2>& start, int seeds) {
  int successes = 0;
  double wrong = 0.0;
  for (int seed = 1; seed <= seeds; ++seed) {
    const auto scans = runs.trackedBy({name, [](auto&, auto) {}, start}, seed);
    const double door = firstDoor(scans);
    successes += rightForGoodAfter(scans, door) <= 10.0 ? 1 : 0;
    wrong = std::max(wrong, claimedWrong(scans));
  }
  print("rooms.two_rooms." + name + ".success", 100.0 * successes / seeds, "%");
  print("rooms.two_rooms." + name + ".wrong_s", wrong, "s");
}

inline void printStarts(TwoRoomRuns& runs, int seeds) {
  printStart(runs, "twin", startAt({2.0, -1.0, geometry::kPi - 1.5}), seeds);
  printStart(runs, "other", startAt({4.6, 1.0, -1.5}), seeds);
  printStart(runs, "somewhere", startAt({0.0, 0.0, 0.0}, 4.0, 3.1), seeds);
  printStart(runs, "no_start", std::nullopt, seeds);
}

inline void printTurns(TwoRoomRuns& runs) {
  for (const int degrees : {20, 46, 90, 180}) {
    for (const double clutter : {0.0, 0.5}) {
      const std::string name = fmt::format("turn{}{}", degrees, clutter > 0.0 ? "_clutter50" : "");
      const TwoRoomRun run{name,
                           [&](RecordedDrive& drive, std::uint64_t seed) {
                             const double angle = geometry::radians(degrees);
                             moveUnnoticed(drive, runs.turned(static_cast<int>(seed), angle),
                                           kHalfTime);
                             if (clutter > 0.0) addSectorClutter(drive, clutter, seed);
                           },
                           startAt(kStart)};
      runs.figures(run).printKnowing("rooms.two_rooms." + name);
    }
  }
}

/// Each 12 s: bursts of 0.6 s in which the wheels spin by 0.24 m; pushes that turn the robot by
/// 12°.
inline void addBursts(RecordedDrive& drive, const Eigen::Vector3d& twist) {
  for (double time = 6.0; time < test::kTwoRoomsSeconds; time += 12.0) {
    addFalseMotion(drive, time, 0.6, twist);
  }
}

inline void printWheels(TwoRoomRuns& runs) {
  using Change = std::function<void(RecordedDrive&)>;
  const std::vector<std::pair<std::string, Change>> kinds{
      {"slip",
       [](auto& drive) {
         addBursts(drive, {0.24, 0.0, 0.0});
       }},
      {"push",
       [](auto& drive) {
         addBursts(drive, {0.0, 0.0, geometry::radians(-12.0)});
       }},
      {"frozen",
       [](auto& drive) {
         freezeOdometry(drive, 30.0, 2.0);
         freezeOdometry(drive, 70.0, 2.0);
       }},
      {"short", [](auto& drive) { scaleOdometry(drive, 0.95); }},
      {"slow", [](auto& drive) { thinOdometry(drive, 5, 2); }}};
  for (const auto& [name, change] : kinds) {
    const TwoRoomRun run{name, [&, change = change](RecordedDrive& drive, auto) { change(drive); },
                         startAt(kStart)};
    runs.figures(run).printAccuracy("rooms.two_rooms." + name);
  }
}

inline void printClutter(TwoRoomRuns& runs) {
  for (const double share : {0.5, 0.7}) {
    const TwoRoomRun run{
        "clutter",
        [&](RecordedDrive& drive, std::uint64_t seed) { addSectorClutter(drive, share, seed); },
        startAt(kStart)};
    runs.figures(run).printAccuracy(fmt::format("rooms.two_rooms.clutter{:.0f}", 100.0 * share));
  }
}

inline void printMapErrors(TwoRoomRuns& runs, int seeds) {
  TwoRoomRun off{"walls_off", [](auto&, auto) {}, startAt(kStart), false, true};
  runs.figures(off).printAccuracy("rooms.two_rooms.walls_off");
  RoomFigures standing;
  for (int seed = 1; seed <= seeds; ++seed) {
    TwoRoomRun run{"walls_off_standing", [](auto&, auto) {}, {}, false, false, true};
    run.start = startAt({-3.0 + 0.3 * seed, -2.0 + 0.2 * seed, 0.7 * seed});
    standing.add(runs.trackedBy(run, seed), kScanPeriod);
  }
  standing.printAccuracy("rooms.two_rooms.walls_off_standing");
}

inline void printTwoRooms(int seeds) {
  TwoRoomRuns runs(seeds);
  const TwoRoomRun exact{"clean", [](auto&, auto) {}, startAt(kStart), true};
  runs.figures(exact).printAccuracy("rooms.two_rooms.clean_told_exact");
  const auto clean = runs.figures({"clean", [](auto&, auto) {}, startAt(kStart)});
  clean.printAccuracy("rooms.two_rooms.clean");
  clean.printTime("rooms");
  printClutter(runs);
  printTurns(runs);
  printKidnap(runs, seeds);
  printStarts(runs, seeds);
  printWheels(runs);
  printMapErrors(runs, seeds);
  runs.calibration().printFigures();
}

}  // namespace sightline::bench
