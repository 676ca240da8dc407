#include "sightline/lines/beam_array.h"

#include <algorithm>
#include <cmath>

#include "sightline/lines/packet.h"

namespace sightline::lines {

namespace {

// Chosen: returns that the slant of a surface is told by, and the largest slant that is believed.
constexpr std::size_t kChord = 16;
constexpr float kMostSlant = 10.0F;

}  // namespace

void BeamArray::assign(const scan::Scan& scan, std::size_t first_beam) {
  const bool circle = scan.geometry()->isFullCircle();
  has_jitter = scan.motion_noise.jitter > 0.0;
  has_across = has_jitter || scan.angular_variance > 0.0 || scan.transverse_variance > 0.0;
  reserve((circle ? 2 : 1) * scan.beams());
  takeDirections(scan.geometry());
  size = 0;
  appendValid(scan, circle ? first_beam : 0, scan.beams(), 0);
  if (circle) appendValid(scan, 0, first_beam, scan.beams());
  revolution = size;
  if (has_across) addSlant();
  if (circle) repeatRevolution(scan.beams());
  pad();
}

void BeamArray::reserve(std::size_t returns) {
  const std::size_t length = returns + kPadding;
  if (beam.size() >= length) return;
  for (auto* array : {&x, &y, &direction_x, &direction_y, &range_variance, &across_variance}) {
    array->resize(length);
  }
  cross_covariance.resize(length);
  slant_variance_.resize(length);
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

SIGHTLINE_VECTOR_CLONES
void BeamArray::appendRun(const scan::Scan& scan, std::size_t first, std::size_t end,
                          std::size_t shift) {
  if (scan.sensorMotion().empty()) {
    place(scan, first, end);
  } else {
    placeMoved(scan, first, end);
  }
  const double* ranges = scan.ranges().data() + first;
  const double* variances = scan.rangeVariances().data() + first;
  float* along = range_variance.data() + size;
  float* across = across_variance.data() + size;
  std::uint32_t* index = beam.data() + size;
  const auto offset = static_cast<std::uint32_t>(first + shift);
  const auto count = static_cast<std::uint32_t>(end - first);
  for (std::uint32_t i = 0; i < count; ++i) along[i] = static_cast<float>(variances[i]);
  for (std::uint32_t i = 0; i < count; ++i) index[i] = offset + i;
  const auto transverse = static_cast<float>(scan.transverse_variance);
  std::fill_n(across, count, transverse);
  if (scan.angular_variance > 0.0) {
    const auto angular = static_cast<float>(scan.angular_variance);
    for (std::uint32_t i = 0; i < count; ++i) {
      const auto range = static_cast<float>(ranges[i]);
      across[i] += range * range * angular;
    }
  }
  if (has_jitter) addJitter(scan, first, end);
  size += count;
}

SIGHTLINE_VECTOR_CLONES
void BeamArray::place(const scan::Scan& scan, std::size_t first, std::size_t end) {
  const std::size_t count = end - first;
  const double* ranges = scan.ranges().data() + first;
  const float* cosines = cosines_.data() + first;
  const float* sines = sines_.data() + first;
  float* px = x.data() + size;
  float* py = y.data() + size;
  for (std::size_t i = 0; i < count; ++i) {
    const auto range = static_cast<float>(ranges[i]);
    px[i] = range * cosines[i];
    py[i] = range * sines[i];
  }
  std::copy_n(cosines, count, direction_x.data() + size);
  std::copy_n(sines, count, direction_y.data() + size);
}

SIGHTLINE_VECTOR_CLONES
void BeamArray::takeDirections(const std::shared_ptr<const scan::ScanGeometry>& geometry) {
  if (geometry_ && geometry->sharesDirections(*geometry_)) return;
  geometry_ = geometry;
  cosines_.resize(geometry->beams());
  sines_.resize(geometry->beams());
  std::copy(geometry->cosines().begin(), geometry->cosines().end(), cosines_.begin());
  std::copy(geometry->sines().begin(), geometry->sines().end(), sines_.begin());
}

void BeamArray::placeMoved(const scan::Scan& scan, std::size_t first, std::size_t end) {
  for (std::size_t i = first; i < end; ++i) {
    const Eigen::Vector2d direction = scan.direction(i);
    const Eigen::Vector2d point =
        scan.sensorMotion()[i].translation() + scan.ranges()[i] * direction;
    const std::size_t at = size + i - first;
    x[at] = static_cast<float>(point.x());
    y[at] = static_cast<float>(point.y());
    direction_x[at] = static_cast<float>(direction.x());
    direction_y[at] = static_cast<float>(direction.y());
  }
}

void BeamArray::addJitter(const scan::Scan& scan, std::size_t first, std::size_t end) {
  const double jitter = scan.motion_noise.jitter;
  for (std::size_t i = first; i < end; ++i) {
    const Eigen::Vector2d arm = scan.point(i) - scan.motion_noise.jitter_axis;
    const Eigen::Vector2d direction = scan.direction(i);
    // perp(arm) in the beam's axes.
    const double along = direction.y() * arm.x() - direction.x() * arm.y();
    const double across = direction.dot(arm);
    const std::size_t at = size + i - first;
    range_variance[at] += static_cast<float>(jitter * along * along);
    across_variance[at] += static_cast<float>(jitter * across * across);
    cross_covariance[at] = static_cast<float>(jitter * along * across);
  }
}

// Takes the chord to one side or the other, whichever slants less: a step is no surface.
void BeamArray::addSlant() {
  for (std::size_t i = 0; i < size; ++i) {
    const float before = slantAt(i, i - std::min(i, kChord));
    const float after = slantAt(i, std::min(i + kChord, size - 1));
    const float slant = std::abs(before) < std::abs(after) ? before : after;
    slant_variance_[i] = range_variance[i] + slant * slant * across_variance[i];
    if (has_jitter) slant_variance_[i] -= 2.0F * slant * cross_covariance[i];
  }
}

// Tangent of the incidence on the surface from one return to another.
float BeamArray::slantAt(std::size_t i, std::size_t k) const {
  const float dx = x[k] - x[i];
  const float dy = y[k] - y[i];
  const float along = direction_x[i] * dx + direction_y[i] * dy;
  const float across = direction_x[i] * dy - direction_y[i] * dx;
  if (std::abs(along) >= kMostSlant * std::abs(across)) return kMostSlant;
  return along / across;
}

void BeamArray::repeatRevolution(std::size_t beams) {
  const auto repeat = [this](std::vector<float>& array) {
    std::copy_n(array.begin(), revolution, array.begin() + static_cast<std::ptrdiff_t>(revolution));
  };
  for (auto* array : {&x, &y, &direction_x, &direction_y, &range_variance, &across_variance}) {
    repeat(*array);
  }
  if (has_jitter) repeat(cross_covariance);
  if (has_across) repeat(slant_variance_);
  for (std::size_t i = 0; i < revolution; ++i) {
    beam[revolution + i] = beam[i] + static_cast<std::uint32_t>(beams);
  }
  size = 2 * revolution;
}

void BeamArray::pad() {
  for (std::size_t i = size; i < size + kPadding; ++i) {
    x[i] = y[i] = direction_y[i] = across_variance[i] = cross_covariance[i] = 0.0F;
    direction_x[i] = range_variance[i] = 1.0F;
    beam[i] = 0;
  }
}

}  // namespace sightline::lines
