#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/LU>

#include "bench/figures.h"
#include "sightline/lines/place_in_view.h"
#include "sightline/pipeline/estimators.h"
#include "sightline/world/world.h"

namespace sightline::bench {

/// Judges features by the corners, ends and round things that a world really has.
class FeatureScore {
 public:
  explicit FeatureScore(const world::World& world) {
    for (const auto& segment : world.segments()) {
      for (const auto& place : {segment.segment.start, segment.segment.end}) addPlace(place);
    }
    for (const auto& disc : world.discs()) places_.push_back({disc.centre, true});
  }

  void add(const pipeline::Estimates& estimates, const geometry::Pose2& T_map_base) {
    if (!estimates.features) return;
    const geometry::Pose2 T_odom_map = *estimates.located.T_odom_base * T_map_base.inverse();
    for (const auto& feature : *estimates.features) judge(feature, T_odom_map);
    const geometry::Pose2 T_sensor_map =
        estimates.located.T_base_sensor->inverse() * T_map_base.inverse();
    for (Place& place : places_) {
      follow(place, estimates, T_odom_map, T_sensor_map * place.map);
    }
  }
  /// Takes in what another run found.
  void add(const FeatureScore& other) {
    nees_ += other.nees_;
    judged_ += other.judged_;
    inside_ += other.inside_;
    changes_ += other.changes_;
    scans_in_view_ += other.scans_in_view_;
    fixed_ += other.fixed_;
    fixed_claimed_ += other.fixed_claimed_;
    claimed_ += other.claimed_;
    claimed_rightly_ += other.claimed_rightly_;
  }

  double nees() const { return nees_ / judged_; }
  double inGate() const { return 100.0 * inside_ / judged_; }
  /// A minute that a feature stays in view.
  double idChanges(double scan_rate) const {
    return changes_ / (scans_in_view_ / scan_rate / 60.0);
  }
  double recall() const { return 100.0 * fixed_claimed_ / fixed_; }
  double precision() const { return 100.0 * claimed_rightly_ / claimed_; }

 private:
  struct Place {
    Eigen::Vector2d map;
    bool is_round = false;
    std::uint32_t id = 0;  // of the feature there, while it stays in view
  };

  void addPlace(const Eigen::Vector2d& map) {
    for (const Place& place : places_) {
      if ((place.map - map).norm() < 1e-3) return;
    }
    places_.push_back({map});
  }
  // The place that a feature is of, by where it is believed to be.
  const Place* placeOf(const geometry::Feature& feature, const geometry::Pose2& T_odom_map) const {
    const Place* nearest = nullptr;
    double least = 0.15 + 2.0 * std::sqrt(feature.covariance.trace());
    for (const Place& place : places_) {
      if (place.is_round != (feature.kind == geometry::FeatureKind::kArc)) continue;
      const double distance = (T_odom_map * place.map - feature.position).norm();
      if (distance >= least) continue;
      least = distance;
      nearest = &place;
    }
    return nearest;
  }
  void judge(const geometry::Feature& feature, const geometry::Pose2& T_odom_map) {
    const Place* const place = placeOf(feature, T_odom_map);
    const bool is_claimed = feature.behaviour == geometry::FeatureBehaviour::kFixed;
    if (is_claimed && place) {
      const Eigen::Vector2d error = feature.position - T_odom_map * place->map;
      const double nees = error.dot(feature.covariance.inverse() * error);
      nees_ += nees;
      inside_ += nees < 5.991 ? 1.0 : 0.0;
      judged_ += 1.0;
    }
    // The behaviour is known when it has been watched for a second.
    if (feature.age < 1.0 || feature.unseen > 0.0) return;
    if (is_claimed) ++claimed_;
    if (is_claimed && place) ++claimed_rightly_;
    if (place && feature.kind != geometry::FeatureKind::kLineEnd) ++fixed_;
    if (place && feature.kind != geometry::FeatureKind::kLineEnd && is_claimed) ++fixed_claimed_;
  }
  void follow(Place& place, const pipeline::Estimates& estimates, const geometry::Pose2& T_odom_map,
              const Eigen::Vector2d& p_sensor) {
    if (lines::lookAt(p_sensor, 0.05, estimates.located.scan) != lines::PlaceInView::kSeen) {
      place.id = 0;
      return;
    }
    scans_in_view_ += 1.0;
    for (const auto& feature : *estimates.features) {
      if (feature.unseen > 0.0 || placeOf(feature, T_odom_map) != &place) continue;
      if (feature.kind == geometry::FeatureKind::kLineEnd) continue;
      if (place.id != 0 && place.id != feature.id) changes_ += 1.0;
      place.id = feature.id;
      return;
    }
  }

  std::vector<Place> places_;
  double nees_ = 0.0, judged_ = 0.0, inside_ = 0.0, changes_ = 0.0, scans_in_view_ = 0.0;
  double fixed_ = 0.0, fixed_claimed_ = 0.0, claimed_ = 0.0, claimed_rightly_ = 0.0;
};

}  // namespace sightline::bench
