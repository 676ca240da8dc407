#include "sightline/dead_reckoning/surface_points.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace sightline::dead_reckoning {

namespace {

using geometry::Pose2;

// A surface is fitted over this length to either side, or over so many beams [m].
constexpr double kHalfLength = 0.25;
constexpr std::size_t kMinHalf = 3;
constexpr std::size_t kMaxHalf = 20;
// Neighbours further apart than a surface seen at 5 degrees would have them are on two surfaces.
constexpr double kGrazing = 0.087;
constexpr double kStep = 0.05;  // [m]
// What a surface may leave of its points and still be straight; where it is less than smooth, there
// may be a corner [m].
constexpr double kStraight = 0.02;
constexpr double kSmooth = 0.01;
constexpr std::size_t kMinPoints = 3;
constexpr double kLeastSpread = 1e-6;  // [m²]

Eigen::Vector2d basePoint(const scan::Scan& scan, std::size_t beam, const Pose2& T_base_sensor,
                          const Eigen::Vector3d& twist) {
  const double offset = scan.geometry()->timeOffsets()[beam];
  const Eigen::Vector2d still = T_base_sensor * scan.point(beam);
  if (!scan.sensorMotion().empty() || offset == 0.0 || twist.isZero()) return still;
  return Pose2::exp(offset * twist) * still;
}

void check(const scan::Scan& scan) {
  const std::size_t beams = scan.geometry()->beams();
  if (scan.ranges().size() != beams || scan.kinds().size() != beams ||
      scan.rangeVariances().size() != beams) {
    throw scan::InvalidScan(fmt::format("{} ranges, {} kinds and {} variances for {} beams",
                                        scan.ranges().size(), scan.kinds().size(),
                                        scan.rangeVariances().size(), beams));
  }
  if (!scan.sensorMotion().empty() && scan.sensorMotion().size() != beams) {
    throw scan::InvalidScan(
        fmt::format("the sensor's motion at {} of {} beams", scan.sensorMotion().size(), beams));
  }
}

// Sums over points 0 .. i-1, so that those of any stretch are a difference.
struct Sums {
  double x = 0.0;
  double y = 0.0;
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;

  Sums with(const Eigen::Vector2d& p) const {
    return {x + p.x(), y + p.y(), xx + p.x() * p.x(), xy + p.x() * p.y(), yy + p.y() * p.y()};
  }
  Sums operator-(const Sums& o) const {
    return {x - o.x, y - o.y, xx - o.xx, xy - o.xy, yy - o.yy};
  }
};

struct Line {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  Eigen::Vector2d normal = Eigen::Vector2d::Zero();
  // Of the residuals; infinite before the first fit.
  double mean_square = std::numeric_limits<double>::infinity();
  double spread = 0.0;  // sum of squared distances from the centre along the line
};

Line fit(const Sums& sums, std::size_t count) {
  const double n = static_cast<double>(count);
  const Eigen::Vector2d centre(sums.x / n, sums.y / n);
  const double xx = sums.xx / n - centre.x() * centre.x();
  const double yy = sums.yy / n - centre.y() * centre.y();
  const double xy = sums.xy / n - centre.x() * centre.y();
  const double half = 0.5 * (xx - yy);
  const double root = std::sqrt(half * half + xy * xy);
  const double smaller = 0.5 * (xx + yy) - root;
  // Of the two equations for the eigenvector, the one that does not cancel.
  const Eigen::Vector2d normal =
      half > 0.0 ? Eigen::Vector2d(-xy, half + root) : Eigen::Vector2d(root - half, -xy);
  // Two parameters were taken from the points.
  const double free = std::max(1.0, n - 2.0);
  const double larger = xx + yy - smaller;
  const double mean_square = std::max(0.0, smaller) * n / free;
  return {centre, normal.normalized(), mean_square, n * larger};
}

class SurfaceFinder {
 public:
  explicit SurfaceFinder(Sweep& sweep) : sensor_(sweep.sensor), points_(sweep.points) {
    const double widest = sweep.beam_angle / kGrazing;
    sums_.reserve(points_.size() + 1);
    sums_.emplace_back();
    first_.reserve(points_.size());
    for (std::size_t i = 0; i < points_.size(); ++i) {
      sums_.push_back(sums_.back().with(points_[i].position));
      const bool broken = i == 0 || gap(i) > kStep + widest * nearer(i);
      first_.push_back(broken ? i : first_.back());
    }
  }

