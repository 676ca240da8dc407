#pragma once

namespace sightline::triangulation {

/// Currents at the two ends of the detector, which divides its photocurrent by where the light
/// falls. [A], not negative but for noise.
struct Photocurrents {
  double first = 0.0;
  double second = 0.0;

  /// I₀ [A].
  double total() const { return first + second; }
};

/// Eq. 1: centroid of the light [m] in ±P/2. NaN where the total current is not positive.
double imagePosition(const Photocurrents& currents, double detector_length);

/// The two currents of a total current [A] whose light falls on `image_position` [m].
Photocurrents photocurrentsAt(double image_position, double total_current, double detector_length);

/// Eq. 2: standard deviation of the image position [m] for a noise current I_n [A].
double imagePositionSigma(double total_current, double noise_current, double detector_length);

}  // namespace sightline::triangulation
