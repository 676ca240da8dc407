#include "sightline/lines/break_points.h"

#include <algorithm>

#include "sightline/lines/beam_residuals.h"

namespace sightline::lines {

namespace {

struct BreakPointsConstants {
  // Chosen: how far a break may move at once, and what a piece keeps of itself [returns].
  std::size_t reach = 24;
  std::size_t keep = 3;
};
constexpr BreakPointsConstants kBreaks{};

// Squared normalised residuals, bounded by the gate: a stray return costs the same wherever it is.
Packet costsOf(const BeamArray& beams, std::size_t first, const LineEstimate& line, float bound) {
  return smaller(residualsOf(beams, first, line).squared(), all(bound));
}

}  // namespace

BreakPoints::BreakPoints(const BeamArray& beams, const LineExtractorConfig& config)
    : beams_(beams), gap_(config), gate_squared_(static_cast<float>(config.gate * config.gate)) {}

bool BreakPoints::isOn(const LineEstimate& line, std::size_t i) const {
  return isWithin(beams_, i, line, gate_squared_);
}

void BreakPoints::extendForward(Piece& piece, std::size_t limit) const {
  extendForward(piece, piece.end, limit);
}

void BreakPoints::extendForward(Piece& piece, std::size_t from, std::size_t limit) const {
  double position = positionOn(beams_, piece.end - 1, piece.line);
  bool is_hidden = true;  // by what is in front of the line, from its last return on
  for (std::size_t i = from; i < limit; ++i) {
    const BeamResiduals of = residualsOf(beams_, i, piece.line);
    const double length = static_cast<double>(of.position[0]) - position;
    if (!gap_.mayBridge(beams_, piece.line, piece.end - 1, i, length)) return;
    if (of.squared()[0] > gate_squared_) {
      is_hidden = is_hidden && of.distance[0] < 0.0F;
      continue;
    }
    if (!is_hidden && (i + 1 >= limit || !isOn(piece.line, i + 1))) continue;
    position += length;
    piece.end = i + 1;
    is_hidden = true;
  }
}

void BreakPoints::extendBackward(Piece& piece, std::size_t limit) const {
  extendBackward(piece, piece.first, limit);
}

void BreakPoints::extendBackward(Piece& piece, std::size_t from, std::size_t limit) const {
  double position = positionOn(beams_, piece.first, piece.line);
  bool is_hidden = true;
  for (std::size_t i = from; i-- > limit;) {
    const BeamResiduals of = residualsOf(beams_, i, piece.line);
    const double length = static_cast<double>(of.position[0]) - position;
    if (!gap_.mayBridge(beams_, piece.line, i, piece.first, length)) return;
    if (of.squared()[0] > gate_squared_) {
      is_hidden = is_hidden && of.distance[0] < 0.0F;
      continue;
    }
    if (!is_hidden && (i <= limit || !isOn(piece.line, i - 1))) continue;
    position += length;
    piece.first = i;
    is_hidden = true;
  }
}

void BreakPoints::trim(Piece& piece) const {
  while (piece.end > piece.first + 1 && !isOn(piece.line, piece.end - 1)) --piece.end;
  while (piece.first + 1 < piece.end && !isOn(piece.line, piece.first)) ++piece.first;
}

void BreakPoints::separate(Piece& before, Piece& after) const {
  const std::size_t low =
      std::max(before.first + kBreaks.keep, before.end - std::min(before.end, kBreaks.reach));
  const std::size_t high =
      std::min(after.end - std::min(after.end, kBreaks.keep), after.first + kBreaks.reach);
  if (low >= high || after.first - before.end > kBreaks.reach) return;
  // Past an opening neither line goes on, even where both are one.
  if (!adjoin(before, after, before.line) && !adjoin(before, after, after.line)) return;
  const std::size_t best = bestBreak(before.line, after.line, low, high).at;
  if (best < before.end) before.end = best;
  if (best > after.first) after.first = best;
  trim(before);
  trim(after);
  extendForward(before, best);
  extendBackward(after, best);
}

SIGHTLINE_VECTOR_CLONES
BreakPoints::Break BreakPoints::bestBreak(const LineEstimate& before, const LineEstimate& after,
                                          std::size_t low, std::size_t high) const {
  double difference = 0.0;  // to a break at `low`
  double least = 0.0;
  Break best{low, 0.0};
  for (std::size_t first = low; first < high; first += kLanes) {
    const Packet as_before = costsOf(beams_, first, before, gate_squared_);
    const Packet as_after = costsOf(beams_, first, after, gate_squared_);
    for (std::size_t i = 0; i < kLanes && first + i < high; ++i) {
      best.cost += static_cast<double>(as_after[i]);
      difference += static_cast<double>(as_before[i] - as_after[i]);
      if (difference < least) {
        least = difference;
        best.at = first + i + 1;
      }
    }
  }
  best.cost += least;
  return best;
}

bool BreakPoints::adjoin(const Piece& before, const Piece& after, const LineEstimate& line) const {
  const std::size_t from = before.end - 1;
  return gap_.mayBridge(beams_, line, from, after.first,
                        positionOn(beams_, after.first, line) - positionOn(beams_, from, line));
}

}  // namespace sightline::lines
