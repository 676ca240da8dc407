#pragma once

#include <array>
#include <cstddef>

#include "sightline/lines/beam_array.h"
#include "sightline/lines/beam_residuals.h"
#include "sightline/lines/gap.h"
#include "sightline/lines/line_estimate.h"
#include "sightline/lines/line_extractor_config.h"

namespace sightline::lines {

/// The recursive line estimator of pears section 4: an extended Kalman filter on (ρ, φ) in
/// information form, which follows a wall from beam to beam until observations are no longer
/// validated.
///
/// pears moves the state into the sensor's frame of every beam (eqs 20-25). Here the beams have
/// been moved into the frame of the scan at its stamp instead, where a wall stands still and the
/// prediction is the identity: the same filter, for any planar motion. Up to kLanes observations
/// are validated against one prediction and taken in one update.
class LineFilter {
 public:
  LineFilter(const BeamArray& beams, const LineExtractorConfig& config);

  /// Batch start (section 4.6) with the returns from `first` on, as many as the direction needs.
  /// Returns one past the last of them, or `first` where no line explains them.
  std::size_t start(std::size_t first, std::size_t end);

  /// Filters on from the return `next` with the line that started at `first`. Returns one past the
  /// last validated one.
  std::size_t follow(std::size_t first, std::size_t next, std::size_t end);

  const LineEstimate& estimate() const { return estimate_; }

 private:
  struct Moments;
  bool fitStart(const Moments& moments, std::size_t first, std::size_t count);
  std::size_t countValidated(const BeamResiduals& residuals, std::size_t last, std::size_t next,
                             std::size_t lanes) const;
  std::array<bool, kLanes> validate(const BeamResiduals& residuals) const;
  void update(const BeamResiduals& residuals, std::size_t count);
  bool isYoung() const;
  void relinearise(std::size_t first, std::size_t end);
  std::size_t lookAhead(const BeamResiduals& residuals, std::size_t last, std::size_t next,
                        std::size_t lanes) const;

  const BeamArray& beams_;
  const LineExtractorConfig& config_;
  Gap gap_;
  double gate_squared_;
  LineEstimate estimate_;
  double last_position_ = 0.0;  // of the last validated beam along the line
};

}  // namespace sightline::lines
