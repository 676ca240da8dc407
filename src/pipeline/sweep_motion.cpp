#include "sightline/pipeline/sweep_motion.h"

#include <cmath>
#include <utility>

#include "sightline/motion/sensor_path.h"
#include "sightline/motion/sweep_noise.h"

namespace sightline::pipeline {

using geometry::Pose2;

void SweepMotion::add(const ArrivedScan& arrived, const PoseAt& T_odom_carried,
                      const PoseAt& T_odom_base, std::int64_t lag, LocatedScan& located) const {
  const std::int64_t stamp = arrived.scan.stamp - lag;
  const OdometryBridge bridge(config_.odometry_limits);
  if (!bridge.isContinuous(stamp, arrived.scan.end() - lag, T_odom_carried)) return;
  const auto path = [&](double after) { return T_odom_carried(stamp + std::llround(1e9 * after)); };
  auto motion = motion::sweepAlong(path, *located.scan.geometry());
  if (!motion) return;
  located.motion_known = true;
  if (!arrived.head) {
    located.scan.setSensorMotion(std::move(*motion));
  } else {
    const auto head = located.upside_down ? motion::mirrored(*arrived.head) : *arrived.head;
    located.scan.setSensorMotion(motion::headMotion(head, *motion));
  }
  addNoise(arrived, T_odom_base, lag, located);
}

void SweepMotion::addNoise(const ArrivedScan& arrived, const PoseAt& T_odom_base, std::int64_t lag,
                           LocatedScan& located) const {
  if (located.scan.sensorMotion().empty()) return;
  const auto start = T_odom_base(arrived.scan.stamp - lag);
  const auto end = T_odom_base(arrived.scan.end() - lag);
  // The carried frame is taken for the base where the base is not known.
  const Pose2 T_start_end =
      start && end ? geometry::between(*start, *end) : located.scan.sensorMotion().back();
  located.scan.motion_noise =
      motion::sweepNoise(config_.sweep_noise, T_start_end, located.T_base_sensor.value_or(Pose2()),
                         arrived.scan.duration());
  addJitter(arrived, located);
}

// A head that turns is where its joint says, but for an error that each reading draws anew (pears
// eq. 23); one that stands has the same error throughout.
void SweepMotion::addJitter(const ArrivedScan& arrived, LocatedScan& located) const {
  if (!arrived.head || config_.head_sigma == 0.0) return;
  const auto head = located.upside_down ? motion::mirrored(*arrived.head) : *arrived.head;
  if (motion::headMotion(head).empty()) return;
  located.scan.motion_noise.jitter = config_.head_sigma * config_.head_sigma;
  located.scan.motion_noise.jitter_axis = head.T_mount_sensor(0).inverse().translation();
}

}  // namespace sightline::pipeline
