#include "sightline/lines/beam_array.h"

#include <algorithm>

namespace sightline::lines {

void BeamArray::assign(const scan::Scan& scan, std::size_t first_beam) {
  const bool circle = scan.geometry->isFullCircle();
  reserve((circle ? 2 : 1) * scan.beams());
  size = 0;
  appendRange(scan, circle ? first_beam : 0, scan.beams(), 0);
  if (circle) appendRange(scan, 0, first_beam, scan.beams());
  round = size;
  if (circle) repeatRound(scan.beams());
  pad();
}

void BeamArray::reserve(std::size_t returns) {
  const std::size_t length = returns + kLanes;
  if (beam.size() >= length) return;
  for (auto* array : {&x, &y, &direction_x, &direction_y, &range_variance, &across_variance}) {
    array->resize(length);
  }
  beam.resize(length);
}

void BeamArray::appendRange(const scan::Scan& scan, std::size_t first, std::size_t last,
                            std::size_t shift) {
  const double* cosines = scan.geometry->cosines().data();
  const double* sines = scan.geometry->sines().data();
  const bool moved = !scan.sensor_motion.empty();
  for (std::size_t i = first; i < last; ++i) {
    if (!scan.isValid(i)) continue;
    const double range = scan.ranges[i];
    if (moved) {
      appendMoved(scan, i);
    } else {
      x[size] = range * cosines[i];
      y[size] = range * sines[i];
      direction_x[size] = cosines[i];
      direction_y[size] = sines[i];
    }
    range_variance[size] = scan.range_variances[i];
    across_variance[size] = range * range * scan.angular_variance + scan.transverse_variance;
    beam[size++] = static_cast<std::uint32_t>(i + shift);
  }
}

void BeamArray::appendMoved(const scan::Scan& scan, std::size_t i) {
  const Eigen::Vector2d direction = scan.direction(i);
  const Eigen::Vector2d end = scan.sensor_motion[i].translation() + scan.ranges[i] * direction;
  x[size] = end.x();
  y[size] = end.y();
  direction_x[size] = direction.x();
  direction_y[size] = direction.y();
}

void BeamArray::repeatRound(std::size_t beams) {
  for (auto* array : {&x, &y, &direction_x, &direction_y, &range_variance, &across_variance}) {
    std::copy_n(array->begin(), round, array->begin() + static_cast<std::ptrdiff_t>(round));
  }
  for (std::size_t i = 0; i < round; ++i) {
    beam[round + i] = beam[i] + static_cast<std::uint32_t>(beams);
  }
  size = 2 * round;
}

void BeamArray::pad() {
  for (std::size_t i = size; i < size + kLanes; ++i) {
    x[i] = y[i] = direction_y[i] = across_variance[i] = 0.0;
    direction_x[i] = range_variance[i] = 1.0;
    beam[i] = 0;
  }
}

}  // namespace sightline::lines
