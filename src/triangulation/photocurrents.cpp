#include "sightline/triangulation/photocurrents.h"

#include <limits>

namespace sightline::triangulation {

double imagePosition(const Photocurrents& currents, double detector_length) {
  const double total = currents.total();
  if (!(total > 0.0)) return std::numeric_limits<double>::quiet_NaN();
  return (currents.first - currents.second) / total * (0.5 * detector_length);
}

Photocurrents photocurrentsAt(double image_position, double total_current, double detector_length) {
  const double share = image_position / detector_length;
  return {total_current * (0.5 + share), total_current * (0.5 - share)};
}

double imagePositionSigma(double total_current, double noise_current, double detector_length) {
  return noise_current / total_current * (0.5 * detector_length);
}

}  // namespace sightline::triangulation
