#pragma once

#include <cstddef>

#include "sightline/lines/beam_array.h"
#include "sightline/lines/beam_residuals.h"
#include "sightline/lines/gap.h"
#include "sightline/lines/line_extractor_config.h"
#include "sightline/lines/normal_equations.h"
#include "sightline/lines/piece.h"
#include "sightline/lines/sweep_noise.h"

namespace sightline::lines {

/// The recursive line estimator of pears section 4: an extended Kalman filter on (ρ, φ) in
/// information form, which follows a wall from beam to beam until observations are no longer
/// validated.
///
/// pears moves the state into the sensor's frame of every beam (eqs 20-25). Here the beams have
/// been moved into the frame of the scan at its stamp instead, where a wall stands still and the
/// prediction is the identity: the same filter, for any planar motion. The noise of the motion
/// widens the gate of the prediction (Q of eq. 21). Observations are validated
/// several at once against one prediction and taken in one update.
class LineFilter {
 public:
  static constexpr std::size_t kFewestToStart = 5;

  LineFilter(const BeamArray& beams, const SweepNoise& sweep_noise,
             const LineExtractorConfig& config);

  /// Batch start (section 4.6) with the returns from `first` on, as many as the direction needs.
  /// False where no line explains them.
  bool start(std::size_t first, std::size_t end);

  /// Filters on from a start. The piece ends one past the last validated return.
  const Piece& follow(std::size_t end);

 private:
  static constexpr std::size_t kBlock = kPadding;
  /// Residuals of kBlock observations against one prediction.
  struct Validation {
    BeamResiduals residuals[kBlock / kLanes];
    float excess[kBlock];    // beyond the gate where positive
    float position[kBlock];  // along the line [m]
  };
  struct Moments;
  bool fitStart(const Moments& moments, std::size_t first, std::size_t count);
  std::size_t strideLength() const;
  std::size_t takeStride(std::size_t next, std::size_t end);
  std::size_t takeSome(std::size_t next, std::size_t end);
  Validation validate(std::size_t first) const;
  bool isUnbroken(std::size_t from, std::size_t to) const;
  std::size_t countBridged(const Validation& validation, std::size_t next, std::size_t count) const;
  double motionNoise(std::size_t next) const;
  void update(NormalEquations fresh);
  bool isDirectionUncertain() const;
  void relinearise();
  std::size_t lookAhead(std::size_t next, std::size_t end) const;

  const BeamArray& beams_;
  const SweepNoise& sweep_noise_;
  const LineExtractorConfig& config_;
  Gap gap_;
  double gate_squared_;
  Piece piece_;
  std::size_t careful_until_ = 0;  // a stride to here has failed
};

}  // namespace sightline::lines
