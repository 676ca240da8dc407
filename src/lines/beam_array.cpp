#include "sightline/lines/beam_array.h"

#include <algorithm>

namespace sightline::lines {

void BeamArray::assign(const scan::Scan& scan, std::size_t first_beam) {
  const bool circle = scan.geometry->isFullCircle();
  reserve((circle ? 2 : 1) * scan.beams());
  size = 0;
  appendValid(scan, circle ? first_beam : 0, scan.beams(), 0);
  if (circle) appendValid(scan, 0, first_beam, scan.beams());
  round = size;
  if (circle) repeatRound(scan.beams());
  pad();
}

void BeamArray::reserve(std::size_t returns) {
  const std::size_t length = returns + kPadding;
  if (beam.size() >= length) return;
  for (auto* array : {&x, &y, &direction_x, &direction_y, &range_variance, &across_variance}) {
    array->resize(length);
  }
  beam.resize(length);
}

// Run by run, so that the work on each is a plain loop over arrays.
void BeamArray::appendValid(const scan::Scan& scan, std::size_t first, std::size_t end,
                            std::size_t shift) {
  std::size_t i = first;
  while (i < end) {
    while (i < end && !scan.isValid(i)) ++i;
    std::size_t run = i;
    while (run < end && scan.isValid(run)) ++run;
    appendRun(scan, i, run, shift);
    i = run;
  }
}

void BeamArray::appendRun(const scan::Scan& scan, std::size_t first, std::size_t end,
                          std::size_t shift) {
  if (scan.sensor_motion.empty()) {
    place(scan, first, end);
  } else {
    placeMoved(scan, first, end);
  }
  const double* ranges = scan.ranges.data() + first;
  const double* variances = scan.range_variances.data() + first;
  float* along = range_variance.data() + size;
  float* across = across_variance.data() + size;
  std::uint32_t* index = beam.data() + size;
  const auto offset = static_cast<std::uint32_t>(first + shift);
  const double angular = scan.angular_variance;
  const double transverse = scan.transverse_variance;
  const std::size_t count = end - first;
  for (std::size_t i = 0; i < count; ++i) {
    along[i] = static_cast<float>(variances[i]);
    across[i] = static_cast<float>(ranges[i] * ranges[i] * angular + transverse);
    index[i] = offset + static_cast<std::uint32_t>(i);
  }
  size += count;
}

void BeamArray::place(const scan::Scan& scan, std::size_t first, std::size_t end) {
  const double* ranges = scan.ranges.data() + first;
  const double* cosines = scan.geometry->cosines().data() + first;
  const double* sines = scan.geometry->sines().data() + first;
  float* px = x.data() + size;
  float* py = y.data() + size;
  float* dx = direction_x.data() + size;
  float* dy = direction_y.data() + size;
  const std::size_t count = end - first;
  for (std::size_t i = 0; i < count; ++i) {
    px[i] = static_cast<float>(ranges[i] * cosines[i]);
    py[i] = static_cast<float>(ranges[i] * sines[i]);
    dx[i] = static_cast<float>(cosines[i]);
    dy[i] = static_cast<float>(sines[i]);
  }
}

void BeamArray::placeMoved(const scan::Scan& scan, std::size_t first, std::size_t end) {
  for (std::size_t i = first; i < end; ++i) {
    const Eigen::Vector2d direction = scan.direction(i);
    const Eigen::Vector2d point = scan.sensor_motion[i].translation() + scan.ranges[i] * direction;
    const std::size_t at = size + i - first;
    x[at] = static_cast<float>(point.x());
    y[at] = static_cast<float>(point.y());
    direction_x[at] = static_cast<float>(direction.x());
    direction_y[at] = static_cast<float>(direction.y());
  }
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
  for (std::size_t i = size; i < size + kPadding; ++i) {
    x[i] = y[i] = direction_y[i] = across_variance[i] = 0.0F;
    direction_x[i] = range_variance[i] = 1.0F;
    beam[i] = 0;
  }
}

}  // namespace sightline::lines
