#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "sightline/lines/line_moments.h"

namespace sightline::lines {

/// Lines that begin at some atom and go on to the present one, each quantity an array: what the
/// dynamic programme of Segmentation looks at for every atom.
class LineBeginnings {
 public:
  void reserve(std::size_t most);
  void clear() { count_ = 0; }
  bool isEmpty() const { return count_ == 0; }

  /// Adds a line with the cost of all that lies before it.
  void push(std::uint32_t atom, double cost_before, const LineMoments& moments);
  /// Adds the moments of an atom to each, and answers which line costs least with what lies before
  /// it. At least one is needed.
  std::size_t advance(const LineMoments& moments);
  double total(std::size_t i) const { return total_[i]; }
  std::uint32_t atom(std::size_t i) const { return atom_[i]; }
  /// Drops the lines that cost more, at the last advance, with what lies before them.
  void keepBelow(double limit);

 private:
  void moveTo(std::size_t to, std::size_t from);

  std::vector<double> before_, one_, x_, y_, xx_, xy_, yy_, total_;
  std::vector<std::uint32_t> atom_;
  std::size_t count_ = 0;
};

}  // namespace sightline::lines
