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

// Of all errors at rest [rad].
double restingSigma(const BearingSet& set, const BearingConfig& errors) {
  return std::max(errors.sigma * errors.tail, set.sigma);
}

double sigmaOf(const BearingSet& set, const BearingConfig& errors) {
  return std::hypot(restingSigma(set, errors), errors.jitter * set.turn_rate);
}

// Lower triangular factor of a covariance, which may be singular.
template <int N>
Eigen::Matrix<double, N, N> rootOf(const Eigen::Matrix<double, N, N>& covariance) {
  Eigen::Matrix<double, N, N> root = Eigen::Matrix<double, N, N>::Zero();
  for (int i = 0; i < N; ++i) {
    const double rest = covariance(i, i) - root.row(i).squaredNorm();
    if (rest <= 1e-12) continue;  // nothing is left along this axis
    root(i, i) = std::sqrt(rest);
    for (int j = i + 1; j < N; ++j) {
      root(j, i) = (covariance(j, i) - root.row(j).dot(root.row(i))) / root(i, i);
    }
  }
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

Look::Look(const BearingSet& set, const SensorModel& model, double pose_duration)
    : set_(set),
      model_(model),
      T_sensor_map_(set.T_map_sensor.mean.inverse()),
      field_of_view_(set.field_of_view.within(model.config().field_of_view)),
      sigma_(sigmaOf(set, model.config().bearing)) {
  const BearingConfig& errors = model.config().bearing;
  splitErrors(errors.tail);
  shareErrors(errors, pose_duration);
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

double Look::knownRatio(std::size_t known, std::size_t measurement, const Offset& offset) const {
  const Known& thing = known_[known];
  return thing.detection * likelihood(measurement, thing.prediction, offset) /
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

void Look::shareErrors(const BearingConfig& errors, double pose_duration) {
  const Eigen::Matrix3d& covariance = pose().covariance;
  const double resting = std::pow(restingSigma(set_, errors) / sigma_, 2);
  lasting_sigma_ = std::sqrt(errors.lasting_share * resting) * sigma_;
  apart_ = 1.0 - errors.lasting_share * resting;
  own_ = (1.0 - std::max(errors.common_share, errors.lasting_share)) * resting;
  common_variance_ = (1.0 - own_) * sigma_ * sigma_ + covariance(2, 2);
  lasts_ = lasting_sigma_ > 0.0 || !covariance.isZero(0.0);
  pose_root_ = rootOf(covariance);
  durations_ = {pose_duration, errors.lasting_duration};
}

BearingPrediction Look::predict(const Component& component) const {
  BearingPrediction result = predictBearing(component, pose(), sigma_);
  if (!lasts_) return result;
  result.robot = set_.robot;
  result.shared << Eigen::RowVector3d(-result.slope.x(), -result.slope.y(), -1.0) * pose_root_,
      lasting_sigma_;
  if (result.robot >= component.shared.size()) return result;
  const SharedCovariance& known = component.shared[result.robot];
  result.gain += known * result.shared.transpose();
  result.variance += 2.0 * result.slope * known * result.shared.transpose();
  return result;
}

SharedCovariance Look::sharedAlong(double range, double bearing) const {
  const double direction = pose().mean.theta() + bearing;
  const Eigen::Vector2d across(-range * std::sin(direction), range * std::cos(direction));
  SharedCovariance result;
  result << pose_root_.topRows<2>() + across * pose_root_.row(2), -lasting_sigma_ * across;
  return result;
}

void Look::age(Bernoulli& bernoulli) const {
  if (!lasts_) return;
  const std::size_t robot = set_.robot;
  if (robot >= bernoulli.shared_stamps.size()) {
    bernoulli.shared_stamps.resize(robot + 1, set_.stamp);
  }
  const double passed = 1e-9 * static_cast<double>(set_.stamp - bernoulli.shared_stamps[robot]);
  const double of_pose = std::exp(-std::abs(passed) / durations_[0]);
  const double of_sensor = std::exp(-std::abs(passed) / durations_[1]);
  bernoulli.shared_stamps[robot] = set_.stamp;
  for (Component& component : bernoulli.mixture) {
    if (robot >= component.shared.size()) {
      component.shared.resize(robot + 1, SharedCovariance::Zero());
    }
    component.shared[robot].leftCols<3>() *= of_pose;
    component.shared[robot].col(3) *= of_sensor;
  }
}

std::array<Look::PartDensity, 2> Look::partsOf(double error, double variance, double share) const {
  constexpr double kGate = 25.0;
  std::array<PartDensity, 2> densities{};
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const double of_part = variance + share * parts_[i].extra;
    const bool is_inside = parts_[i].share > 0.0 && error * error <= kGate * of_part;
    densities[i] = {is_inside ? parts_[i].share * gaussian(error, of_part) : 0.0, of_part};
  }
  return densities;
}

std::array<Look::PartDensity, 2> Look::partsAt(std::size_t measurement,
                                               const BearingPrediction& prediction) const {
  const double error = geometry::wrapAngle(bearings_[measurement] - prediction.polar.bearing);
  return partsOf(error, prediction.variance, apart_);
}

double Look::likelihood(std::size_t measurement, const BearingPrediction& prediction,
                        const Offset& offset) const {
  const double error =
      geometry::wrapAngle(bearings_[measurement] - prediction.polar.bearing - offset.mean);
  // Places that share this robot's errors already know part of what is taken off here.
  const double variance =
      std::max(prediction.variance - common_variance_ + offset.variance, ownVariance());
  const auto parts = partsOf(error, variance, own_);
  return parts[0].density + parts[1].density;
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

}  // namespace sightline::targets
