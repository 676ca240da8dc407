#include "sightline/dead_reckoning/surface_points.h"

#include <algorithm>
#include <cmath>

#include "sightline/dead_reckoning/fitted_line.h"

namespace sightline::dead_reckoning {

namespace {

using geometry::Pose2;

struct SurfaceTuning {
  // Least standard deviation of a return [m]: a surface is no mathematical line, and a beam no ray.
  double least_sigma = 0.01;
  // Length to either side that a line is fitted over [m], at least and in standard deviations of a
  // beam, and bounds of it in beams. Half the length costs 3 points of bad steps on a scanner of
  // 5 cm counts (aces), nothing on finer ones.
  double half_length = 0.25;
  double half_length_sigmas = 16.0;
  std::size_t min_half = 3;
  std::size_t max_half = 20;
  // Points to either side whose mean distance is that of the beams on a surface.
  std::size_t spacing_points = 4;
  // Neighbours further apart than on a surface seen at this angle [rad] are on two surfaces; the
  // step is what they may be apart besides [m].
  double grazing = 0.087;
  double step = 0.05;
  // Distance of points from a surface that is still straight, at least and in standard deviations
  // of a beam; where they are farther than `smooth`, there may be a corner [m]. Half of `straight`
  // costs 4 points on aces.
  double straight = 0.02;
  double straight_sigmas = 1.67;
  double smooth = 0.01;
  double smooth_sigmas = 1.0;
  // Standard deviations by which that may be exceeded by chance.
  double smooth_chance = 2.0;
  // Points of a line, and its least extent [m²]. One or six points make no surface finder.
  std::size_t min_points = 3;
  double least_extent = 1e-6;
  // A return of which the neighbours show no surface is taken for one that faces the scanner, as
  // wide as the beam is: from this range on [m], with this variance of its normal [rad²]. Where
  // ranges rise or fall by more than so many standard deviations on both sides, it is on a surface
  // seen at a grazing angle.
  double lone_range = 3.0;
  double lone_normal_variance = 0.01;
  double lone_sigmas = 3.0;
};
constexpr SurfaceTuning kSurface{};

double squareOf(double least, double value) {
  const double larger = std::max(least, value);
  return larger * larger;
}

double leastVariance() {
  return kSurface.least_sigma * kSurface.least_sigma;
}

Eigen::Vector2d basePoint(const scan::Scan& scan, std::size_t beam, const Pose2& T_base_sensor,
                          const Eigen::Vector3d& twist) {
  const double offset = scan.geometry()->timeOffsets()[beam];
  const Eigen::Vector2d still = T_base_sensor * scan.point(beam);
  if (!scan.sensorMotion().empty() || offset == 0.0 || twist.isZero()) return still;
  return Pose2::exp(offset * twist) * still;
}

class SurfaceFinder {
 public:
  explicit SurfaceFinder(SurfaceScan& surfaces)
      : sensor_(surfaces.sensor),
        beam_angle_(surfaces.beam_angle),
        half_length_(std::max(kSurface.half_length, kSurface.half_length_sigmas * surfaces.sigma)),
        straight_square_(squareOf(kSurface.straight, kSurface.straight_sigmas * surfaces.sigma)),
        smooth_square_(squareOf(kSurface.smooth, kSurface.smooth_sigmas * surfaces.sigma)),
        points_(surfaces.points) {
    const double widest = surfaces.beam_angle / kSurface.grazing;
    sums_.reserve(points_.size() + 1);
    sums_.emplace_back();
    first_.reserve(points_.size());
    for (std::size_t i = 0; i < points_.size(); ++i) {
      sums_.push_back(sums_.back().with(points_[i].position));
      const bool broken = i == 0 || gap(i) > kSurface.step + widest * nearer(i);
      first_.push_back(broken ? i : first_.back());
    }
  }

  void find() {
    std::size_t end = points_.size();
    for (std::size_t i = points_.size(); i-- > 0;) {
      find(i, first_[i], end);
      if (!points_[i].hasNormal()) faceScanner(i);
      if (first_[i] == i) end = i;
    }
  }

 private:
  double range(std::size_t i) const { return (points_[i].position - sensor_).norm(); }
  double gap(std::size_t i) const { return (points_[i].position - points_[i - 1].position).norm(); }
  double nearer(std::size_t i) const { return std::min(range(i), range(i - 1)); }

