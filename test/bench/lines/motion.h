#pragma once

#include <string>

#include "bench/figures.h"
#include "lines/motion_consistency.h"

namespace sightline::bench {

/// Lines of a wall while the motion of the sensor within the sweep is known with errors: whether
/// their covariances tell the truth, and what they would be worth were the errors ignored.
inline void motionConsistency(const std::string& errors, const test::NoisySweep& noisy) {
  for (const test::WallPlace& wall : test::kWallPlaces) {
    const test::NoisySweep sweep = test::inFrontOf(wall, noisy);
    const test::MotionConsistency consistency = test::ConsistencyRun(sweep).of(5, 400);
    const std::string name = "lines.motion." + errors + "_" + wall.name + ".";
    print(name + "found", 100.0 * consistency.found, "%");
    print(name + "nees", consistency.nees, "of_2");
    print(name + "inside", 100.0 * consistency.inside, "%");
    print(name + "nees_ignored", consistency.nees_ignored, "of_2");
  }
}

inline void motionConsistency() {
  motionConsistency("jitter", test::jitteringHead());
  motionConsistency("drift", test::wrongOdometry(true, false));
  motionConsistency("walk", test::wrongOdometry(false, true));
  motionConsistency("drift_and_walk", test::wrongOdometry(true, true));
}

}  // namespace sightline::bench
