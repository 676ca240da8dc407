#include "sightline/motion/floor_finder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>

namespace sightline::motion {

namespace {

using geometry::Pose2;

// Chosen by hand; the odometry benchmark prints their recall and precision on simulated walks.
struct FloorTuning {
  // A line: share of its range by which a beam may miss it, fewest beams, most lines of a scan.
  double fit = 0.025;
  std::size_t fewest_beams = 6;
  int most_lines = 4;
  // Largest skew of its slope [rad]: a person rather nods than rolls.
  double max_skew = 0.8;
  // Share of the least distance of level ground from which on a beam counts as far: the scanner
  // bobs.
  double bob = 0.9;
  // Largest distance of a return from where a wall was seen, and the distance behind it from which
  // on the wall is seen through: a length [m] and a ratio of the range.
  double same_at = 0.05;
  double same_share = 0.005;
  double behind_at = 0.1;
  double behind_share = 0.005;
  // A wall is seen through now and then, by a heading that errs or past its edge; but the floor is
  // often enough taken for the walls that it ends at.
  double support_per_contradiction = 0.65;
  // Scans that saw through, where none saw it, so that a place is surely open.
  int surely_open = 2;
};
constexpr FloorTuning kFloor{};

// Slope of a scan's plane over the distance of a level surface [1/m].
using Slope = Eigen::Vector2d;

Eigen::Vector2d bearingOf(const scan::Scan& scan, std::size_t beam) {
  return {scan.geometry()->cosines()[beam], scan.geometry()->sines()[beam]};
}

bool isOn(const Slope& slope, const scan::Scan& scan, std::size_t beam) {
  return std::abs(slope.dot(bearingOf(scan, beam)) * scan.ranges()[beam] - 1.0) < kFloor.fit;
}

std::optional<Slope> slopeThrough(const scan::Scan& scan, std::size_t a, std::size_t b) {
  const Eigen::Vector2d u = bearingOf(scan, a);
  const Eigen::Vector2d v = bearingOf(scan, b);
  const double determinant = u.x() * v.y() - v.x() * u.y();
  if (std::abs(determinant) < 1e-3) return std::nullopt;
  const double p = 1.0 / scan.ranges()[a];
  const double q = 1.0 / scan.ranges()[b];
  return Slope((p * v.y() - q * u.y()) / determinant, (q * u.x() - p * v.x()) / determinant);
}

// Range that a scan saw along a beam; nothing where the beam says nothing.
double sightOf(const scan::Scan& scan, std::size_t beam) {
  if (scan.isValid(beam)) return scan.ranges()[beam];
  const bool is_open = scan.kinds()[beam] == scan::ReturnKind::kNothing;
  return is_open ? std::numeric_limits<double>::infinity() : 0.0;
}

// The two beams on either side of a bearing and their neighbours; nothing near the ends of the
// scan or outside it.
std::optional<std::size_t> firstOfFour(const scan::ScanGeometry& geometry, double bearing) {
  const std::vector<double>& angles = geometry.angles();
  const bool falls = angles.back() < angles.front();
  const double middle = 0.5 * (angles.front() + angles.back());
  const double angle = middle + geometry::wrapAngle(bearing - middle);
  const auto after = falls ? std::lower_bound(angles.begin(), angles.end(), angle, std::greater<>())
                           : std::lower_bound(angles.begin(), angles.end(), angle);
  const auto index = static_cast<std::size_t>(std::distance(angles.begin(), after));
  if (index < 2 || index + 2 > angles.size()) return std::nullopt;
  return index - 2;
}

struct Sightings {
  int support = 0;
  int contradiction = 0;

