#pragma once

namespace sightline::scan {

/// Time from one scan to the next where the stamps do not tell it.
struct ElapsedTime {
  double usual = 0.0;    ///< most probable [s], positive
  double longest = 0.0;  ///< that may have passed, at least `usual` [s]
  double sigma = 0.0;    ///< standard deviation of `usual` [s]
};

}  // namespace sightline::scan
