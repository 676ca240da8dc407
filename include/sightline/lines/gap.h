#pragma once

#include <cmath>
#include <cstddef>

#include "sightline/lines/beam_array.h"
#include "sightline/lines/beam_residuals.h"
#include "sightline/lines/line_extractor_config.h"

namespace sightline::lines {

/// Whether a wall may go on from one return to a later one.
class Gap {
 public:
  explicit Gap(const LineExtractorConfig& config)
      : max_length_(config.max_gap),
        max_missing_(static_cast<std::uint32_t>(config.max_gap_beams)) {}

  /// No beam between neighbours is missing, or too few are for it to matter.
  bool isSmall(const BeamArray& beams, std::size_t from, std::size_t to) const {
    return beams.beam[to] - beams.beam[from] <= 1 + max_missing_;
  }

  /// Whether a wall may go on over this length [m] whatever lies in it.
  bool isShort(double length) const { return std::abs(length) <= max_length_; }
  /// Judges the gap on a line from the return `from` to the return `to`, `length` apart, with every
  /// return between them off the line. One stray return in front of the line is no opening, nor are
  /// a few beams that came back with nothing; anything else is judged by its length.
  bool mayBridge(const BeamArray& beams, const LineEstimate& line, std::size_t from, std::size_t to,
                 double length) const {
    if (isShort(length)) return true;
    if (to - from > 2 || !isSmall(beams, from, to)) return false;
    return to - from < 2 || residualsOf(beams, from + 1, line).distance[0] < 0.0F;
  }

 private:
  double max_length_;
  std::uint32_t max_missing_;
};

}  // namespace sightline::lines
