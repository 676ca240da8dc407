#pragma once

#include <functional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "bench/rooms/two_room_runs.h"
#include "sightline/plot/figure.h"

/// The two questions that jensfelt section 6 leaves open: the clutter at which tracking fails, and
/// how far from a rectangle a room may be.
namespace sightline::bench {

constexpr double kLimitSeconds = 40.0;  // of a run: the first lap of the west room and the door

/// Right throughout, from a second after the start on.
inline bool isTracked(const std::vector<TrackedScan>& scans) {
  return std::all_of(scans.begin(), scans.end(),
                     [](const TrackedScan& scan) { return scan.time < 1.0 || scan.isRight(); });
}

/// The two rooms as they are where their north and south walls are turned about their middles by an
/// angle [rad], either towards the other, while the map draws rectangles.
inline world::RoomMap skewed(double angle) {
  const auto cornersOf = [angle](const Eigen::Vector2d& size, const Eigen::Vector2d& centre) {
    const double x = 0.5 * size.x();
    const double rise = x * std::tan(angle);
    const double y = 0.5 * size.y();
    std::vector<Eigen::Vector2d> corners{
        {-x, -y - rise}, {x, -y + rise}, {x, y - rise}, {-x, y + rise}};
    for (Eigen::Vector2d& corner : corners) corner += centre;
    return corners;
  };
  world::RoomMap map;
  const auto east = map.addPolygon("east", cornersOf({5.0, 6.0}, {6.6, 0.0}));
  const auto west = map.addPolygon("west", cornersOf({8.0, 6.0}, {0.0, 0.0}));
  map.addDoor(west, east, {4.05, 0.5}, 0.9);
  return map;
}

/// Share of the seeds [%] that are tracked.
inline double successOf(int seeds, const std::function<bool(int seed)>& is_tracked) {
  int successes = 0;
  for (int seed = 1; seed <= seeds; ++seed) successes += is_tracked(seed) ? 1 : 0;
  return 100.0 * successes / seeds;
}

/// Where a falling curve passes 95 %, between two of its points; the last point where it does not.
inline double limitOf(const std::vector<plot::Point>& curve) {
  constexpr double kSuccess = 95.0;
  for (std::size_t i = 1; i < curve.size(); ++i) {
    if (curve[i].y >= kSuccess) continue;
    const double drop = curve[i - 1].y - curve[i].y;
    return curve[i].x - (curve[i].x - curve[i - 1].x) * (kSuccess - curve[i].y) / drop;
  }
  return curve.back().x;
}

inline void printCurve(const std::string& title, const std::vector<plot::Point>& curve) {
  fmt::print("# {}:", title);
  for (const plot::Point& point : curve) fmt::print(" {:g}: {:.0f} %", point.x, point.y);
  fmt::print("\n");
}

class Limits {
 public:
  explicit Limits(int seeds) : seeds_(seeds) {}

  /// Success against the share of the beams that are shortened, sector by sector [%].
  std::vector<plot::Point> byClutter(const tracking::TrackerConfig& config) const {
    std::vector<plot::Point> curve{{0.0, 100.0}};
    for (double share = 0.5; share < 0.97 && curve.back().y > 20.0; share += 0.05) {
      curve.push_back({100.0 * share, successOf(seeds_, [&](int seed) {
                         RecordedDrive drive = driveIn(test::twoRooms(), seed);
                         addSectorClutter(drive, share, static_cast<std::uint64_t>(seed));
                         return isTracked(track(drive, config));
                       })});
    }
    return curve;
  }

  /// Success against the angle by which walls are off [degrees].
  std::vector<plot::Point> bySkew(const tracking::TrackerConfig& config) const {
    std::vector<plot::Point> curve{{0.0, 100.0}};
    for (double skew = 1.0; skew < 9.0 && curve.back().y > 20.0; skew += 1.0) {
      curve.push_back({skew, successOf(seeds_, [&](int seed) {
                         const auto drive = driveIn(skewed(geometry::radians(skew)), seed);
                         return isTracked(track(drive, config));
                       })});
    }
    return curve;
  }

 private:
  static RecordedDrive driveIn(const world::RoomMap& rooms, int seed) {
    DriveSetup setup = twoRoomsSetup();
    setup.world = world::World::of(rooms);
    setup.seconds = kLimitSeconds;
    return recordDrive(setup, static_cast<std::uint64_t>(seed));
  }
  static std::vector<TrackedScan> track(const RecordedDrive& drive,
                                        const tracking::TrackerConfig& config) {
    tracking::RoomTracker tracker(config, test::twoRooms());
    tracker.setPose(startAt(kStart));
    return Playback(tracker, twoRoomsSetup().T_base_sensor).play(drive);
  }

  int seeds_;
};

/// Prints rooms.limits.*, of the plain method too, and draws success against clutter and skew.
///
/// @param path  of the picture
inline void printLimits(int seeds, const std::string& path) {
  const Limits limits(seeds);
  tracking::TrackerConfig plain;
  plain.method = tracking::Method::kPlain;
  plot::Panel clutter{"Clutter", "shortened beams [%]", "runs that are tracked [%]", "", 0.0, {}};
  plot::Panel skew{"Skew", "walls turned by [degrees]", "runs that are tracked [%]", "", 0.0, {}};
  for (const auto& [name, config] :
       {std::pair(std::string("plain_"), plain), {std::string(), tracking::TrackerConfig()}}) {
    const std::string title = config.method == tracking::Method::kPlain ? "plain" : "default";
    const auto by_clutter = limits.byClutter(config);
    const auto by_skew = limits.bySkew(config);
    printCurve(title + ", success against clutter", by_clutter);
    printCurve(title + ", success against skew", by_skew);
    print("rooms.limits." + name + "clutter_percent", limitOf(by_clutter), "%");
    print("rooms.limits." + name + "skew_deg", limitOf(by_skew), "deg");
    clutter.series.push_back({title, plot::Style::kLineAndPoints, by_clutter});
    skew.series.push_back({title, plot::Style::kLineAndPoints, by_skew});
  }
  plot::writePng({1200, 500, 2, {clutter, skew}}, path);
  fmt::print("# success against clutter and skew is drawn in {}\n", path);
}

}  // namespace sightline::bench
