#include "sightline/pipeline/repeat_watch.h"

#include <cmath>

namespace sightline::pipeline {

namespace {

constexpr struct {
  // Fewer returns than this may be the same by chance.
  std::size_t fewest = 30;
  // Noise shows where it is this share of the step of the ranges, and no rounding of floats [m].
  double share_of_step = 0.5;
  double least_noise = 5e-4;
  // Motion that no range could miss [m, rad].
  double way = 0.1;
  double turn = 0.05;
  // Time within which it counts: odometry drifts while a robot stands [ns].
  std::int64_t within = 1'000'000'000;
} kRepeat;

bool showsNoise(const scan::RangeNoise* noise) {
  return noise != nullptr && noise->is_learned && noise->sigma > kRepeat.least_noise &&
         noise->sigma > kRepeat.share_of_step * noise->step;
}

bool hasMoved(const std::optional<geometry::Pose2>& before,
              const std::optional<geometry::Pose2>& now) {
  if (!before || !now) return false;
  const geometry::Pose2 step = geometry::between(*before, *now);
  return step.translation().norm() > kRepeat.way || std::abs(step.theta()) > kRepeat.turn;
}

}  // namespace

// Compares the returns alone: what is not valid may be NaN, which equals nothing.
bool RepeatWatch::isSame(const scan::Scan& scan) const {
  if (scan.beams() != ranges_.size()) return false;
  std::size_t returns = 0;
  for (std::size_t i = 0; i < scan.beams(); ++i) {
    if (!scan.isValid(i)) continue;
    if (scan.ranges()[i] != ranges_[i]) return false;
    ++returns;
  }
  return returns >= kRepeat.fewest;
}

void RepeatWatch::comeAnew(std::int64_t stamp, const std::optional<geometry::Pose2>& T_odom_base) {
  since_ = stamp;
  T_odom_base_ = T_odom_base;
}

bool RepeatWatch::isRepeat(const scan::Scan& scan, const scan::RangeNoise* noise,
                           const std::optional<geometry::Pose2>& T_odom_base) {
  if (isSame(scan)) {
    const bool is_repeat = showsNoise(noise) || hasMoved(T_odom_base_, T_odom_base);
    if (!is_repeat && scan.stamp - since_ > kRepeat.within) comeAnew(scan.stamp, T_odom_base);
    return is_repeat;
  }
  ranges_ = scan.ranges();
  comeAnew(scan.stamp, T_odom_base);
  return false;
}

}  // namespace sightline::pipeline
