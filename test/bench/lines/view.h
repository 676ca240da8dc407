#pragma once

#include <algorithm>
#include <random>
#include <vector>

#include <Eigen/LU>

#include "sightline/fitting/line_fit.h"
#include "world.h"

namespace sightline::bench {

/// A wall, or the part of one between two things in front of it, as one scan sees it.
struct VisibleSpan {
  int wall = 0;
  geometry::Segment ends;  ///< what can be seen, to where it really stops; frame of the scan
  geometry::PolarLine line;
  std::size_t beams = 0;
  geometry::PolarLine floor;  ///< the maximum-likelihood line of exactly its beams
  geometry::Segment floor_ends;
};

/// One scan, and what it shows.
struct View {
  scan::Scan scan;
  std::vector<VisibleSpan> spans;
  std::vector<std::size_t> beams_on_disc;  ///< valid ones
  std::vector<double> true_ranges;         ///< [m]
};

/// Settings of a sensor and its motion.
struct Sensor {
  std::size_t beams = 1081;
  double field_of_view = geometry::radians(270.0);
  double sigma = 0.01;
  double invalid_share = 0.0;  ///< of returns replaced by NaN, Inf or 0
  double sweep_time = 0.0;     ///< [s], moving at 0.5 m/s and `turn_rate`
  double turn_rate = 1.0;      ///< [rad/s]
  double sigma_per_metre = 0.0;
  double step = 0.0;           ///< in which ranges are counted [m]; 0: none
  double angular_sigma = 0.0;  ///< of each beam's direction [rad]
  double outlier_share = 0.0;  ///< of returns replaced by anything up to 10 m

  /// Variance along a beam that an ideal user of the scanner would state [m²].
  double variance(double range) const {
    const double growing = std::isfinite(range) ? sigma_per_metre * range : 0.0;
    return sigma * sigma + growing * growing + step * step / 12.0;
  }
};

/// A wall may be hidden for this long and is still one [m], as the extractor's gap limit.
constexpr double kMaxGap = 0.3;

class Viewer {
 public:
  Viewer(const PlaneWorld& world, const Sensor& sensor, const geometry::Pose2& pose)
      : world_(world), sensor_(sensor), pose_(pose), circle_(sensor.field_of_view > 6.28) {}

  View view(std::mt19937& random) {
    View view;
    takeScan(random, view.scan);
    const auto count = static_cast<int>(world_.walls.size());
    for (int wall = 0; wall < count; ++wall) addSpans(wall, view);
    for (VisibleSpan& span : view.spans) joinFloorCorners(span, view.spans);
    countDiscBeams(view);
    for (const Hit& hit : hits_) view.true_ranges.push_back(hit.range);
    return view;
  }

 private:
  double steps() const { return static_cast<double>(sensor_.beams - (circle_ ? 0 : 1)); }
  double angleAt(double beam) const {
    return -0.5 * sensor_.field_of_view + beam * sensor_.field_of_view / steps();
  }
  /// Pose of the sensor in the frame of the scan, at a fractional beam.
  geometry::Pose2 motionAt(double beam) const {
    if (sensor_.sweep_time == 0.0) return {};
    return geometry::Pose2::exp(sensor_.sweep_time * beam / steps() *
                                Eigen::Vector3d(0.5, 0.0, sensor_.turn_rate));
  }
  Hit hitAt(double beam) const { return cast(world_, pose_ * motionAt(beam), angleAt(beam)); }

