#include "sightline/lines/line_filter.h"

#include <algorithm>
#include <cmath>

#include "sightline/geometry/statistics.h"
#include "sightline/lines/normal_equations.h"

namespace sightline::lines {

namespace {

constexpr double kEverything = 1e12;

struct LineFilterConstants {
  // Chosen: a batch start of more returns than this is given up.
  std::size_t most_to_start = 64;
  // Standard deviation of the direction up to which an update is linear [rad]. A line known worse
  // is linearised anew over all its returns within `uncertain_gate` times the squared gate.
  double linear_phi_sigma = 0.02;
  double uncertain_gate = 4.0;
  // Observations validated against one prediction, for speed: never so many that the line would be
  // predicted far beyond what it is known from.
  double stride_ratio = 0.5;  // of the line's beams
  std::size_t longest_stride = 32;
};
constexpr LineFilterConstants kFilter{};

// The validation gate of one prediction.
class Gate {
 public:
  Gate(const LineEstimate& line, double gate_squared, double motion_noise)
      : gate_squared_(static_cast<float>(gate_squared)) {
    // Shifted to the middle of the line, where rounding does least harm.
    const Information& info = line.information;
    const double middle = -info.rho_phi / info.rho_rho;
    const double scale = gate_squared / info.determinant();
    middle_ = static_cast<float>(middle);
    rho_rho_ =
        static_cast<float>(scale * info.shifted(middle).phi_phi + gate_squared * motion_noise);
    phi_phi_ = static_cast<float>(scale * info.rho_rho);
  }

  // Excess of the squared innovation over the gate (eq. 33), with the innovation covariance of eq.
  // 29.
  Packet excess(const BeamResiduals& residuals) const {
    const Packet a = residuals.position - middle_;
    const Packet predicted = rho_rho_ + a * a * phi_phi_;
    return residuals.weight * (residuals.distance * residuals.distance - predicted) - gate_squared_;
  }

 private:
  float gate_squared_;
  float middle_;   // of what the line is known from, along it: there distance and direction are
                   // independent
  float rho_rho_;  // variance of the distance there, times the gate
  float phi_phi_;
};

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

  // Moments about the centroid, along and across an axis.
  struct Turned {
    double across_across;
    double along_across;

