#include <algorithm>
#include <cmath>

#include "sightline/targets/look.h"

namespace sightline::targets {

namespace {

struct RangeSpan {
  double from;
  double to;
};

// Mass of undetected targets in a span, and the range of its middle, weighed by it.
struct SpanMass {
  double mass = 0.0;
  double range = 0.0;
};

SpanMass massOf(const RangeSpan& span, const Look& look, double bearing,
                const Undetected& undetected) {
  constexpr int kSamples = 4;
  const geometry::Pose2& sensor = look.pose().mean;
  const Eigen::Vector2d direction(std::cos(sensor.theta() + bearing),
                                  std::sin(sensor.theta() + bearing));
  const double step = (span.to - span.from) / kSamples;
  SpanMass result;
  for (int i = 0; i < kSamples; ++i) {
    const double range = span.from + (i + 0.5) * step;
    const Eigen::Vector2d point = sensor.translation() + range * direction;
    const double detection = look.detection(Polar{range, bearing});
    if (detection == 0.0 || !look.model().isInSight(point, sensor)) continue;
    const double mass = undetected.at(point) * detection * range * step;
    result.mass += mass;
    result.range += mass * range;
  }
  if (result.mass > 0.0) result.range /= result.mass;
  return result;
}

// Covers the span along the bearing, and the bearing's error and that of the pose across.
Component componentOf(const RangeSpan& span, const SpanMass& mass, const Look& look,
                      double bearing) {
  const geometry::UncertainPose2& pose = look.pose();
  const double direction = pose.mean.theta() + bearing;
  const Eigen::Vector2d along(std::cos(direction), std::sin(direction));
  const Eigen::Vector2d across(-along.y(), along.x());
  const double length = (span.to - span.from) / std::sqrt(12.0);
  const double width = mass.range * look.sigma();
  Component component;
  component.weight = mass.mass;
  component.mean = pose.mean.translation() + mass.range * along;
  component.covariance =
      length * length * along * along.transpose() + width * width * across * across.transpose();
  const Eigen::Matrix<double, 2, 3> by_pose =
      (Eigen::Matrix<double, 2, 3>() << Eigen::Matrix2d::Identity(), mass.range * across)
          .finished();
  component.covariance += by_pose * pose.covariance * by_pose.transpose();
  if (look.lasts()) {
    component.shared.resize(look.set().robot + 1, SharedCovariance::Zero());
    component.shared.back() = look.sharedAlong(mass.range, bearing);
  }
  return component;
}

}  // namespace

Birth birthAlong(const Look& look, std::size_t measurement, const Undetected& undetected, int count,
                 double nearest) {
  const DetectionConfig& detection = look.model().config().detection;
  const double first = std::max(nearest, detection.range_min);
  const double last = std::min(detection.range_max, look.set().range_max);
  Birth birth;
  if (first >= last) return birth;
  const double ratio = std::pow(last / first, 1.0 / count);
  const double bearing = look.bearing(measurement);
  RangeSpan span{first, first * ratio};
  for (int i = 0; i < count; ++i, span = {span.to, span.to * ratio}) {
    const SpanMass mass = massOf(span, look, bearing, undetected);
    if (mass.mass <= 0.0) continue;
    birth.mass += mass.mass;
    birth.mixture.push_back(componentOf(span, mass, look, bearing));
  }
  for (Component& component : birth.mixture) component.weight /= birth.mass;
  return birth;
}

}  // namespace sightline::targets
