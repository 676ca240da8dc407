#include "sightline/tracking/validation_gate.h"

#include <algorithm>
#include <cmath>

namespace sightline::tracking {

namespace {

// A wall piece shifted along itself is still the wall; past this it no longer tells where it ends.
constexpr double kMaxAlongSlack = 0.3;

}  // namespace

ValidationGate::ValidationGate(const GateConfig& config, const world::Wall& wall, double wall_sigma,
                               const geometry::UncertainPose2& T_map_base, double point_sigma)
    : wall_(&wall) {
  const geometry::UncertainPose2 T_base_map = geometry::inverse(T_map_base);
  predicted_ = geometry::transform(T_base_map, wall.segment.line());
  const geometry::Segment segment_base = T_base_map.mean * wall.segment;
  normal_ = segment_base.leftNormal();
  direction_ = segment_base.direction();
  start_base_ = segment_base.start;
  foot_ = -direction_.dot(start_base_);

  size_.opening = std::min(
      config.max_opening,
      config.sigmas * std::hypot(std::sqrt(predicted_.covariance(0, 0)), wall_sigma, point_sigma));
  size_.angle =
      std::min(config.max_angle, std::atan(config.sigmas * std::sqrt(predicted_.covariance(1, 1))));
  slope_ = std::tan(size_.angle);
  const Eigen::Vector2d along_map = wall.segment.direction();
  const double along_variance =
      along_map.dot(T_map_base.covariance.topLeftCorner<2, 2>() * along_map);
  along_slack_ = std::min(kMaxAlongSlack, config.sigmas * std::sqrt(along_variance));
}

bool ValidationGate::contains(const BeamPoint& point) const {
  const Eigen::Vector2d from_start = point.position - start_base_;
  const double along = direction_.dot(from_start);
  const double distance = normal_.dot(from_start);
  if (std::abs(distance) > size_.opening + std::abs(along - foot_) * slope_) return false;
  const bool from_inside = normal_.dot(point.origin - start_base_) > 0.0;
  return from_inside && isOnSpan(along);
}

// The same arithmetic as of one beam, side by side.
void ValidationGate::excesses(const BeamEnds& ends, std::vector<double>& excesses) const {
  const std::size_t count = ends.x.size();
  excesses.resize(count);
  const double* x = ends.x.data();
  const double* y = ends.y.data();
  double* excess = excesses.data();
  const double start_x = start_base_.x(), start_y = start_base_.y();
  const double normal_x = normal_.x(), normal_y = normal_.y();
  const double along_x = direction_.x(), along_y = direction_.y();
  const double opening = size_.opening, slope = slope_, foot = foot_;
  for (std::size_t i = 0; i < count; ++i) {
    const double from_x = x[i] - start_x;
    const double from_y = y[i] - start_y;
    const double along = along_x * from_x + along_y * from_y;
    const double distance = normal_x * from_x + normal_y * from_y;
    excess[i] = std::abs(distance) - (opening + std::abs(along - foot) * slope);
  }
}

bool ValidationGate::isOnSpan(double along) const {
  return std::any_of(wall_->spans.begin(), wall_->spans.end(), [&](const world::Span& span) {
    return along >= span.from - along_slack_ && along <= span.to + along_slack_;
  });
}

}  // namespace sightline::tracking