    // Variance of the direction of the line `along = a across + b` by weighted least squares, over
    // the squared cosine of its incidence: the relative error of the predicted noise.
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

LineFilter::LineFilter(const BeamArray& beams, const SweepNoise& sweep_noise,
                       const LineExtractorConfig& config)
    : beams_(beams),
      sweep_noise_(sweep_noise),
      config_(config),
      gap_(config),
      gate_squared_(config.gate * config.gate) {}

bool LineFilter::start(std::size_t first, std::size_t end) {
  const double wanted = config_.start_phi_sigma * config_.start_phi_sigma;
  const std::size_t last = std::min(end, first + kFilter.most_to_start);
  const auto axis_x = static_cast<double>(beams_.direction_x[first]);
  const auto axis_y = static_cast<double>(beams_.direction_y[first]);
  Moments moments;
  for (std::size_t i = first; i < last; ++i) {
    if (i > first && !gap_.isSmall(beams_, i - 1, i)) return false;
    moments.add(1.0 / static_cast<double>(beams_.range_variance[i]),
                static_cast<double>(beams_.x[i] - beams_.x[first]),
                static_cast<double>(beams_.y[i] - beams_.y[first]));
    const std::size_t count = i + 1 - first;
    if (count < kFewestToStart) continue;
    if (moments.turned(axis_x, axis_y).relativeVariance() > wanted) continue;
    return fitStart(moments, first, count);
  }
  return false;
}

bool LineFilter::fitStart(const Moments& moments, std::size_t first, std::size_t count) {
  const double centre_x = static_cast<double>(beams_.x[first]) + moments.x / moments.w;
  const double centre_y = static_cast<double>(beams_.y[first]) + moments.y / moments.w;
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
  const NormalEquations equations = linearise(beams_, first, first + count, line, kEverything);
  if (equations.beams < static_cast<double>(count) || !equations.information.isDetermined())
    return false;
  const double decrease = stepTo(equations, line);
  const double limit = geometry::chiSquareLimit(config_.gate, static_cast<double>(count) - 2.0) *
                       config_.misfit * config_.misfit;
  if (!(equations.chi_square - decrease <= limit)) return false;
  piece_.line = line;
  piece_.first = first;
  piece_.end = first + count;
  piece_.beams = equations.beams;
  piece_.chi_square = equations.chi_square - decrease;
  return true;
}

const Piece& LineFilter::follow(std::size_t end) {
  careful_until_ = 0;
  std::size_t next = piece_.end;
  while (next < end) {
    std::size_t taken = takeStride(next, end);
    if (taken == 0) taken = takeSome(next, end);
    if (taken > 0) {
      next += taken;
      piece_.end = next;
      if (isDirectionUncertain()) relinearise();
      continue;
    }
    const std::size_t ahead = lookAhead(next, end);
    if (ahead == 0) break;
    next += ahead;
  }
  return piece_;
}

// Many at once, as long as all goes well.
SIGHTLINE_VECTOR_CLONES
std::size_t LineFilter::takeStride(std::size_t next, std::size_t end) {
  const std::size_t stride = strideLength();
  const std::size_t stop = next + stride;
  if (stride <= kBlock || stop > end || next < careful_until_) return 0;
  if (isDirectionUncertain() || !isUnbroken(piece_.end - 1, stop - 1)) return 0;
  const Gate gate(piece_.line, gate_squared_, motionNoise(stop - 1));
  NormalSums sums(positionOn(beams_, next, piece_.line));
  Packet excess = all(0.0F);
  for (std::size_t i = next; i < stop; i += kLanes) {
    const BeamResiduals residuals = residualsOf(beams_, i, piece_.line);
    excess = larger(excess, gate.excess(residuals));
    sums.add(residuals, residuals.squared(), all(1.0F));
  }
  if (sum(excess) > 0.0) {
    careful_until_ = stop;
    return 0;
  }
  update(sums.total());
  return stride;
}

std::size_t LineFilter::strideLength() const {
  const auto length = static_cast<std::size_t>(kFilter.stride_ratio * piece_.beams);
  return std::min(length / kBlock * kBlock, kFilter.longest_stride);
}

SIGHTLINE_VECTOR_CLONES
std::size_t LineFilter::takeSome(std::size_t next, std::size_t end) {
  const Validation validation = validate(next);
  const std::size_t block = std::min(kBlock, end - next);
  std::size_t count = 0;
  while (count < block && validation.excess[count] <= 0.0F) ++count;
  if (count > 0 && !isUnbroken(piece_.end - 1, next + count - 1)) {
    count = countBridged(validation, next, count);
  }
  if (count == 0) return 0;
  NormalSums sums(static_cast<double>(validation.position[0]));
  for (std::size_t i = 0; i < count; i += kLanes) {
    const BeamResiduals& residuals = validation.residuals[i / kLanes];
    sums.add(residuals, residuals.squared(), firstLanes(count - i));
  }
  update(sums.total());
  return count;
}

SIGHTLINE_VECTOR_CLONES
LineFilter::Validation LineFilter::validate(std::size_t first) const {
  const Gate gate(piece_.line, gate_squared_, motionNoise(first));
  Validation validation;
  for (std::size_t i = 0; i < kBlock; i += kLanes) {
    BeamResiduals& residuals = validation.residuals[i / kLanes];
    residuals = residualsOf(beams_, first + i, piece_.line);
    store(validation.excess + i, gate.excess(residuals));
    store(validation.position + i, residuals.position);
  }
  return validation;
}

bool LineFilter::isUnbroken(std::size_t from, std::size_t to) const {
  return beams_.beam[to] - beams_.beam[from] == to - from;
}

std::size_t LineFilter::countBridged(const Validation& validation, std::size_t next,
                                     std::size_t count) const {
  std::size_t from = piece_.end - 1;
  double position = positionOn(beams_, from, piece_.line);
  for (std::size_t i = 0; i < count; ++i) {
    const double length = static_cast<double>(validation.position[i]) - position;
    if (!gap_.mayBridge(beams_, piece_.line, from, next + i, length)) return i;
    from = next + i;
    position = static_cast<double>(validation.position[i]);
  }
  return count;
}

// Noise of the motion from the middle of the returns that the line is known from.
double LineFilter::motionNoise(std::size_t next) const {
  if (sweep_noise_.isZero()) return 0.0;
  return sweep_noise_.ofPrediction(piece_.line, piece_.first + piece_.size() / 2,
                                   std::min(next, beams_.size - 1));
}

void LineFilter::update(NormalEquations fresh) {
  fresh.information += piece_.line.information;
  const double decrease = stepTo(fresh, piece_.line);
  piece_.beams += fresh.beams;
  piece_.chi_square += fresh.chi_square - decrease;
}

bool LineFilter::isDirectionUncertain() const {
  const Information& info = piece_.line.information;
  return info.rho_rho > kFilter.linear_phi_sigma * kFilter.linear_phi_sigma * info.determinant();
}

// Far from the estimate the linearisation does not hold: as long as the direction is so uncertain,
// the update is iterated over all observations so far.
void LineFilter::relinearise() {
  const NormalEquations equations = linearise(beams_, piece_.first, piece_.end, piece_.line,
                                              kFilter.uncertain_gate * gate_squared_);
  if (!equations.information.isDetermined()) return;
  const double decrease = stepTo(equations, piece_.line);
  piece_.beams = equations.beams;
  piece_.chi_square = equations.chi_square - decrease;
}

// Two validated returns in a row, not too far on, take the line up again. Returns how many to skip;
// 0 where it ends.
std::size_t LineFilter::lookAhead(std::size_t next, std::size_t end) const {
  const std::size_t last = piece_.end - 1;
  const double position = positionOn(beams_, last, piece_.line);
  const Validation validation = validate(next);
  for (std::size_t i = 1; i + 1 < std::min(kBlock, end - next); ++i) {
    if (!gap_.mayBridge(beams_, piece_.line, last, next + i,
                        static_cast<double>(validation.position[i]) - position))
      return 0;
    if (validation.excess[i] <= 0.0F && validation.excess[i + 1] <= 0.0F) return i;
  }
  return 0;
}

}  // namespace sightline::lines
