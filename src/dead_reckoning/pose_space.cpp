#include "sightline/dead_reckoning/pose_space.h"

#include <algorithm>
#include <cmath>

#include "sightline/dead_reckoning/motion_gradient.h"

namespace sightline::dead_reckoning {

namespace {

using geometry::Pose2;

struct PoseSpaceTuning {
  // Positions are first so many steps apart, then half of that, down to one.
  int coarsest = 4;
  // A pose that matches less than this share of the points explains nothing; below the second share
  // the least squares may make it worse. Chosen by hand.
  double fewest_counted = 0.3;
  double corrected_share = 0.5;
  // Error of a point over the distance at which two points match: those of the reference are not
  // where those of the scan are, and neighbours share that.
  double sigma_per_threshold = 3.3;
  // Half side of the largest square that is searched [m], and poses that one level tries at most.
  // Where the window holds more, the first steps are twice as far apart, again and again; but not
  // so few points are counted.
  double widest_search = 12.0;
  double most_poses = 5e5;
  std::size_t fewest_points = 20;
};
constexpr PoseSpaceTuning kPoseSpace{};

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

  // Steps to either side.
  int headings() const { return static_cast<int>(std::ceil(heading / heading_step)); }
  int positions() const { return static_cast<int>(std::ceil(position / step)); }
  double poses() const {
    const double side = 2.0 * positions() + 1.0;
    return side * side * (2.0 * headings() + 1.0);
  }
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
  const int headings = grid.headings();
  const int positions = grid.positions();
  Correlation best{grid.centre, 0, static_cast<std::size_t>(grid.poses())};
  for (int k = -headings; k <= headings; ++k) {
    const double heading = grid.centre.theta() + k * grid.heading_step;
    const auto turned = turnAll(points, heading, grid.stride);
    for (int y = -positions; y <= positions; ++y) {
      for (int x = -positions; x <= positions; ++x) {
        const Eigen::Vector2d place = grid.centre.translation() + grid.step * Eigen::Vector2d(x, y);
        const std::size_t count = countMatches(turned, place, reference, grid.threshold);
        if (count > best.count) best = {Pose2(place, heading), count, best.evaluations};
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

namespace {

// Steps of the first level, in the finest.
int coarsestOf(PoseGrid grid, const PoseSpaceConfig& config) {
  int factor = kPoseSpace.coarsest;
  for (;; factor *= 2) {
    grid.step = factor * config.step;
    if (grid.positions() <= 1 || grid.poses() <= kPoseSpace.most_poses) return factor;
  }
}

}  // namespace

Correlation correlatePoses(const std::vector<SurfacePoint>& points, const SortedPoints& reference,
                           const SearchWindow& window, const PoseSpaceConfig& config) {
  const double position = std::min(window.position, kPoseSpace.widest_search);
  PoseGrid grid{window.centre, position, window.heading, 0.0, config.angle_step, 0.0, 1};
  const auto widest_stride = std::max(static_cast<std::size_t>(kPoseSpace.coarsest),
                                      points.size() / kPoseSpace.fewest_points);
  Correlation best;
  std::size_t evaluations = 0;
  for (int factor = coarsestOf(grid, config); factor >= 1; factor /= 2) {
    grid.step = factor * config.step;
    grid.threshold = std::max(config.threshold, 0.5 * grid.step);
    grid.stride = std::min(static_cast<std::size_t>(factor), widest_stride);
    best = searchGrid(points, reference, grid);
    evaluations += best.evaluations;
    grid.centre = best.T_reference_base;
    grid.position = 0.5 * grid.step;
    grid.heading = std::min(window.heading, 2.0 * config.angle_step);
  }
  best.evaluations = evaluations;
  return best;
}

MatchOutcome PoseSpaceMatcher::match(const SurfaceScan& surfaces,
                                     const geometry::UncertainPose2& prior,
                                     const SearchWindow& window) const {
  MatchOutcome outcome;
  outcome.T_odom_base = prior.mean;
  if (surfaces.points.empty()) return outcome;
  SearchWindow around = window;
  around.centre = geometry::between(*T_odom_reference_, window.centre);
  const Correlation best = correlatePoses(surfaces.points, reference_, around, config_);
  outcome.evaluations = best.evaluations;
  outcome.inliers = static_cast<double>(best.count) / static_cast<double>(surfaces.points.size());
  outcome.cost = 1.0 - outcome.inliers;
  if (outcome.inliers < kPoseSpace.fewest_counted) return outcome;
  Pose2 T_reference_base = best.T_reference_base;
  if (outcome.inliers > kPoseSpace.corrected_share) {
    const auto corrected = fitting::alignPoints(pairsAt(surfaces, T_reference_base));
    if (corrected) T_reference_base = *corrected;
  }
  outcome.reference.is_held = outcome.inliers >= config_.hold_share;
  outcome.state = MatchState::kMatched;
  outcome.T_odom_base = *T_odom_reference_ * T_reference_base;
  const double sigma = kPoseSpace.sigma_per_threshold * config_.threshold;
  outcome.information = surfaceInformation(surfaces, outcome.T_odom_base, sigma);
  outcome.motion_gradient = surfaceMotionGradient(surfaces, outcome.T_odom_base, sigma);
  return outcome;
}

std::vector<fitting::PointPair> PoseSpaceMatcher::pairsAt(const SurfaceScan& surfaces,
                                                          const Pose2& T_reference_base) const {
  std::vector<fitting::PointPair> pairs;
  for (const SurfacePoint& point : surfaces.points) {
    const Eigen::Vector2d* nearest =
        reference_.nearest(T_reference_base * point.position, config_.threshold);
    if (nearest != nullptr) pairs.push_back({*nearest, point.position});
  }
  return pairs;
}

double PoseSpaceMatcher::learn(const SurfaceScan& surfaces, const Pose2& T_odom_base,
                               const MatchOutcome& outcome) {
  const bool is_kept = T_odom_reference_ && outcome.reference.is_held;
  if (is_kept || surfaces.points.empty()) return 0.0;
  T_odom_reference_ = T_odom_base;
  reference_ = SortedPoints(surfaces.points);
  return 1.0;
}

}  // namespace sightline::dead_reckoning
