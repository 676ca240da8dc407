#include "sightline/gaze/fixation.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/LU>

#include "sightline/geometry/statistics.h"

namespace sightline::gaze {

namespace {

using geometry::Feature;
using geometry::FeatureBehaviour;
using geometry::FeatureKind;
using geometry::Pose2;

constexpr struct {
  // Uncertainty of a place that only the memory holds, after a second [m].
  double growth = 0.05;
  // Share of the half field that the prediction may be uncertain by before the head searches.
  double sure = 0.8;
  // A search goes so far [σ], and is so fast [rad/s].
  double width = 2.5;
  double rate = 1.5;
  double gate = 3.5;  // for a feature with another id [σ]
} kFixation;

double secondsBetween(std::int64_t from, std::int64_t to) {
  return 1e-9 * static_cast<double>(to - from);
}

// A triangle wave with period 4 and amplitude 1, from 0 up.
double triangle(double phase) {
  const double turned = std::fmod(phase, 4.0);
  return turned < 1.0 ? turned : turned < 3.0 ? 2.0 - turned : turned - 4.0;
}

}  // namespace

Fixation::Fixation(const Feature& feature, std::int64_t stamp, const GazeConfig& config)
    : config_(&config) {
  adopt(feature, stamp);
}

void Fixation::adopt(const Feature& feature, std::int64_t stamp) {
  id_ = feature.id;
  kind_ = feature.kind;
  position_ = feature.position;
  covariance_ = feature.covariance;
  velocity_ = feature.velocity;
  stamp_ = stamp;
  seen_ = stamp - std::llround(1e9 * feature.unseen);
}

void Fixation::see(const std::vector<Feature>& features, std::int64_t stamp) {
  const auto same = std::find_if(features.begin(), features.end(),
                                 [&](const Feature& feature) { return feature.id == id_; });
  if (same != features.end()) {
    adopt(*same, stamp);
    return;
  }
  const double elapsed = std::max(0.0, secondsBetween(stamp_, stamp));
  position_ += elapsed * velocity_;
  covariance_ += kFixation.growth * kFixation.growth * elapsed * Eigen::Matrix2d::Identity();
  stamp_ = stamp;
  if (const Feature* const found = successor(features)) adopt(*found, stamp);
}

const Feature* Fixation::successor(const std::vector<Feature>& features) const {
  const Feature* nearest = nullptr;
  double least = kFixation.gate * kFixation.gate;
  for (const Feature& feature : features) {
    const bool is_alike = (feature.kind == FeatureKind::kArc) == (kind_ == FeatureKind::kArc);
    if (!is_alike || feature.unseen > 0.0 || feature.kind == FeatureKind::kLineEnd) continue;
    const Eigen::Vector2d apart = feature.position - position_;
    const Eigen::Matrix2d sum = covariance_ + feature.covariance;
    const double distance = apart.dot(sum.inverse() * apart);
    if (distance >= least) continue;
    least = distance;
    nearest = &feature;
  }
  return nearest;
}

double Fixation::unseen(std::int64_t now) const {
  return std::max(0.0, secondsBetween(seen_, now));
}

// Half of what a search covers [rad]; 0 where the field holds the whole uncertainty.
double Fixation::searchWidth(const Eigen::Vector2d& place_mount) const {
  const double sigma = std::sqrt(covariance_.trace());
  const double width = kFixation.width * sigma / std::max(0.1, place_mount.norm());
  return width < kFixation.sure * config_->field.half_width ? 0.0 : std::min(width, geometry::kPi);
}

double Fixation::aim(const Pose2& T_odom_mount, std::int64_t now) const {
  const double ahead = std::max(0.0, secondsBetween(stamp_, now));
  const Eigen::Vector2d place = T_odom_mount.inverse() * (position_ + ahead * velocity_);
  const double middle = config_->field.aimAt(place);
  const double width = isLost(now) ? searchWidth(place) : 0.0;
  if (width == 0.0) return middle;
  const double searched = unseen(now) - config_->lost_after;
  return middle + width * triangle(searched * kFixation.rate / width);
}

bool FeatureChoice::isInReach(const Feature& feature) const {
  const bool is_border =
      feature.kind == FeatureKind::kLineEnd || feature.behaviour == FeatureBehaviour::kSliding;
  if (is_border) return false;
  const Eigen::Vector2d place = T_odom_mount_.inverse() * feature.position;
  const double aim = config_.field.aimAt(place);
  return config_.field.holds(place, std::clamp(aim, config_.head.lower, config_.head.upper));
}

const Feature* FeatureChoice::byId(std::uint32_t id) const {
  for (const Feature& feature : features_) {
    if (feature.id == id) return &feature;
  }
  return nullptr;
}

const Feature* FeatureChoice::at(const Eigen::Vector2d& place_odom) const {
  const Feature* nearest = nullptr;
  double least = config_.click_radius;
  for (const Feature& feature : features_) {
    const double distance = (feature.position - place_odom).norm();
    if (feature.kind == FeatureKind::kLineEnd || distance >= least) continue;
    least = distance;
    nearest = &feature;
  }
  return nearest;
}

const Feature* FeatureChoice::nearestCorner() const {
  const Feature* nearest = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const Feature& feature : features_) {
    const double distance = (feature.position - T_odom_mount_.translation()).norm();
    if (feature.kind != FeatureKind::kCorner || !isInReach(feature) || distance >= least) continue;
    least = distance;
    nearest = &feature;
  }
  return nearest;
}

// Drop of the variance of the place that one sighting of a feature would bring [m²].
double FeatureChoice::drop(const Feature& feature, const Eigen::Matrix3d& covariance) const {
  const Eigen::Vector2d arm = feature.position - T_odom_mount_.translation();
  Eigen::Matrix<double, 2, 3> H;
  H << -1.0, 0.0, arm.y(), 0.0, -1.0, -arm.x();
  const double sigma = config_.field.sigmaAt(arm.norm());
  const Eigen::Matrix2d S = H * covariance * H.transpose() + feature.covariance +
                            sigma * sigma * Eigen::Matrix2d::Identity();
  const Eigen::Matrix3d reduction = covariance * H.transpose() * S.inverse() * H * covariance;
  return reduction(0, 0) + reduction(1, 1);
}

const Feature* FeatureChoice::mostInformative(const Eigen::Matrix3d& covariance) const {
  const Feature* best = nullptr;
  double most = 0.0;
  for (const Feature& feature : features_) {
    if (feature.behaviour != FeatureBehaviour::kFixed || !isInReach(feature)) continue;
    const double value = drop(feature, covariance);
    if (value <= most) continue;
    most = value;
    best = &feature;
  }
  return best;
}

}  // namespace sightline::gaze
