#include "sightline/dead_reckoning/pose_space.h"

#include <algorithm>
#include <cmath>

namespace sightline::dead_reckoning {

namespace {

using geometry::Pose2;

// Positions are first so many steps apart, then half of that, down to one.
constexpr int kCoarsest = 4;
// A pose that matches less than this share of the points explains nothing.
constexpr double kFewestCounted = 0.3;
// Below this share of matching points the least squares may make it worse.
constexpr double kCorrectedShare = 0.5;

bool isLeft(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() < b.x();
}

// The grid of one level about a centre.
struct PoseGrid {
  Pose2 centre;
  double position;      // half side [m]
  double heading;       // half width [rad]
  double step;          // [m]
  double heading_step;  // [rad]
  double threshold;     // [m]
  std::size_t stride;   // only every so many points are counted
};

std::size_t countMatches(const std::vector<Eigen::Vector2d>& turned, const Eigen::Vector2d& shift,
                         const SortedPoints& reference, double threshold) {
  return static_cast<std::size_t>(std::count_if(
      turned.begin(), turned.end(),
      [&](const Eigen::Vector2d& point) { return reference.hasNear(point + shift, threshold); }));
}

std::vector<Eigen::Vector2d> turnAll(const std::vector<SurfacePoint>& points, double heading,
                                     std::size_t stride) {
  const Eigen::Matrix2d rotation = Pose2(0.0, 0.0, heading).rotation();
  std::vector<Eigen::Vector2d> turned;
  for (std::size_t i = 0; i < points.size(); i += stride) {
    turned.push_back(rotation * points[i].position);
  }
  return turned;
}

Correlation searchGrid(const std::vector<SurfacePoint>& points, const SortedPoints& reference,
                       const PoseGrid& grid) {
  const int headings = static_cast<int>(std::ceil(grid.heading / grid.heading_step));
  const int positions = static_cast<int>(std::ceil(grid.position / grid.step));
  Correlation best{grid.centre, 0};
  for (int k = -headings; k <= headings; ++k) {
    const double heading = grid.centre.theta() + k * grid.heading_step;
    const auto turned = turnAll(points, heading, grid.stride);
    for (int y = -positions; y <= positions; ++y) {
      for (int x = -positions; x <= positions; ++x) {
        const Eigen::Vector2d place = grid.centre.translation() + grid.step * Eigen::Vector2d(x, y);
        const std::size_t count = countMatches(turned, place, reference, grid.threshold);
        if (count > best.count) best = {Pose2(place, heading), count};
      }
    }
  }
  return best;
}

}  // namespace

SortedPoints::SortedPoints(const std::vector<SurfacePoint>& points) {
  for (const SurfacePoint& point : points) points_.push_back(point.position);
  std::sort(points_.begin(), points_.end(), isLeft);
}

const Eigen::Vector2d* SortedPoints::nearest(const Eigen::Vector2d& point, double reach) const {
  const Eigen::Vector2d left(point.x() - reach, 0.0);
  const Eigen::Vector2d* best = nullptr;
  double best_square = reach * reach;
  for (auto i = std::lower_bound(points_.begin(), points_.end(), left, isLeft);
       i != points_.end() && i->x() <= point.x() + reach; ++i) {
    const double square = (*i - point).squaredNorm();
    if (square > best_square) continue;
    best_square = square;
    best = &*i;
  }
  return best;
}

bool SortedPoints::hasNear(const Eigen::Vector2d& point, double reach) const {
  const Eigen::Vector2d left(point.x() - reach, 0.0);
  for (auto i = std::lower_bound(points_.begin(), points_.end(), left, isLeft);
       i != points_.end() && i->x() <= point.x() + reach; ++i) {
    if ((*i - point).squaredNorm() <= reach * reach) return true;
  }
  return false;
}

Correlation correlatePoses(const std::vector<SurfacePoint>& points, const SortedPoints& reference,
                           const SearchWindow& window, const PoseSpaceConfig& config) {
  PoseGrid grid{window.centre, window.position, window.heading, 0.0, config.angle_step, 0.0, 1};
  Correlation best;
  for (int factor = kCoarsest; factor >= 1; factor /= 2) {
    grid.step = factor * config.step;
    grid.threshold = std::max(config.threshold, 0.5 * grid.step);
    grid.stride = static_cast<std::size_t>(factor);
    best = searchGrid(points, reference, grid);
    grid.centre = best.T_reference_base;
    grid.position = 0.5 * grid.step;
    grid.heading = std::min(window.heading, 2.0 * config.angle_step);
  }
  return best;
}

Eigen::Matrix3d surfaceInformation(const Sweep& sweep, const Pose2& T_odom_base, double sigma) {
  const Eigen::Matrix2d rotation = T_odom_base.rotation();
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  for (const SurfacePoint& point : sweep.points) {
    if (!point.hasNormal()) continue;
    const Eigen::Vector2d arm = rotation * point.position;
    const Eigen::Vector2d normal = rotation * point.normal;
    const Eigen::Vector3d jacobian(normal.x(), normal.y(),
                                   normal.y() * arm.x() - normal.x() * arm.y());
    information += jacobian * jacobian.transpose() / (sigma * sigma);
  }
  return information;
}

MatchOutcome PoseSpaceMatcher::match(const Sweep& sweep, const geometry::UncertainPose2& prior,
                                     const SearchWindow& window) {
  hold_ = false;
  MatchOutcome outcome;
  outcome.searched = true;
  outcome.T_odom_base = prior.mean;
  if (sweep.points.empty()) return outcome;
  SearchWindow around = window;
  around.centre = geometry::between(*T_odom_reference_, window.centre);
  const Correlation best = correlatePoses(sweep.points, reference_, around, config_);
  outcome.inliers = static_cast<double>(best.count) / static_cast<double>(sweep.points.size());
  if (outcome.inliers < kFewestCounted) return outcome;
  Pose2 T_reference_base = best.T_reference_base;
  if (outcome.inliers > kCorrectedShare) {
    const auto corrected = fitting::alignPoints(pairsAt(sweep, T_reference_base));
    if (corrected) T_reference_base = *corrected;
  }
  hold_ = outcome.inliers >= config_.hold_share;
  outcome.state = MatchState::kMatched;
  outcome.T_odom_base = *T_odom_reference_ * T_reference_base;
  // Points of the reference are not where those of the scan are: that is what the error is made of,
  // and neighbours share it.
  outcome.information = surfaceInformation(sweep, outcome.T_odom_base, 5.0 * config_.threshold);
  return outcome;
}

std::vector<fitting::PointPair> PoseSpaceMatcher::pairsAt(const Sweep& sweep,
                                                          const Pose2& T_reference_base) const {
  std::vector<fitting::PointPair> pairs;
  for (const SurfacePoint& point : sweep.points) {
    const Eigen::Vector2d* nearest =
        reference_.nearest(T_reference_base * point.position, config_.threshold);
    if (nearest != nullptr) pairs.push_back({*nearest, point.position});
  }
  return pairs;
}

double PoseSpaceMatcher::learn(const Sweep& sweep, const Pose2& T_odom_base, MatchState) {
  if ((T_odom_reference_ && hold_) || sweep.points.empty()) return 0.0;
  T_odom_reference_ = T_odom_base;
  reference_ = SortedPoints(sweep.points);
  return 1.0;
}

}  // namespace sightline::dead_reckoning
