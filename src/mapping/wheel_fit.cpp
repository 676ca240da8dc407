#include "sightline/mapping/wheel_fit.h"

#include <algorithm>

namespace sightline::mapping {

namespace {

constexpr struct {
  // Error of a pose of the path against one soon after [m, rad].
  double position = 0.005;
  double heading = 0.003;
} kWheelFit{};

}  // namespace

std::optional<motion::OdometryFit> fitWheels(const Survey& survey,
                                             const std::vector<geometry::StampedPose2>& poses) {
  const Eigen::Array3d sigma(kWheelFit.position, kWheelFit.position, kWheelFit.heading);
  const Eigen::Matrix3d covariance = sigma.square().matrix().asDiagonal();
  motion::OdometryLegs legs;
  const std::size_t size = std::min(poses.size(), survey.path().size());
  for (std::size_t i = 0; i < size; ++i) {
    const PathPoint& point = survey.path()[i];
    if (!point.T_wheels_base || point.wheels_broke) legs.interrupt();
    if (point.T_wheels_base) legs.add(*point.T_wheels_base, {poses[i].pose, covariance});
  }
  if (legs.legs().empty()) return std::nullopt;
  return motion::fitOdometry(legs.legs());
}

pipeline::EstimatorsConfig withWheels(pipeline::EstimatorsConfig config,
                                      const std::optional<motion::OdometryFit>& wheels) {
  if (!wheels || !config.rooms) return config;
  motion::OdometryNoise& noise = config.rooms->tracker.odometry;
  if (wheels->scale.is_known) {
    noise.scale_mean = wheels->scale.value;
    noise.scale_sigma = wheels->noise.scale_sigma;
  }
  if (wheels->steering.is_known) noise.steering_bias = wheels->steering.value;
  if (wheels->heading.is_known) noise.heading_bias_per_metre = wheels->heading.value;
  return config;
}

}  // namespace sightline::mapping
