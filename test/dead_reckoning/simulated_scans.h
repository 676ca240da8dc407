#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <random>
#include <string>

#include "sightline/config/node.h"
#include "sightline/geometry/pose2.h"
#include "sightline/scan/noise_model.h"
#include "sightline/scan/scan.h"
#include "sightline/world/world.h"

/// Scans of small worlds, taken all at once.
namespace sightline::test {

/// A room of 8 x 5 m with two boxes and a pillar: no two places in it look alike.
inline world::World furnishedRoom() {
  return world::World(config::Node::parse(R"(
segments:
  - {from: [-4.0, -2.5], to: [4.0, -2.5]}
  - {from: [4.0, -2.5], to: [4.0, 2.5]}
  - {from: [4.0, 2.5], to: [-4.0, 2.5]}
  - {from: [-4.0, 2.5], to: [-4.0, -2.5]}
boxes:
  - {centre: [2.8, 1.9], size: [1.6, 0.8], yaw: 0.0}
  - {centre: [-3.2, -1.0], size: [0.7, 1.4], yaw: 0.3}
discs:
  - {centre: [1.5, -1.6], radius: 0.2}
)",
                                          "furnished room"));
}

/// Two walls 2 m apart, whose ends are out of reach.
inline world::World plainCorridor() {
  return world::World(config::Node::parse(R"(
segments:
  - {from: [-100.0, -1.0], to: [100.0, -1.0]}
  - {from: [100.0, 1.0], to: [-100.0, 1.0]}
)",
                                          "plain corridor"));
}

/// A square of 4 m: it looks the same after a quarter turn.
inline world::World squareRoom() {
  return world::World(config::Node::parse(R"(
segments:
  - {from: [-2.0, -2.0], to: [2.0, -2.0]}
  - {from: [2.0, -2.0], to: [2.0, 2.0]}
  - {from: [2.0, 2.0], to: [-2.0, 2.0]}
  - {from: [-2.0, 2.0], to: [-2.0, -2.0]}
)",
                                          "square room"));
}

constexpr double kSigma = 0.01;  // of a range [m]

/// A sensor that turns through `field` [rad], symmetric about straight ahead.
inline std::shared_ptr<const scan::ScanGeometry> scanner(std::size_t beams = 361,
                                                         double field = geometry::kPi,
                                                         double range_max = 20.0) {
  return scan::ScanGeometry::uniform(-0.5 * field, field / static_cast<double>(beams - 1), beams,
                                     0.0, 0.05, range_max);
}

class Viewer {
 public:
  Viewer(world::World world, std::shared_ptr<const scan::ScanGeometry> geometry, std::uint64_t seed)
      : world_(std::move(world)), geometry_(std::move(geometry)), random_(seed) {}

  /// The sweep whose first beam leaves at `stamp` [s] from a sensor that moves with a constant
  /// body velocity while it lasts.
  scan::Scan look(const geometry::Pose2& T_map_sensor, double stamp,
                  const Eigen::Vector3d& twist = Eigen::Vector3d::Zero()) {
    std::vector<double> ranges;
    for (std::size_t i = 0; i < geometry_->beams(); ++i) {
      const geometry::Pose2 moved =
          T_map_sensor * geometry::Pose2::exp(geometry_->timeOffsets()[i] * twist);
      ranges.push_back(range(moved, geometry_->angles()[i]));
    }
    scan::Scan scan(geometry_, std::llround(1e9 * stamp), std::move(ranges));
    scan::NoiseModel noise;
    noise.sigma = kSigma;
    scan::applyNoise(noise, scan);
    return scan;
  }

 private:
  double range(const geometry::Pose2& sensor, double angle) {
    const double direction = sensor.theta() + angle;
    const auto hit = world_.cast(
        {{sensor.x(), sensor.y(), 1.0}, {std::cos(direction), std::sin(direction), 0.0}});
    if (!hit) return std::numeric_limits<double>::infinity();
    return hit->range + kSigma * normal_(random_);
  }

  world::World world_;
  std::shared_ptr<const scan::ScanGeometry> geometry_;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
};

}  // namespace sightline::test
