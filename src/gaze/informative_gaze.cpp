#include "sightline/gaze/informative_gaze.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <Eigen/LU>

#include "sightline/motion/odometry_noise.h"

namespace sightline::gaze {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using geometry::Pose2;

constexpr struct {
  double ray = 0.035;      // between two rays [rad]
  double angle = 0.0785;   // between two head angles [rad]
  double obliquity = 0.1;  // of a wall that is hardly met [cosine]
} kLooks;

// Sums over the rays that meet one wall, the errors of its place in the map among the unknowns.
struct WallSums {
  Matrix3d pose = Matrix3d::Zero();
  Eigen::Matrix<double, 3, 2> cross = Eigen::Matrix<double, 3, 2>::Zero();
  Eigen::Matrix2d wall = Eigen::Matrix2d::Zero();
  double from = 1e9, to = -1e9;  // along the wall [m]
};

// Information of a wall once its own errors are left open to their extent in the map.
Matrix3d withoutWall(const WallSums& sums, const InformConfig& config) {
  const Vector2d known(1.0 / (config.wall_position_sigma * config.wall_position_sigma),
                       1.0 / (config.wall_direction_sigma * config.wall_direction_sigma));
  const Eigen::Matrix2d wall = sums.wall + Eigen::Matrix2d(known.asDiagonal());
  return sums.pose - sums.cross * wall.inverse() * sums.cross.transpose();
}

// As it will be so much later, by constant velocity.
geometry::UncertainPose2 after(const LookingPlace& place, double time,
                               const motion::OdometryNoise& noise) {
  const Pose2 step = Pose2::exp(time * place.twist);
  Matrix3d covariance = motion::stepCovariance(noise, step);
  const Vector2d by_scale = noise.scale_sigma * step.translation();
  covariance.topLeftCorner<2, 2>() += by_scale * by_scale.transpose();
  return geometry::compose(place.T_map_base, {step, covariance});
}

}  // namespace

double InformativeGaze::travelTime(double from, double to) const {
  const double way = std::abs(to - from);
  const double rate = config_->head.max_rate;
  const double acceleration = config_->head.acceleration;
  const double ramp = rate * rate / acceleration;  // way to full rate and back to rest
  if (way < ramp) return 2.0 * std::sqrt(way / acceleration);
  return way / rate + rate / acceleration;
}

std::vector<InformativeGaze::Ray> InformativeGaze::cast(const LookingPlace& place,
                                                        const world::RoomMap& map,
                                                        const WallVisibility& visibility) const {
  const SensorField& field = config_->field;
  const Pose2& T_map_base = place.T_map_base.mean;
  const Pose2 T_map_mount = T_map_base * place.T_base_mount;
  const Vector2d eye = T_map_mount.translation();
  const world::RoomView view(map, place.room, eye, world::RoomView::Doors::kOpen);
  const double beams_a_ray = kLooks.ray * field.beams / (2.0 * field.half_width);
  const double lower = config_->head.lower + field.centre - field.half_width;
  const double upper = config_->head.upper + field.centre + field.half_width;
  std::vector<Ray> rays;
  for (double bearing = lower; bearing < upper; bearing += kLooks.ray) {
    const double heading = T_map_mount.theta() + bearing;
    const Vector2d direction(std::cos(heading), std::sin(heading));
    const auto sighting = view.look(direction);
    if (!sighting || !sighting->is_solid || sighting->cos_incidence < kLooks.obliquity) continue;
    if (sighting->range < field.range_min || sighting->range > field.range_max) continue;
    const Vector2d normal = map.wall(sighting->wall).segment.leftNormal();
    const Vector2d arm = eye + sighting->range * direction - T_map_base.translation();
    const double sigma = field.sigmaAt(sighting->range) * sighting->cos_incidence;
    rays.push_back({sighting->wall,
                    bearing,
                    sighting->along,
                    {normal.x(), normal.y(), normal.y() * arm.x() - normal.x() * arm.y()},
                    visibility.at(*sighting) * beams_a_ray / (sigma * sigma)});
  }
  return rays;
}

Matrix3d InformativeGaze::informationOf(const std::vector<Ray>& rays, double head_angle) const {
  const double middle = head_angle + config_->field.centre;
  std::map<std::pair<std::size_t, std::size_t>, WallSums> walls;
  for (const Ray& ray : rays) {
    if (std::abs(ray.bearing - middle) > config_->field.half_width) continue;
    WallSums& sums = walls[{ray.wall.room, ray.wall.wall}];
    const Vector2d error(1.0, ray.along);
    sums.pose += ray.weight * ray.response * ray.response.transpose();
    sums.cross += ray.weight * ray.response * error.transpose();
    sums.wall += ray.weight * error * error.transpose();
    sums.from = std::min(sums.from, ray.along);
    sums.to = std::max(sums.to, ray.along);
  }
  Matrix3d information = Matrix3d::Zero();
  for (const auto& [index, sums] : walls) {
    if (sums.to - sums.from < config_->inform.least_length) continue;
    information += withoutWall(sums, config_->inform);
  }
  return information;
}

Matrix3d InformativeGaze::information(const LookingPlace& place, double head_angle,
                                      const world::RoomMap& map,
                                      const WallVisibility& visibility) const {
  return informationOf(cast(place, map, visibility), head_angle);
}

// Drop of the variances of x and y, a second of going there and looking.
double InformativeGaze::rate(const LookingPlace& place, const Matrix3d& information,
                             double travel) const {
  const Matrix3d before = after(place, travel, config_->odometry).covariance;
  const Matrix3d gained = (before.inverse() + information).inverse();
  return (before.topLeftCorner<2, 2>().trace() - gained.topLeftCorner<2, 2>().trace()) /
         (travel + config_->inform.dwell);
}

Look InformativeGaze::choose(const LookingPlace& place, const world::RoomMap& map,
                             const WallVisibility& visibility) const {
  LookingPlace ahead = place;
  ahead.T_map_base = after(place, config_->inform.dwell, config_->odometry);
  const std::vector<Ray> rays = cast(ahead, map, visibility);
  Look best{place.head_angle, 0.0, !rays.empty()};
  if (rays.empty()) return best;
  for (double angle = config_->head.lower; angle <= config_->head.upper; angle += kLooks.angle) {
    const Matrix3d information = informationOf(rays, angle);
    const double drop = rate(place, information, travelTime(place.head_angle, angle));
    if (drop > best.drop) best = {angle, drop, true};
  }
  return best;
}

}  // namespace sightline::gaze
