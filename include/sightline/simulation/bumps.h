#pragma once

#include <cstdint>

#include "sightline/config/fields.h"
#include "sightline/simulation/random_stream.h"

namespace sightline::simulation {

/// Bumps of a floor, such as the edges of carpets: while a wheel stands on one, the robot is tilted
/// forwards or backwards, and a planar scanner looks past what is low (dames section 3.4).
struct BumpConfig {
  double share = 0.0;       ///< of the way that is bumps, [0, 1); 0: an even floor
  double length = 0.3;      ///< mean of one [m]
  double height = 0.0025;   ///< [m]
  double wheel_base = 0.2;  ///< from the wheel that is lifted to the point that it turns about [m]

  void visit(config::FieldVisitor& visitor);
};

/// The bumps under a robot as it drives. Long and short ones come as exponential lengths do, so
/// that a robot that stands still stays tilted or level.
class Bumps {
 public:
  Bumps(const BumpConfig& config, std::uint64_t seed);

  /// Drives on by `distance` [m].
  void advance(double distance);
  /// Tilt of the robot [rad], positive where it looks down.
  double pitch() const { return pitch_; }

 private:
  double drawLength(double mean);
  void enter(bool is_bump);

  BumpConfig config_;
  RandomStream random_;
  bool is_bump_ = false;
  double left_ = 0.0;  // of the bump or the even piece [m]
  double pitch_ = 0.0;
};

}  // namespace sightline::simulation
