#include "sightline/targets/look.h"

#include <algorithm>
#include <cmath>

#include "sightline/targets/error_mixture.h"

namespace sightline::targets {

namespace {

// Spread below which the probability of detection hardly differs over a component [m].
constexpr double kSmallSpread = 0.15;
// Largest probability of detection: were it 1, a single miss would leave nothing to weigh.
constexpr double kSurest = 0.999;
constexpr double kSqrtTwo = 1.4142135623730951;

double gaussian(double error, double variance) {
  return std::exp(-0.5 * error * error / variance) / std::sqrt(2.0 * geometry::kPi * variance);
}

// Lower triangular factor of a covariance.
Eigen::Matrix2d rootOf(const Eigen::Matrix2d& covariance) {
  Eigen::Matrix2d root = Eigen::Matrix2d::Zero();
  root(0, 0) = std::sqrt(std::max(covariance(0, 0), 1e-12));
  root(1, 0) = covariance(1, 0) / root(0, 0);
  root(1, 1) = std::sqrt(std::max(covariance(1, 1) - root(1, 0) * root(1, 0), 1e-12));
  return root;
}

// Mean of a function of the place over a component, by its sigma points.
template <class Function>
double meanOver(const Component& component, const Function& function) {
  const Eigen::Matrix2d root = kSqrtTwo * rootOf(component.covariance);
  double sum = 0.0;
  for (int axis = 0; axis < 2; ++axis) {
    sum += function(component.mean + root.col(axis));
    sum += function(component.mean - root.col(axis));
  }
  return 0.25 * sum;
}

}  // namespace

Look::Look(const BearingSet& set, const SensorModel& model)
    : set_(set),
      model_(model),
      T_sensor_map_(set.T_map_sensor.mean.inverse()),
      field_of_view_(set.field_of_view.within(model.config().field_of_view)),
      sigma_(std::max(model.config().bearing.sigma * model.config().bearing.tail, set.sigma)) {
  const BearingConfig& errors = model.config().bearing;
  splitErrors(errors.tail);
  for (const double bearing : set.bearings) {
    const double late = errors.lag * set.turn_rate;
    bearings_.push_back(errors.trueBearing(geometry::wrapAngle(bearing - late)));
    clutter_.push_back(model.clutter(bearings_.back(), set.T_map_sensor.mean));
  }
  for (const UncertainPoint& point : set.known) {
    const Component component{1.0, point.mean, point.covariance};
    const BearingPrediction prediction = predictBearing(component, pose(), sigma_);
    const double detected = detection(prediction.polar);
    if (detected > 0.0) known_.push_back({prediction, detected});
  }
}

double Look::knownRatio(std::size_t known, std::size_t measurement) const {
  const Known& thing = known_[known];
  return thing.detection * likelihood(measurement, thing.prediction) /
         (1.0 - std::min(thing.detection, 0.99));
}

double Look::knownDensity(std::size_t measurement) const {
  double density = 0.0;
  for (const Known& thing : known_) {
    density += thing.detection * likelihood(measurement, thing.prediction);
  }
  return density;
}

double Look::detection(const Polar& place) const {
  if (place.range > set_.range_max || !field_of_view_.contains(place.bearing)) return 0.0;
  return std::min(model_.detection(place), kSurest);
}

double Look::detectionAt(const Eigen::Vector2d& point_map) const {
  const double detected = detection(polarOf(T_sensor_map_ * point_map));
  return detected > 0.0 && model_.isInSight(point_map, pose().mean) ? detected : 0.0;
}

double Look::detection(const Component& component, const Polar& mean) const {
  if (component.covariance.trace() < kSmallSpread * kSmallSpread) {
    return model_.isInSight(component.mean, pose().mean) ? detection(mean) : 0.0;
  }
  return meanOver(component, [&](const Eigen::Vector2d& place) { return detectionAt(place); });
}

double Look::inSight(const Component& component) const {
  if (!model_.hasSight()) return 1.0;
  return meanOver(component, [&](const Eigen::Vector2d& place) {
    return model_.isInSight(place, pose().mean) ? 1.0 : 0.0;
  });
}

// A core and a wider Gaussian, as ErrorMixture, whose standard deviation together is `tail` times
// that of the core.
void Look::splitErrors(double tail) {
  const double wide = std::max(ErrorMixture::kWide, tail);
  const double share = (tail * tail - 1.0) / (wide * wide - 1.0);
  const double core_variance = std::pow(sigma_ / tail, 2);
  parts_[0] = {1.0 - share, core_variance - sigma_ * sigma_};
  parts_[1] = {share, wide * wide * core_variance - sigma_ * sigma_};
}

std::array<Look::PartDensity, 2> Look::partsAt(std::size_t measurement,
                                               const BearingPrediction& prediction) const {
  constexpr double kGate = 25.0;
  const double error = geometry::wrapAngle(bearings_[measurement] - prediction.polar.bearing);
  std::array<PartDensity, 2> densities{};
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const double variance = prediction.variance + parts_[i].extra;
    const bool is_inside = parts_[i].share > 0.0 && error * error <= kGate * variance;
    densities[i] = {is_inside ? parts_[i].share * gaussian(error, variance) : 0.0, variance};
  }
  return densities;
}

double Look::likelihood(std::size_t measurement, const BearingPrediction& prediction) const {
  const auto parts = partsAt(measurement, prediction);
  return parts[0].density + parts[1].density;
}

Look::Innovation Look::innovation(std::size_t measurement,
                                  const BearingPrediction& prediction) const {
  const auto parts = partsAt(measurement, prediction);
  const double weight = parts[0].density / parts[0].variance + parts[1].density / parts[1].variance;
  const double error = geometry::wrapAngle(bearings_[measurement] - prediction.polar.bearing);
  return {error, (parts[0].density + parts[1].density) / weight};
}

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
