#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "sightline/gaze/gaze_config.h"
#include "sightline/geometry/feature.h"
#include "sightline/geometry/pose2.h"

namespace sightline::gaze {

/// Keeps one feature in view: knows where it is from the features of the last scan, and from its
/// own memory where they do not hold it any more.
class Fixation {
 public:
  /// `config` has to live as long.
  Fixation(const geometry::Feature& feature, std::int64_t stamp, const GazeConfig& config);

  /// Takes the features of a scan. A feature that was given up and found again has another id: the
  /// nearest one of the kind within the uncertainty of the prediction is taken for it.
  void see(const std::vector<geometry::Feature>& features, std::int64_t stamp);

  /// Head angle at a time [ns], of a head whose mount is, or will be, at `T_odom_mount`. Where the
  /// feature is lost, the head searches around the prediction, as wide as that is uncertain.
  double aim(const geometry::Pose2& T_odom_mount, std::int64_t now) const;

  std::uint32_t id() const { return id_; }
  const Eigen::Vector2d& position() const { return position_; }  ///< in odom [m]
  double unseen(std::int64_t now) const;                         ///< [s]
  bool isLost(std::int64_t now) const { return unseen(now) > config_->lost_after; }

 private:
  const geometry::Feature* successor(const std::vector<geometry::Feature>& features) const;
  void adopt(const geometry::Feature& feature, std::int64_t stamp);
  double searchWidth(const Eigen::Vector2d& place_mount) const;

  const GazeConfig* config_;
  std::uint32_t id_ = 0;
  geometry::FeatureKind kind_ = geometry::FeatureKind::kCorner;
  Eigen::Vector2d position_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d velocity_ = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance_ = Eigen::Matrix2d::Identity();
  std::int64_t stamp_ = 0;  // of what is known of it
  std::int64_t seen_ = 0;   // when it was last seen
};

/// Choice of a feature among those that can be fixated: not sliding ones, and within the reach of
/// sensor and head.
class FeatureChoice {
 public:
  FeatureChoice(const std::vector<geometry::Feature>& features, const geometry::Pose2& T_odom_mount,
                const GazeConfig& config)
      : features_(features), T_odom_mount_(T_odom_mount), config_(config) {}

  const geometry::Feature* byId(std::uint32_t id) const;
  const geometry::Feature* at(const Eigen::Vector2d& place_odom) const;
  const geometry::Feature* nearestCorner() const;
  /// The one that would take the most from the uncertainty of the pose, whose covariance in odom
  /// is given (x, y, θ).
  const geometry::Feature* mostInformative(const Eigen::Matrix3d& covariance) const;

 private:
  bool isInReach(const geometry::Feature& feature) const;
  double drop(const geometry::Feature& feature, const Eigen::Matrix3d& covariance) const;

  const std::vector<geometry::Feature>& features_;
  geometry::Pose2 T_odom_mount_;
  const GazeConfig& config_;
};

}  // namespace sightline::gaze
