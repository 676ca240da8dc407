#pragma once

#include "lines/noisy_motion.h"
#include "sightline/geometry/statistics.h"
#include "sightline/lines/line_extractor.h"

namespace sightline::test {

/// Whether the covariances of a wall's line tell the truth where the sensor's motion within the
/// sweep is not known exactly (pears eqs 14, 21, 23 and 24).
struct MotionConsistency {
  double found = 0.0;         ///< ratio of scans with one line
  double inside = 0.0;        ///< ratio within the gate of 95 %
  double nees = 0.0;          ///< mean, of 2
  double nees_ignored = 0.0;  ///< the same where the extractor is not told of the noise
};

/// A wall ahead on y = distance, between two places.
struct WallPlace {
  const char* name;
  double distance, from, to;  // [m]
};
inline constexpr WallPlace kWallPlaces[] = {
    {"near", 0.8, -0.6, 0.7}, {"oblique", 1.5, 1.0, 4.0}, {"far", 6.0, -4.0, 3.0}};

inline NoisySweep inFrontOf(const WallPlace& wall, NoisySweep sweep) {
  sweep.scan = wallAhead(wall.distance, wall.from, wall.to);
  return sweep;
}

/// A head that turns, at 0.36° of jitter about an axis beside the scanner.
inline NoisySweep jitteringHead() {
  NoisySweep sweep;
  sweep.motion = {0.0, 0.0, 0.3};
  sweep.noise.jitter = std::pow(geometry::radians(0.36), 2);
  sweep.noise.jitter_axis = {-0.05, 0.02};
  return sweep;
}

/// A robot that drives 1 m/s and turns 3 rad/s in a sweep of 0.1 s, each wrong by 2 %.
inline NoisySweep wrongOdometry(bool drift, bool walk) {
  NoisySweep sweep;
  sweep.motion = {0.1, 0.0, 0.3};
  const Eigen::Vector3d sigma = 0.02 * sweep.motion;
  if (drift) sweep.noise.drift.diagonal() = sigma.cwiseAbs2();
  if (walk) sweep.noise.walk.diagonal() = sigma.cwiseAbs2();
  return sweep;
}

class ConsistencyRun {
 public:
  explicit ConsistencyRun(const NoisySweep& sweep) : sweep_(sweep) {}

  MotionConsistency of(int seeds, int runs) {
    for (int seed = 1; seed <= seeds; ++seed) {
      Gauss gauss(static_cast<unsigned>(seed));
      for (int i = 0; i < runs; ++i) add(sweep_.take(gauss));
    }
    const double lines = nees_.count();
    return {lines / (seeds * runs), inside_ / lines, nees_.mean()[0], ignored_.mean()[0]};
  }

 private:
  void add(scan::Scan scan) {
    if (take(scan, nees_) <= geometry::kChiSquare95Of2) inside_ += 1.0;
    scan.motion_noise = {};
    take(scan, ignored_);
  }
  double take(const scan::Scan& scan, Moments<1>& moments) {
    const auto& segments = extractor_.extract(scan);
    if (segments.size() != 1) return std::numeric_limits<double>::infinity();
    const Eigen::Vector2d error = geometry::difference(segments[0].line, sweep_.wall());
    const double nees = normalisedSquare<2>(error, segments[0].line.covariance);
    moments.add(Moments<1>::Vector(nees));
    return nees;
  }

  const NoisySweep& sweep_;
  lines::LineExtractor extractor_;
  Moments<1> nees_, ignored_;
  double inside_ = 0.0;
};

}  // namespace sightline::test
