#include "sightline/targets/bernoulli.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace sightline::targets {

BearingJacobians bearingJacobians(const Eigen::Vector2d& point_map,
                                  const geometry::Pose2& T_map_sensor) {
  const Eigen::Vector2d way = point_map - T_map_sensor.translation();
  // A point at the sensor itself has no bearing; a millimetre keeps the derivatives finite.
  const double square = std::max(way.squaredNorm(), 1e-6);
  BearingJacobians result;
  result.polar.range = std::sqrt(square);
  result.polar.bearing = geometry::wrapAngle(std::atan2(way.y(), way.x()) - T_map_sensor.theta());
  result.point << -way.y() / square, way.x() / square;
  result.pose << -result.point, -1.0;
  return result;
}

BearingPrediction predictBearing(const Component& component,
                                 const geometry::UncertainPose2& T_map_sensor, double sigma) {
  const BearingJacobians jacobians = bearingJacobians(component.mean, T_map_sensor.mean);
  BearingPrediction result;
  result.polar = jacobians.polar;
  result.slope = jacobians.point;
  result.shared.setZero();
  result.gain = component.covariance * jacobians.point.transpose();
  result.variance = sigma * sigma + jacobians.point * result.gain +
                    jacobians.pose * T_map_sensor.covariance * jacobians.pose.transpose();
  return result;
}

Component updated(const Component& component, const BearingPrediction& prediction,
                  double innovation) {
  Component result = component;
  const Eigen::Vector2d weight = prediction.gain / prediction.variance;
  result.mean += weight * innovation;
  result.covariance -= weight * prediction.gain.transpose();
  for (SharedCovariance& shared : result.shared) shared -= weight * (prediction.slope * shared);
  if (prediction.robot < result.shared.size()) {
    result.shared[prediction.robot] -= weight * prediction.shared;
  }
  return result;
}

namespace {

double squareDistance(const Component& heavy, const Component& other) {
  const Eigen::Vector2d apart = other.mean - heavy.mean;
  const Eigen::Matrix2d& p = heavy.covariance;
  const double determinant = p(0, 0) * p(1, 1) - p(0, 1) * p(1, 0);
  const double scaled = p(1, 1) * apart.x() * apart.x() + p(0, 0) * apart.y() * apart.y() -
                        2.0 * p(0, 1) * apart.x() * apart.y();
  return scaled / determinant;
}

void mergeShared(Component& into, const Component& other, double share) {
  const std::size_t robots = std::max(into.shared.size(), other.shared.size());
  into.shared.resize(robots, SharedCovariance::Zero());
  for (std::size_t i = 0; i < robots; ++i) {
    into.shared[i] *= 1.0 - share;
    if (i < other.shared.size()) into.shared[i] += share * other.shared[i];
  }
}

// Adds another Gaussian so that mean and covariance of both together are kept.
void merge(Component& into, const Component& other) {
  const double weight = into.weight + other.weight;
  const double share = other.weight / weight;
  const Eigen::Vector2d apart = other.mean - into.mean;
  into.covariance = (1.0 - share) * into.covariance + share * other.covariance +
                    share * (1.0 - share) * apart * apart.transpose();
  into.mean += share * apart;
  mergeShared(into, other, share);
  into.weight = weight;
}

void mergeNear(Mixture& mixture, double distance) {
  for (std::size_t i = 0; i < mixture.size(); ++i) {
    for (std::size_t j = i + 1; j < mixture.size();) {
      const bool is_near =
          mixture[i].mode == mixture[j].mode && squareDistance(mixture[i], mixture[j]) < distance;
      if (is_near) {
        merge(mixture[i], mixture[j]);
        mixture.erase(mixture.begin() + static_cast<std::ptrdiff_t>(j));
      } else {
        ++j;
      }
    }
  }
}

bool isHeavier(const Component& a, const Component& b) {
  return a.weight > b.weight;
}

void normalise(Mixture& mixture) {
  double sum = 0.0;
  for (const Component& component : mixture) sum += component.weight;
  if (!(sum > 0.0)) return;  // nothing of it can be: its existence is 0
  for (Component& component : mixture) component.weight /= sum;
}

// Keeps the first so many components of targets, and of other things.
void keepFirst(Mixture& mixture, std::size_t most) {
  std::size_t kept[2] = {};
  const auto is_beyond = [&](const Component& component) {
    return ++kept[isTarget(component.mode) ? 0 : 1] > most;
  };
  mixture.erase(std::remove_if(mixture.begin(), mixture.end(), is_beyond), mixture.end());
}

}  // namespace

void reduce(Mixture& mixture, double distance, double least, std::size_t most) {
  if (mixture.empty()) return;
  normalise(mixture);
  std::sort(mixture.begin(), mixture.end(), isHeavier);
  while (mixture.size() > 1 && mixture.back().weight < least) mixture.pop_back();
  mergeNear(mixture, distance);
  std::sort(mixture.begin(), mixture.end(), isHeavier);
  keepFirst(mixture, most);
  normalise(mixture);
}

UncertainPoint momentsOf(const Mixture& mixture) {
  UncertainPoint result;
  for (const Component& component : mixture) result.mean += component.weight * component.mean;
  for (const Component& component : mixture) {
    const Eigen::Vector2d apart = component.mean - result.mean;
    result.covariance += component.weight * (component.covariance + apart * apart.transpose());
  }
  return result;
}

Mixture ofTarget(const Mixture& mixture) {
  Mixture result;
  std::copy_if(mixture.begin(), mixture.end(), std::back_inserter(result),
               [](const Component& component) { return isTarget(component.mode); });
  normalise(result);
  return result;
}

double shareOf(const Mixture& mixture, Mode mode) {
  double share = 0.0;
  for (const Component& component : mixture) share += component.mode == mode ? component.weight : 0;
  return share;
}

double targetExistence(const Bernoulli& bernoulli) {
  const double share =
      shareOf(bernoulli.mixture, Mode::kStanding) + shareOf(bernoulli.mixture, Mode::kMoving);
  return bernoulli.existence * std::min(share, 1.0);
}

}  // namespace sightline::targets
