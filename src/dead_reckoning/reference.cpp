#include "sightline/dead_reckoning/reference.h"

#include <cmath>

namespace sightline::dead_reckoning {

namespace {

bool isNear(const geometry::Pose2& keyframe, const geometry::Pose2& T_odom_base,
            const SubmapConfig& config) {
  const geometry::Pose2 step = geometry::between(keyframe, T_odom_base);
  return step.translation().norm() < config.spacing && std::abs(step.theta()) < config.turn_spacing;
}

}  // namespace

double Reference::add(const SurfaceScan& surfaces, const geometry::Pose2& T_odom_base,
                      const SubmapConfig& config) {
  const auto newest = newest_.find(surfaces.scanner);
  if (newest != newest_.end() && isNear(newest->second, T_odom_base, config)) return 0.0;
  newest_[surfaces.scanner] = T_odom_base;
  const std::size_t most = newest_.size() * static_cast<std::size_t>(config.keyframes);
  return submap_.add(T_odom_base, surfaces, most) / static_cast<double>(newest_.size());
}

const SearchRasters& Reference::rastersAbout(const Eigen::Vector2d& centre_odom) const {
  if (!rasters_ || !rasters_->show(submap_, centre_odom)) {
    rasters_.reset();  // hands its memory on
    rasters_ = std::make_unique<SearchRasters>(submap_, centre_odom);
  }
  return *rasters_;
}

}  // namespace sightline::dead_reckoning
