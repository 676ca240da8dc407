#include "sightline/lines/line_filter.h"

#include <algorithm>
#include <cmath>

#include "sightline/lines/chi_square.h"
#include "sightline/lines/piece.h"

namespace sightline::lines {

namespace {

constexpr std::size_t kFewestToStart = 5;
constexpr std::size_t kMostToStart = 64;
// Standard deviation of the direction up to which an update is linear [rad].
constexpr double kGrownUp = 0.02;
// Times the gate, squared, in which a young line keeps its observations.
constexpr double kLenience = 4.0;

}  // namespace

// Weighted sums over the points of the batch, about its first one.
struct LineFilter::Moments {
  double w = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;

  void add(double weight, double px, double py) {
    w += weight;
    x += weight * px;
    y += weight * py;
    xx += weight * px * px;
    xy += weight * px * py;
    yy += weight * py * py;
  }

  // About the centroid, along and across an axis.
  struct Turned {
    double across_across;
    double along_across;

    // Of the line `along = a across + b` by weighted least squares: variance of its direction over
    // the squared cosine of its incidence. That is the relative error of the predicted noise.
    double relativeVariance() const {
      return across_across / (across_across * across_across + along_across * along_across);
    }
  };
  Turned turned(double axis_x, double axis_y) const {
    const double cxx = xx - x * x / w;
    const double cxy = xy - x * y / w;
    const double cyy = yy - y * y / w;
    return {axis_y * axis_y * cxx - 2.0 * axis_x * axis_y * cxy + axis_x * axis_x * cyy,
            axis_x * axis_y * (cyy - cxx) + (axis_x * axis_x - axis_y * axis_y) * cxy};
  }
};

LineFilter::LineFilter(const BeamArray& beams, const LineExtractorConfig& config)
    : beams_(beams), config_(config), gap_(config), gate_squared_(config.gate * config.gate) {}

std::size_t LineFilter::start(std::size_t first, std::size_t end) {
  const double wanted = config_.start_phi_sigma * config_.start_phi_sigma;
  const std::size_t last = std::min(end, first + kMostToStart);
  const double axis_x = beams_.direction_x[first];
  const double axis_y = beams_.direction_y[first];
  Moments moments;
  for (std::size_t i = first; i < last; ++i) {
    if (i > first && !gap_.isSmall(beams_, i - 1, i)) return first;
    moments.add(1.0 / beams_.range_variance[i], beams_.x[i] - beams_.x[first],
                beams_.y[i] - beams_.y[first]);
    const std::size_t count = i + 1 - first;
    if (count < kFewestToStart) continue;
    if (moments.turned(axis_x, axis_y).relativeVariance() > wanted) continue;
    return fitStart(moments, first, count) ? i + 1 : first;
  }
  return first;
}

bool LineFilter::fitStart(const Moments& moments, std::size_t first, std::size_t count) {
  const double centre_x = beams_.x[first] + moments.x / moments.w;
  const double centre_y = beams_.y[first] + moments.y / moments.w;
  const double distance = std::hypot(centre_x, centre_y);
  const double axis_x = centre_x / distance;
  const double axis_y = centre_y / distance;
  const Moments::Turned turned = moments.turned(axis_x, axis_y);
  // n ∝ axis − a across, with the slope a = along_across / across_across (eq. 38 without the arc
  // tangent).
  const double length = std::hypot(turned.across_across, turned.along_across);
  const double c = turned.across_across / length;
  const double s = turned.along_across / length;
  LineEstimate line;
  line.normal_x = c * axis_x + s * axis_y;
  line.normal_y = c * axis_y - s * axis_x;
  line.rho = line.normal_x * centre_x + line.normal_y * centre_y;
  const NormalEquations equations = linearise(beams_, first, first + count, line, 1e12);
  if (equations.beams < count || !equations.information.isDetermined()) return false;
  const double fallen = stepTo(equations, line);
  const double limit = chiSquareLimit(config_.gate, count - 2) * config_.misfit * config_.misfit;
  if (!(equations.chi_square - fallen <= limit)) return false;
  estimate_ = line;
  return true;
}

std::size_t LineFilter::follow(std::size_t first, std::size_t next, std::size_t end) {
  std::size_t last = next - 1;
  last_position_ = residualsOf(beams_, last, estimate_).position[0];
  while (next < end) {
    const std::size_t lanes = std::min(kLanes, end - next);
    const BeamResiduals residuals = residualsOf(beams_, next, estimate_);
    const std::size_t count = countValidated(residuals, last, next, lanes);
    if (count > 0) {
      update(residuals, count);
      next += count;
      if (isYoung()) relinearise(first, next);
      last = next - 1;
      last_position_ = residuals.position[count - 1];
      continue;
    }
    const std::size_t ahead = lookAhead(residuals, last, next, lanes);
    if (ahead == 0) break;
    next += ahead;
  }
  return last + 1;
}

std::size_t LineFilter::countValidated(const BeamResiduals& residuals, std::size_t last,
                                       std::size_t next, std::size_t lanes) const {
  const std::array<bool, kLanes> valid = validate(residuals);
  std::size_t count = 0;
  while (count < lanes && valid[count]) ++count;
  // Hardly ever is a beam missing between the first and the last of them.
  if (count > 0 && beams_.beam[next + count - 1] - beams_.beam[last] == next + count - 1 - last) {
    return count;
  }
  double position = last_position_;
  for (std::size_t i = 0; i < count; ++i) {
    const double length = residuals.position[i] - position;
    if (!gap_.mayBridge(beams_, i == 0 ? last : next + i - 1, next + i, length)) return i;
    position = residuals.position[i];
  }
  return count;
}

// Eq. 33 with the innovation covariance of eq. 29, for every lane.
std::array<bool, kLanes> LineFilter::validate(const BeamResiduals& residuals) const {
  const Information& info = estimate_.information;
  const double scale = 1.0 / info.determinant();
  std::array<bool, kLanes> valid;
  for (std::size_t i = 0; i < kLanes; ++i) {
    const double e = residuals.distance[i];
    const double a = residuals.position[i];
    const double w = residuals.weight[i];
    const double predicted = scale * (info.phi_phi + a * (2.0 * info.rho_phi + a * info.rho_rho));
    valid[i] = e * e * w <= gate_squared_ * (1.0 + w * predicted);
  }
  return valid;
}

void LineFilter::update(const BeamResiduals& residuals, std::size_t count) {
  NormalEquations equations;
  equations.information = estimate_.information;
  Information& info = equations.information;
  for (std::size_t i = 0; i < count; ++i) {
    const double w = residuals.weight[i];
    const double wa = w * residuals.position[i];
    info.rho_rho += w;
    info.rho_phi -= wa;
    info.phi_phi += wa * residuals.position[i];
    equations.gradient_rho -= w * residuals.distance[i];
    equations.gradient_phi += wa * residuals.distance[i];
  }
  stepTo(equations, estimate_);
}

bool LineFilter::isYoung() const {
  const Information& info = estimate_.information;
  return info.rho_rho > kGrownUp * kGrownUp * info.determinant();
}

// Far from the estimate the linearisation does not hold: as long as the direction is so uncertain,
// the update is iterated over all observations so far.
void LineFilter::relinearise(std::size_t first, std::size_t end) {
  const NormalEquations equations =
      linearise(beams_, first, end, estimate_, kLenience * gate_squared_);
  if (equations.information.isDetermined()) stepTo(equations, estimate_);
}

// Two validated returns in a row, not too far on, take the line up again. Returns how many to skip;
// 0 where it ends.
std::size_t LineFilter::lookAhead(const BeamResiduals& residuals, std::size_t last,
                                  std::size_t next, std::size_t lanes) const {
  const std::array<bool, kLanes> valid = validate(residuals);
  for (std::size_t i = 1; i + 1 < lanes; ++i) {
    const double length = residuals.position[i] - last_position_;
    if (!gap_.mayBridge(beams_, last, next + i, length)) return 0;
    if (valid[i] && valid[i + 1]) return i;
  }
  return 0;
}

}  // namespace sightline::lines
