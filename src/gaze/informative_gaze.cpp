#include "sightline/gaze/informative_gaze.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sightline/geometry/angle.h"

namespace sightline::gaze {

namespace {

using Eigen::Vector2d;
using geometry::Pose2;

constexpr struct {
  double ray = 0.035;      // between two rays [rad]
  double angle = 0.0785;   // between two head angles [rad]
  double obliquity = 0.2;  // of a wall that is hardly met [cosine]
  double step = 0.2;       // of the time ahead [s]
} kLooks;

}  // namespace

double InformativeGaze::travelTime(double from, double to) const {
  const double way = std::abs(to - from);
  const double rate = config_->head.max_rate;
  const double acceleration = config_->head.acceleration;
  const double ramp = rate * rate / acceleration;  // way to full rate and back to rest
  if (way < ramp) return 2.0 * std::sqrt(way / acceleration);
  return way / rate + rate / acceleration;
}

double InformativeGaze::angleAfter(double from, double to, double time) const {
  const double travel = travelTime(from, to);
  return time >= travel ? to : from + (to - from) * time / travel;
}

// All round, as the carrier may turn.
std::vector<InformativeGaze::Ray> InformativeGaze::cast(const LookingPlace& place,
                                                        const Pose2& T_map_base,
                                                        const world::RoomMap& map,
                                                        const WallVisibility& visibility) const {
  const SensorField& field = config_->field;
  const Vector2d eye = (T_map_base * place.T_base_mount).translation();
  const world::RoomView view(map, place.room, eye, world::RoomView::Doors::kOpen);
  const double beams_a_ray = kLooks.ray * field.beams / (2.0 * field.half_width);
  std::vector<Ray> rays;
  for (double heading = -geometry::kPi; heading < geometry::kPi; heading += kLooks.ray) {
    const auto sighting = view.look({std::cos(heading), std::sin(heading)});
    if (!sighting || !sighting->is_solid || sighting->cos_incidence < kLooks.obliquity) continue;
    if (sighting->range < field.range_min || sighting->range > field.range_max) continue;
    const double sigma = field.sigmaAt(sighting->range);
    rays.push_back({heading, *sighting, visibility.at(*sighting) * beams_a_ray / (sigma * sigma)});
  }
  return rays;
}

void InformativeGaze::look(const std::vector<Ray>& rays, double heading, WallLooks& looks) const {
  looks.clear();
  for (const Ray& ray : rays) {
    const double off = geometry::wrapAngle(ray.heading - heading);
    if (std::abs(off) < config_->field.half_width) looks.add(ray.sighting, ray.weight);
  }
}

std::vector<WallLook> InformativeGaze::looksAt(const LookingPlace& place, double head_angle,
                                               const world::RoomMap& map,
                                               const WallVisibility& visibility) const {
  WallLooks looks(map);
  look(cast(place, place.T_map_base, map, visibility),
       (place.T_map_base * place.T_base_mount).theta() + head_angle + config_->field.centre, looks);
  return looks.all();
}

double InformativeGaze::expectedVariance(const LookingPlace& place, const std::vector<Ray>& rays,
                                         double angle, WallLooks& looks) const {
  PoseUncertainty uncertainty = place.uncertainty;
  Pose2 T_map_base = place.T_map_base;
  const Pose2 step = Pose2::exp(kLooks.step * place.twist);
  double sum = 0.0;
  const int steps = static_cast<int>(std::ceil(config_->inform.horizon / kLooks.step));
  for (int i = 0; i < steps; ++i) {
    uncertainty.predict(T_map_base, step, config_->odometry);
    T_map_base = T_map_base * step;
    const double head = angleAfter(place.head_angle, angle, kLooks.step * (i + 0.5));
    look(rays, (T_map_base * place.T_base_mount).theta() + head + config_->field.centre, looks);
    for (const WallLook& wall : looks.all()) {
      if (wall.to - wall.from < config_->inform.least_length) continue;
      uncertainty.take(wall, T_map_base.translation(), kLooks.step / place.scan_period);
    }
    sum += uncertainty.covariance().topLeftCorner<2, 2>().trace();
  }
  return sum / steps;
}

Look InformativeGaze::choose(const LookingPlace& place, const world::RoomMap& map,
                             const WallVisibility& visibility) const {
  const Pose2 halfway = place.T_map_base * Pose2::exp(0.5 * config_->inform.horizon * place.twist);
  const std::vector<Ray> rays = cast(place, halfway, map, visibility);
  Look best{place.head_angle, std::numeric_limits<double>::infinity(), !rays.empty()};
  if (rays.empty()) return best;
  WallLooks looks(map);
  const auto consider = [&](double angle) {
    const double variance = expectedVariance(place, rays, angle, looks);
    if (variance < best.variance) best = {angle, variance, true};
  };
  consider(place.head_angle);  // first, so that the head stays where nothing is better
  for (double angle = config_->head.lower; angle <= config_->head.upper; angle += kLooks.angle) {
    consider(angle);
  }
  return best;
}

}  // namespace sightline::gaze