  void takeScan(std::mt19937& random, scan::Scan& scan) {
    const auto n = sensor_.beams;
    const auto geometry = scan::ScanGeometry::uniform(angleAt(0.0), angleAt(1.0) - angleAt(0.0), n,
                                                      sensor_.sweep_time / steps(), 0.02, 60.0);
    std::vector<double> ranges;
    std::vector<geometry::Pose2> motion;
    std::vector<double> variances;
    astray_.assign(n, false);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    for (std::size_t i = 0; i < n; ++i) {
      hits_.push_back(hitAt(static_cast<double>(i)));
      double range = measure(i, random);
      if (share(random) < sensor_.invalid_share) range = invalidRange(share(random));
      ranges.push_back(range);
      variances.push_back(sensor_.variance(hits_.back().range));
      if (sensor_.sweep_time > 0.0) motion.push_back(motionAt(static_cast<double>(i)));
    }
    scan = scan::Scan(geometry, 1, std::move(ranges));
    scan.setSensorMotion(std::move(motion));
    scan.setRangeVariances(std::move(variances));
    scan.angular_variance = sensor_.angular_sigma * sensor_.angular_sigma;
  }
  double measure(std::size_t beam, std::mt19937& random) {
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> share(0.0, 1.0);
    double range = hits_[beam].range;
    if (sensor_.angular_sigma > 0.0) {
      const double turned = sensor_.angular_sigma * normal(random);
      range = cast(world_, pose_ * motionAt(static_cast<double>(beam)),
                   angleAt(static_cast<double>(beam)) + turned)
                  .range;
    }
    if (std::isfinite(range)) {
      range += std::hypot(sensor_.sigma, sensor_.sigma_per_metre * range) * normal(random);
    }
    if (sensor_.outlier_share > 0.0 && share(random) < sensor_.outlier_share) {
      range = 0.1 + 9.9 * share(random);
      astray_[beam] = true;
    }
    return sensor_.step > 0.0 && std::isfinite(range)
               ? sensor_.step * std::round(range / sensor_.step)
               : range;
  }
  static double invalidRange(double share) {
    if (share < 1.0 / 3.0) return std::numeric_limits<double>::quiet_NaN();
    return share < 2.0 / 3.0 ? std::numeric_limits<double>::infinity() : 0.0;
  }

  /// Place on the wall where the line of sight at a fractional beam meets it [m from its start].
  double alongWall(int wall, double beam) const {
    const geometry::Pose2 sensor = pose_ * motionAt(beam);
    const double heading = sensor.theta() + angleAt(beam);
    Hit hit;
    geometry::Segment endless = world_.walls[static_cast<std::size_t>(wall)];
    const Eigen::Vector2d reach = 1e3 * endless.direction();
    endless = {endless.start - reach, endless.end + reach};
    meetWall(endless, sensor.translation(), {std::cos(heading), std::sin(heading)}, 0, hit);
    const Eigen::Vector2d point =
        sensor * (hit.range * Eigen::Vector2d(std::cos(angleAt(beam)), std::sin(angleAt(beam))));
    return world_.walls[static_cast<std::size_t>(wall)].along(point);
  }

  void addSpans(int wall, View& view) const {
    const auto n = static_cast<long>(sensor_.beams);
    long begin = 0;
    if (circle_) {  // begin at a beam off the wall
      while (begin < n && hit(begin).what == wall) ++begin;
    }
    long first = -1;
    long last = -1;
    for (long i = begin; i < begin + n; ++i) {
      if (hit(i).what != wall) continue;
      if (first >= 0 && isInterrupted(wall, last, i)) {
        addSpan(wall, first, last, view);
        first = -1;
      }
      if (first < 0) first = i;
      last = i;
    }
    if (first >= 0) addSpan(wall, first, last, view);
  }
  void countDiscBeams(View& view) const {
    view.beams_on_disc.assign(world_.discs.size(), 0);
    const auto walls = static_cast<int>(world_.walls.size());
    for (std::size_t i = 0; i < hits_.size(); ++i) {
      if (hits_[i].what < walls || !view.scan.isValid(i)) continue;
      ++view.beams_on_disc[static_cast<std::size_t>(hits_[i].what - walls)];
    }
  }
  const Hit& hit(long beam) const { return hits_[static_cast<std::size_t>(beam) % sensor_.beams]; }
  bool isInterrupted(int wall, long last, long next) const {
    if (next - last <= 2) return false;
    return std::abs(alongWall(wall, static_cast<double>(next)) -
                    alongWall(wall, static_cast<double>(last))) > kMaxGap;
  }

