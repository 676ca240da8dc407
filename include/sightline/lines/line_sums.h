#pragma once

#include "sightline/lines/line_estimate.h"
#include "sightline/lines/packet.h"

namespace sightline::lines {

/// Weighted sums over returns of their distance e from a line and their position a along it, from a
/// reference on.
struct LineSums {
  double w = 0.0, a = 0.0, aa = 0.0, e = 0.0, ae = 0.0, ee = 0.0;
  double returns = 0.0;

  LineSums& operator+=(const LineSums& other);
  LineSums operator-(const LineSums& other) const;
  /// χ² about the line that fits best.
  double cost() const;
  /// That line; `about` is the line that the sums are about, `reference` the position on it.
  LineEstimate line(const LineEstimate& about, double reference) const;
};

/// Those of the sums that tell what a line of its own gains, of kLanes ranges of returns side by
/// side or of one range lane by lane.
struct LineScores {
  Packet w{}, a{}, aa{}, e{}, ae{};

  LineScores operator-(const LineScores& other) const;
  /// Decrease of χ² by the line that fits best.
  Packet gain() const;
};

}  // namespace sightline::lines