  void find() {
    std::size_t end = points_.size();
    for (std::size_t i = points_.size(); i-- > 0;) {
      find(i, first_[i], end);
      if (first_[i] == i) end = i;
    }
  }

 private:
  double gap(std::size_t i) const { return (points_[i].position - points_[i - 1].position).norm(); }
  double nearer(std::size_t i) const {
    return std::min((points_[i].position - sensor_).norm(),
                    (points_[i - 1].position - sensor_).norm());
  }

  // Of a point whose surface holds the points from `first` to before `end`.
  void find(std::size_t i, std::size_t first, std::size_t end) {
    SurfacePoint& point = points_[i];
    if (end - first < kMinPoints) return;
    const double before = i > first ? gap(i) : 0.0;
    const double after = i + 1 < end ? gap(i + 1) : 0.0;
    point.reach = std::max(before, after);
    const auto wanted = static_cast<std::size_t>(kHalfLength / std::max(point.reach, 1e-3));
    Line best;
    for (std::size_t half = std::clamp(wanted, kMinHalf, kMaxHalf); half > 0; half /= 2) {
      fitAbout(i, first, end, half, best);
      if (best.mean_square < 2.0 * point.variance) break;
    }
    if (best.mean_square > kStraight * kStraight) return;
    const bool towards = best.normal.dot(sensor_ - point.position) > 0.0;
    point.normal = towards ? best.normal : Eigen::Vector2d(-best.normal);
    point.normal_variance =
        std::max(best.mean_square, point.variance) / std::max(best.spread, kLeastSpread);
    point.smoothed = point.position + best.normal.dot(best.centre - point.position) * best.normal;
  }

  // With so many neighbours on either side, or twice as many on the better one.
  void fitAbout(std::size_t i, std::size_t first, std::size_t end, std::size_t half,
                Line& best) const {
    takeBetter(std::max(first, i - std::min(i, half)), std::min(end, i + half + 1), best);
    if (best.mean_square < kSmooth * kSmooth) return;
    takeBetter(std::max(first, i - std::min(i, 2 * half)), i + 1, best);
    takeBetter(i, std::min(end, i + 2 * half + 1), best);
  }

  void takeBetter(std::size_t left, std::size_t right, Line& best) const {
    if (right - left < kMinPoints) return;
    const Line line = fit(sums_[right] - sums_[left], right - left);
    if (line.mean_square < best.mean_square) best = line;
  }

  Eigen::Vector2d sensor_;
  std::vector<SurfacePoint>& points_;
  std::vector<Sums> sums_;
  std::vector<std::size_t> first_;  // of the points on the same surface
};

}  // namespace

Sweep readSweep(const scan::Scan& scan, const Pose2& T_base_sensor, const Eigen::Vector3d& twist) {
  check(scan);
  Sweep sweep;
  sweep.sensor = T_base_sensor.translation();
  sweep.beam_angle = std::abs(scan.geometry()->angleIncrement());
  sweep.points.reserve(scan.beams());
  for (std::size_t i = 0; i < scan.beams(); ++i) {
    if (!scan.isValid(i) || !std::isfinite(scan.ranges()[i])) continue;
    SurfacePoint point;
    point.position = basePoint(scan, i, T_base_sensor, twist);
    point.smoothed = point.position;
    point.variance = scan.rangeVariances()[i];
    sweep.points.push_back(point);
  }
  SurfaceFinder(sweep).find();
  return sweep;
}

}  // namespace sightline::dead_reckoning