  // Finds the surface of a point, which holds the points from `first` to before `end`.
  void find(std::size_t i, std::size_t first, std::size_t end) {
    SurfacePoint& point = points_[i];
    if (end - first < kSurface.min_points) return;
    const double before = i > first ? gap(i) : 0.0;
    const double after = i + 1 < end ? gap(i + 1) : 0.0;
    point.reach = std::max(before, after);
    const auto wanted =
        static_cast<std::size_t>(half_length_ / std::max(spacingAt(i, first, end), 1e-3));
    FittedLine best;
    for (std::size_t half = std::clamp(wanted, kSurface.min_half, kSurface.max_half); half > 0;
         half /= 2) {
      fitAbout(i, first, end, half, best);
      if (best.mean_square < 2.0 * point.variance) break;
    }
    if (best.mean_square > straight_square_) return;
    const bool towards = best.normal.dot(sensor_ - point.position) > 0.0;
    point.normal = towards ? best.normal : Eigen::Vector2d(-best.normal);
    point.normal_variance =
        std::max(best.mean_square, point.variance) / std::max(best.extent, kSurface.least_extent);
    // A range moves a point across a surface by the cosine at which it is met.
    const double cosine = point.normal.dot(sensor_ - point.position) / std::max(range(i), 1e-6);
    point.variance = std::max(point.variance * cosine * cosine, leastVariance());
    point.smoothed = point.position + best.normal.dot(best.centre - point.position) * best.normal;
  }

  // Mean distance of the points about one: the distance of two neighbours is that of the beams and
  // the noise, which on a near wall is the larger.
  double spacingAt(std::size_t i, std::size_t first, std::size_t end) const {
    const std::size_t left = std::max(first, i - std::min(i, kSurface.spacing_points));
    const std::size_t right = std::min(end - 1, i + kSurface.spacing_points);
    return (points_[right].position - points_[left].position).norm() /
           static_cast<double>(right - left);
  }

  // Fits `half` neighbours on either side, or twice as many on the better one.
  void fitAbout(std::size_t i, std::size_t first, std::size_t end, std::size_t half,
                FittedLine& best) const {
    takeBetter(std::max(first, i - std::min(i, half)), std::min(end, i + half + 1), best);
    if (isSmooth(best)) return;
    takeBetter(std::max(first, i - std::min(i, 2 * half)), i + 1, best);
    takeBetter(i, std::min(end, i + 2 * half + 1), best);
  }

  void takeBetter(std::size_t left, std::size_t right, FittedLine& best) const {
    if (right - left < kSurface.min_points) return;
    const FittedLine line = fitLine(sums_[right] - sums_[left], right - left);
    if (line.mean_square < best.mean_square) best = line;
  }

  // Tells whether noise explains how far points are from a line: by chance, a few of them are
  // nearer to a line of their own, which leads anywhere.
  bool isSmooth(const FittedLine& line) const {
    return line.mean_square <
           smooth_square_ * (1.0 + kSurface.smooth_chance * std::sqrt(2.0 / line.free));
  }

  void faceScanner(std::size_t i) {
    SurfacePoint& point = points_[i];
    const double away = range(i);
    if (away < kSurface.lone_range || isOnSlope(i, away)) return;
    point.normal = (sensor_ - point.position) / away;
    point.normal_variance = kSurface.lone_normal_variance;
    point.reach = 0.5 * beam_angle_ * away;
  }

  // Tells whether the ranges rise, or fall, on both sides of a point. Where the beam on one side
  // met nothing, the wall may go on there out of reach: the last return of a wall down a corridor
  // goes with the robot, and would hold it back as a thing that faces it.
  bool isOnSlope(std::size_t i, double away) const {
    if (i == 0 || i + 1 == points_.size()) return false;
    const double least = kSurface.lone_sigmas * std::sqrt(points_[i].variance);
    const double before = away - range(i - 1);
    const double after = range(i + 1) - away;
    if (!isNext(i)) return isNext(i + 1) && after < -least;
    if (!isNext(i + 1)) return before > least;
    return std::min(std::abs(before), std::abs(after)) > least && before * after > 0.0;
  }

