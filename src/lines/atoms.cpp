#include "sightline/lines/atoms.h"

#include <algorithm>
#include <cmath>

#include "sightline/geometry/statistics.h"

namespace sightline::lines {

namespace {

// Chosen, for speed: half of the returns of an atom over the root of the number of returns. So the
// work grows with that number.
constexpr double kShare = 1.0 / 6.0;

}  // namespace

Atoms::Atoms(const LineExtractorConfig& config) : gap_(config), gate_(config.gate) {
  for (std::size_t count = 3; count < limits_.size(); ++count) {
    limits_[count] = geometry::chiSquareLimit(gate_, static_cast<double>(count) - 2.0);
  }
}

void Atoms::reserve(std::size_t returns) {
  atoms_.reserve(returns);
}

void Atoms::assign(const BeamArray& beams, std::size_t first, std::size_t end) {
  atoms_.clear();
  begin_ = first;
  end_ = end;
  const double root = std::sqrt(static_cast<double>(end - first));
  most_ = std::clamp(2 * static_cast<std::size_t>(kShare * root), kLeast, kMost);
  for (std::size_t i = first; i < end; i += most_) {
    const std::size_t next = std::min(i + most_, end);
    take(beams, i, next, lines::momentsOf(beams, i, next));
  }
}

void Atoms::take(const BeamArray& beams, std::size_t first, std::size_t end,
                 const LineMoments& moments) {
  const std::size_t count = end - first;
  const bool is_cut = hasCut(beams, first, end);
  if (!is_cut && count >= kSmallest && isLine(moments, count)) return append(beams, first, moments);
  if (count <= kSmallest) return takeSingly(beams, first, end);
  const std::size_t middle = first + count / 2;
  const LineMoments left = lines::momentsOf(beams, first, middle);
  LineMoments right = moments;
  right -= left;
  if (!is_cut && count == most_ && takeWithStray(beams, first, left, right)) return;
  take(beams, first, middle, left);
  take(beams, middle, end, right);
}

bool Atoms::isLine(const LineMoments& moments, std::size_t count) const {
  if (count >= limits_.size()) return false;
  return moments.costsAtMost(limits_[count]);
}

// All but one return of a whole atom may be of one line: that one is in the half that is none.
bool Atoms::takeWithStray(const BeamArray& beams, std::size_t first, const LineMoments& left,
                          const LineMoments& right) {
  const std::size_t half = most_ / 2;
  const bool is_left = isLine(left, half);
  if (is_left == isLine(right, half)) return false;
  const std::size_t begin = is_left ? first + half : first;
  LineMoments whole = left;
  whole += right;
  for (std::size_t i = begin; i < begin + half; ++i) {
    LineMoments others = whole;
    others -= lines::momentsOf(beams, i);
    if (!isLine(others, most_ - 1)) continue;
    if (!isStray(beams, first, i, others)) return false;
    others.one += gate_ * gate_;
    append(beams, first, others, i);
    return true;
  }
  return false;
}

// Tells whether a return may be left out. A line may be open there where the beams are far apart.
// At either end of the atom, two returns more beyond it have to be of the line, as the one left out
// may be the first of something else.
bool Atoms::isStray(const BeamArray& beams, std::size_t first, std::size_t i,
                    const LineMoments& others) const {
  if (i < begin_ + 2 || i + 3 > end_ || isOpening(beams, i, others.line())) return false;
  const bool is_first = i == first;
  if (!is_first && i + 1 < first + most_) return true;
  const std::size_t beyond = is_first ? first - 2 : i + 1;
  LineMoments more = others;
  more += lines::momentsOf(beams, beyond, beyond + 2);
  return isLine(more, most_ + 1);
}

bool Atoms::isOpening(const BeamArray& beams, std::size_t i, const LineEstimate& line) const {
  const double length =
      std::hypot(beams.x[i + 1] - beams.x[i - 1], beams.y[i + 1] - beams.y[i - 1]);
  return !gap_.mayBridge(beams, line, i - 1, i + 1, length);
}

LineMoments Atoms::momentsOf(const BeamArray& beams, std::size_t atom,
                             std::size_t of_return) const {
  if (of_return != atoms_[atom].stray) return lines::momentsOf(beams, of_return);
  LineMoments moments;
  moments.one = gate_ * gate_;
  return moments;
}

void Atoms::takeSingly(const BeamArray& beams, std::size_t first, std::size_t end) {
  for (std::size_t i = first; i < end; ++i) append(beams, i, lines::momentsOf(beams, i));
}

void Atoms::append(const BeamArray& beams, std::size_t first, const LineMoments& moments,
                   std::size_t stray) {
  atoms_.push_back({first, moments, stray, first > begin_ && isCut(beams, first)});
}

bool Atoms::hasCut(const BeamArray& beams, std::size_t first, std::size_t end) const {
  if (beams.beam[end - 1] - beams.beam[first] == end - 1 - first) return false;
  for (std::size_t i = first + 1; i < end; ++i) {
    if (isCut(beams, i)) return true;
  }
  return false;
}

bool Atoms::isCut(const BeamArray& beams, std::size_t i) const {
  return !gap_.isSmall(beams, i - 1, i) &&
         !gap_.isShort(std::hypot(beams.x[i] - beams.x[i - 1], beams.y[i] - beams.y[i - 1]));
}

}  // namespace sightline::lines