  void addSpan(int wall, long first, long last, View& view) const {
    if (last == first) return;
    VisibleSpan span;
    span.wall = wall;
    const auto& whole = world_.walls[static_cast<std::size_t>(wall)];
    const geometry::Pose2 to_scan = pose_.inverse();
    const auto pointAt = [&](double along) -> Eigen::Vector2d {
      return to_scan * Eigen::Vector2d(whole.start + along * whole.direction());
    };
    span.ends = {pointAt(edge(wall, first, -1)), pointAt(edge(wall, last, 1))};
    span.line = (to_scan * whole).line();
    if (fitFloor(wall, first, last, view.scan, span)) view.spans.push_back(span);
  }

  /// True end of the visible part, between a beam on the wall and the next one off it.
  double edge(int wall, long beam, int sense) const {
    const auto n = static_cast<long>(sensor_.beams);
    const auto on_index = static_cast<double>(beam);
    if (!circle_ && (beam + sense < 0 || beam + sense >= n)) return alongWall(wall, on_index);
    double on = on_index;
    double off = on_index + sense;
    for (int i = 0; i < 40; ++i) {
      const double middle = 0.5 * (on + off);
      (hitAt(middle).what == wall ? on : off) = middle;
    }
    return alongWall(wall, on);
  }

  bool fitFloor(int wall, long first, long last, const scan::Scan& scan, VisibleSpan& span) const {
    std::vector<fitting::NoisyPoint> points;
    for (long i = first; i <= last; ++i) {
      const std::size_t beam = static_cast<std::size_t>(i) % sensor_.beams;
      if (hits_[beam].what == wall && scan.isValid(beam) && !astray_[beam]) {
        points.push_back({scan.point(beam), scan.covariance(beam)});
      }
    }
    span.beams = points.size();
    const auto fit = fitting::refineLine(points, span.line);
    if (!fit) return false;
    span.floor = fit->line;
    span.floor_ends = {midway(span.floor, scan, first, -1), midway(span.floor, scan, last, 1)};
    return true;
  }

  /// All that beams can say of an end that is no corner: it is between two of them.
  Eigen::Vector2d midway(const geometry::PolarLine& line, const scan::Scan& scan, long beam,
                         int sense) const {
    const auto n = static_cast<long>(sensor_.beams);
    const auto meet = [&](long i) -> Eigen::Vector2d {
      const auto index = static_cast<std::size_t>((i + n) % n);
      const Eigen::Vector2d origin = scan.sensorMotion().empty()
                                         ? Eigen::Vector2d::Zero()
                                         : scan.sensorMotion()[index].translation();
      const Eigen::Vector2d direction = scan.direction(index);
      const double range = -line.signedDistance(origin) / line.normal().dot(direction);
      return origin + range * direction;
    };
    if (!circle_ && (beam + sense < 0 || beam + sense >= n)) return meet(beam);
    return 0.5 * (meet(beam) + meet(beam + sense));
  }

  /// Takes the crossing of their lines for the end that two visible spans share.
  static void joinFloorCorners(VisibleSpan& span, const std::vector<VisibleSpan>& spans) {
    for (const VisibleSpan& other : spans) {
      if (other.wall == span.wall) continue;
      if ((other.ends.end - span.ends.start).norm() < 1e-3) {
        span.floor_ends.start = crossing(span.floor, other.floor);
      }
      if ((other.ends.start - span.ends.end).norm() < 1e-3) {
        span.floor_ends.end = crossing(span.floor, other.floor);
      }
    }
  }
  static Eigen::Vector2d crossing(const geometry::PolarLine& a, const geometry::PolarLine& b) {
    Eigen::Matrix2d normals;
    normals << a.normal().transpose(), b.normal().transpose();
    return normals.inverse() * Eigen::Vector2d(a.rho, b.rho);
  }

  const PlaneWorld& world_;
  Sensor sensor_;
  geometry::Pose2 pose_;
  bool circle_;
  std::vector<Hit> hits_;
  std::vector<bool> astray_;  // returns that are of nothing
};

}  // namespace sightline::bench