  // Tells whether a point is by the beam next to that of the one before.
  bool isNext(std::size_t i) const {
    const Eigen::Vector2d here = points_[i].position - sensor_;
    const Eigen::Vector2d before = points_[i - 1].position - sensor_;
    const double turn =
        std::abs(std::atan2(before.x() * here.y() - before.y() * here.x(), before.dot(here)));
    return turn < 1.5 * beam_angle_;
  }

  Eigen::Vector2d sensor_;
  double beam_angle_;
  double half_length_;      // [m]
  double straight_square_;  // [m²]
  double smooth_square_;    // [m²]
  std::vector<SurfacePoint>& points_;
  std::vector<PointSums> sums_;
  std::vector<std::size_t> first_;  // first point on the same surface, by point
};

// Noise of the motion, from the sensor's axes to the base's.
scan::MotionNoise noiseInBase(const scan::MotionNoise& noise, const Pose2& T_base_sensor) {
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  axes.topLeftCorner<2, 2>() = T_base_sensor.rotation();
  return {axes * noise.drift * axes.transpose(), axes * noise.walk * axes.transpose(), noise.jitter,
          T_base_sensor * noise.jitter_axis};
}

Sighting sightingOf(const scan::Scan& scan, std::size_t beam, const Pose2& T_base_sensor) {
  const double duration = scan.duration();
  const double time = duration != 0.0 ? scan.geometry()->timeOffsets()[beam] / duration : 0.0;
  if (scan.sensorMotion().empty()) return {time, T_base_sensor.translation()};
  return {time, T_base_sensor * scan.sensorMotion()[beam].translation()};
}

// A jitter about an axis moves each point on its own, across its surface as far as that does not
// face the axis.
void addJitter(SurfaceScan& surfaces) {
  const scan::MotionNoise& noise = surfaces.motion_noise;
  for (SurfacePoint& point : surfaces.points) {
    if (!point.hasNormal()) continue;
    const Eigen::Vector2d arm = point.position - noise.jitter_axis;
    const double lever = point.normal.y() * arm.x() - point.normal.x() * arm.y();
    point.variance += noise.jitter * lever * lever;
  }
}

double medianSigma(const std::vector<SurfacePoint>& points) {
  if (points.empty()) return 0.0;
  std::vector<double> variances;
  variances.reserve(points.size());
  for (const SurfacePoint& point : points) variances.push_back(point.variance);
  const auto middle = variances.begin() + static_cast<std::ptrdiff_t>(variances.size() / 2);
  std::nth_element(variances.begin(), middle, variances.end());
  return std::sqrt(*middle);
}

SurfacePoint pointOf(const scan::Scan& scan, std::size_t beam, const Pose2& T_base_sensor,
                     const Eigen::Vector3d& twist) {
  SurfacePoint point;
  point.position = basePoint(scan, beam, T_base_sensor, twist);
  point.smoothed = point.position;
  point.variance = std::max(scan.rangeVariances()[beam], leastVariance());
  return point;
}

}  // namespace

SurfaceScan readSurfaces(const scan::Scan& scan, const Pose2& T_base_sensor,
                         const Eigen::Vector3d& twist) {
  SurfaceScan surfaces;
  surfaces.sensor = T_base_sensor.translation();
  if (scan.beams() == 0) return surfaces;
  surfaces.beam_angle = std::abs(scan.geometry()->angleIncrement());
  surfaces.motion_noise = noiseInBase(scan.motion_noise, T_base_sensor);
  const bool moves_unknown =
      !scan.motion_noise.drift.isZero(0.0) || !scan.motion_noise.walk.isZero(0.0);
  surfaces.points.reserve(scan.beams());
  for (std::size_t i = 0; i < scan.beams(); ++i) {
    if (!scan.isValid(i) || !std::isfinite(scan.ranges()[i])) continue;
    surfaces.points.push_back(pointOf(scan, i, T_base_sensor, twist));
    if (moves_unknown) surfaces.sightings.push_back(sightingOf(scan, i, T_base_sensor));
  }
  surfaces.sigma = medianSigma(surfaces.points);
  SurfaceFinder(surfaces).find();
  if (scan.motion_noise.jitter > 0.0) addJitter(surfaces);
  return surfaces;
}

}  // namespace sightline::dead_reckoning
