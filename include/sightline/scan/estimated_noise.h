#pragma once

#include <vector>

#include "sightline/scan/scan.h"

namespace sightline::scan {

/// Variance along the beam [m²] at a range [m].
struct NoiseAtRange {
  double range;
  double variance;
};

/// Estimates the noise of a scan from the scan itself, nearest range first: the distance of returns
/// from straight lines through short runs of them, the median over runs at like ranges, as most lie
/// on something straight. It never falls with the range. Errors that neighbouring beams share count
/// as far as they bend a run. Empty where the scan has hardly a run.
std::vector<NoiseAtRange> estimateNoise(const Scan& scan);

/// Raises the variances along the beams to those estimated where they are below them.
void raiseToEstimate(Scan& scan);

}  // namespace sightline::scan