  int count() const { return support + contradiction; }
  void operator+=(const Sightings& other) {
    support += other.support;
    contradiction += other.contradiction;
  }
};

// Asks an earlier scan about a point, given in its sensor's frame: it may have seen the point, or
// what lies behind.
void consult(const scan::Scan& earlier, const Eigen::Vector2d& point, Sightings& sightings) {
  const auto first = firstOfFour(*earlier.geometry(), std::atan2(point.y(), point.x()));
  if (!first) return;
  const double range = point.norm();
  bool was_seen = false;
  bool is_open = true;
  for (std::size_t beam = *first; beam < *first + 4; ++beam) {
    const double sight = sightOf(earlier, beam);
    if (std::abs(sight - range) < kFloor.same_at + kFloor.same_share * range) was_seen = true;
    if (sight < range + kFloor.behind_at + kFloor.behind_share * range) is_open = false;
  }
  if (was_seen) ++sightings.support;
  if (!was_seen && is_open) ++sightings.contradiction;
}

}  // namespace

FloorFinder::FloorFinder(const FloorConfig& config) : config_(config) {
  config::validate(config);
}

void FloorFinder::remember(const scan::Scan& scan, const Pose2& T_odom_sensor) {
  memory_.push_back({scan, T_odom_sensor});
  if (memory_.size() > static_cast<std::size_t>(config_.memory)) memory_.pop_front();
}

FloorFinder::Beams FloorFinder::farBeams(const scan::Scan& scan) const {
  const double clearance = std::min(config_.height, config_.headroom);
  const double nearest = kFloor.bob * clearance / std::sin(config_.max_tilt);
  Beams far;
  for (std::size_t i = 0; i < scan.beams(); ++i) {
    if (scan.isValid(i) && scan.ranges()[i] > nearest) far.push_back(i);
  }
  return far;
}

// The slope that most beams agree to, of those through two of them.
std::optional<Eigen::Vector2d> FloorFinder::bestSlope(const scan::Scan& scan,
                                                      const Beams& beams) const {
  constexpr std::array<std::size_t, 5> kApart{3, 6, 12, 24, 48};
  const double steepest = std::sin(config_.max_tilt) / std::min(config_.height, config_.headroom);
  std::optional<Slope> best;
  long most = static_cast<long>(kFloor.fewest_beams) - 1;
  for (const std::size_t apart : kApart) {
    for (std::size_t i = 0; i + apart < beams.size(); ++i) {
      const auto slope = slopeThrough(scan, beams[i], beams[i + apart]);
      if (!slope || slope->norm() > steepest) continue;
      // A level line falls behind the scanner where it rises before it.
      if (std::abs(std::atan2(slope->y(), std::abs(slope->x()))) > kFloor.max_skew) continue;
      const long count = std::count_if(beams.begin(), beams.end(),
                                       [&](std::size_t beam) { return isOn(*slope, scan, beam); });
      if (count <= most) continue;
      most = count;
      best = slope;
    }
  }
  return best;
}

// The whole line, or, where it is a wall's, what the floor in front of it has of it.
FloorFinder::Beams FloorFinder::floorOf(const scan::Scan& scan, const Pose2& T_odom_sensor,
                                        const Beams& line) const {
  std::vector<Sightings> of_beams(line.size());
  for (const Remembered& earlier : memory_) {
    const Pose2 T_earlier_now = geometry::between(earlier.T_odom_sensor, T_odom_sensor);
    for (std::size_t i = 0; i < line.size(); ++i) {
      consult(earlier.scan, T_earlier_now * scan.point(line[i]), of_beams[i]);
    }
  }
  Sightings sightings;
  for (const Sightings& of_beam : of_beams) sightings += of_beam;
  // A line of which hardly anything is known is a wall that has just come into view.
  if (2 * sightings.count() <= static_cast<int>(line.size())) return {};
  if (sightings.contradiction > kFloor.support_per_contradiction * sightings.support) return line;
  Beams open;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const auto& [support, contradiction] = of_beams[i];
    if (support == 0 && contradiction >= kFloor.surely_open) open.push_back(line[i]);
  }
  return open;
}

std::vector<bool> FloorFinder::find(const scan::Scan& scan, const Pose2& T_odom_sensor) const {
  std::vector<bool> on_floor(scan.beams());
  Beams beams = farBeams(scan);
  for (int lines = 0; lines < kFloor.most_lines; ++lines) {
    const auto slope = bestSlope(scan, beams);
    if (!slope) break;
    const auto rest = std::stable_partition(
        beams.begin(), beams.end(), [&](std::size_t beam) { return isOn(*slope, scan, beam); });
    const Beams line(beams.begin(), rest);
    beams.erase(beams.begin(), rest);
    for (const std::size_t beam : floorOf(scan, T_odom_sensor, line)) on_floor[beam] = true;
  }
  return on_floor;
}

}  // namespace sightline::motion
