#include "sightline/motion/sensor_path.h"

#include <algorithm>
#include <cmath>

namespace sightline::motion {

using geometry::Pose2;

namespace {

constexpr std::size_t kMost = 256;  // stretches of a sweep, however long it is
constexpr double kAtRest = 1e-9;    // [m, rad] of motion that is none

// Poses at even times from the first beam to the last, in the frame at the stamp.
struct Samples {
  double duration;  // [s]
  std::vector<Pose2> poses;

  double stretch() const { return duration / static_cast<double>(poses.size() - 1); }
  bool isStill() const {
    return std::all_of(poses.begin(), poses.end(),
                       [](const Pose2& pose) { return pose.coordinates().isZero(kAtRest); });
  }
};

std::optional<Samples> sample(const PoseAfter& path, double duration) {
  const double wanted = std::ceil(std::abs(duration) / kStretch);
  const std::size_t stretches = std::clamp<std::size_t>(static_cast<std::size_t>(wanted), 1, kMost);
  const auto start = path(0.0);
  if (!start) return std::nullopt;
  Samples samples{duration, {Pose2()}};
  for (std::size_t i = 1; i <= stretches; ++i) {
    const auto pose = path(duration * static_cast<double>(i) / static_cast<double>(stretches));
    if (!pose) return std::nullopt;
    samples.poses.push_back(geometry::between(*start, *pose));
  }
  return samples;
}

// A pose within a stretch by constant velocity; before the first and after the last stretch, where
// beams have times out of order, by that stretch's.
class Interpolation {
 public:
  explicit Interpolation(const Samples& samples) : samples_(samples) {
    for (std::size_t i = 0; i + 1 < samples.poses.size(); ++i) {
      velocities_.push_back(geometry::between(samples.poses[i], samples.poses[i + 1]).log() /
                            samples.stretch());
    }
  }

  Pose2 at(double time) const {
    const double place = std::floor(time / samples_.stretch());
    const auto last = static_cast<double>(velocities_.size() - 1);
    const auto stretch = static_cast<std::size_t>(std::clamp(place, 0.0, last));
    const double rest = time - static_cast<double>(stretch) * samples_.stretch();
    return samples_.poses[stretch] * Pose2::exp(rest * velocities_[stretch]);
  }

 private:
  const Samples& samples_;
  std::vector<Eigen::Vector3d> velocities_;
};

}  // namespace

std::optional<std::vector<Pose2>> sweepAlong(const PoseAfter& path,
                                             const scan::ScanGeometry& geometry) {
  const double duration = geometry.timeOffsets().back();
  if (duration == 0.0) return path(0.0) ? std::make_optional<std::vector<Pose2>>() : std::nullopt;
  const auto samples = sample(path, duration);
  if (!samples) return std::nullopt;
  std::vector<Pose2> poses;
  if (samples->isStill()) return poses;
  const Interpolation interpolation(*samples);
  poses.reserve(geometry.beams());
  for (const double offset : geometry.timeOffsets()) poses.push_back(interpolation.at(offset));
  return poses;
}

}  // namespace sightline::motion
