#pragma once

#include "sightline/config/fields.h"

namespace sightline::lines {

/// Settings of the line extractor. What a beam is worth comes from the variances of the scan; what
/// is left to choose is here, in standard deviations where it can be.
struct LineExtractorConfig {
  double gate = 3.5;     ///< g of pears eq. 33 [σ]
  double misfit = 1.5;   ///< residuals of a wall over those of the noise, at most
  double max_gap = 0.3;  ///< [m]
  /// A scanner that loses every twentieth return loses three in a row once in 8000.
  int max_gap_beams = 2;
  double min_length = 0.5;  ///< [m]
  int min_beams = 10;
  double max_radius = 2.5;  ///< of an arc [m]; 0: no arcs
  int min_arc_beams = 6;
  int start_beams = 5;  ///< of PlainExtractor: k of pears section 4.6

  void visit(config::FieldVisitor& visitor);
};

}  // namespace sightline::lines
