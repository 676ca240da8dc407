#include "sightline/lines/break_points.h"

#include <algorithm>

#include "sightline/geometry/statistics.h"
#include "sightline/lines/beam_residuals.h"

namespace sightline::lines {

namespace {

struct BreakPointsConstants {
  // Chosen: how far a break may move at once, and what a piece keeps of itself [returns].
  std::size_t reach = 24;
  std::size_t keep = 3;
  // Counted: a line of its own has a distance, a direction and a break.
  double line_freedom = 3.0;
};
constexpr BreakPointsConstants kBreaks{};

// Squared normalised residuals, bounded by the gate: a stray return costs the same wherever it is.
Packet costsOf(const BeamArray& beams, std::size_t first, const LineEstimate& line, float bound) {
  return smaller(residualsOf(beams, first, line).squared(), all(bound));
}

}  // namespace

BreakPoints::BreakPoints(const BeamArray& beams, const LineExtractorConfig& config)
    : beams_(beams),
      gap_(config),
      gate_squared_(static_cast<float>(config.gate * config.gate)),
      fragment_limit_(geometry::chiSquareLimit(config.gate, kBreaks.line_freedom)) {}

bool BreakPoints::isOn(const LineEstimate& line, std::size_t i) const {
  return isWithin(beams_, i, line, gate_squared_);
}

void BreakPoints::extendForward(Piece& piece, std::size_t limit) const {
  extendForward(piece, piece.end, limit);
}

void BreakPoints::extendForward(Piece& piece, std::size_t from, std::size_t limit) const {
  double position = positionOn(beams_, piece.end - 1, piece.line);
  for (std::size_t i = from; i < limit; ++i) {
    const double length = positionOn(beams_, i, piece.line) - position;
    if (!gap_.mayBridge(beams_, piece.line, piece.end - 1, i, length)) return;
    const bool adjoins = i == piece.end;
    if (!isOn(piece.line, i)) continue;
    if (!adjoins && (i + 1 >= limit || !isOn(piece.line, i + 1))) continue;
    position += length;
    piece.end = i + 1;
  }
}

void BreakPoints::extendBackward(Piece& piece, std::size_t limit) const {
  extendBackward(piece, piece.first, limit);
}

void BreakPoints::extendBackward(Piece& piece, std::size_t from, std::size_t limit) const {
  double position = positionOn(beams_, piece.first, piece.line);
  for (std::size_t i = from; i-- > limit;) {
    const double length = positionOn(beams_, i, piece.line) - position;
    if (!gap_.mayBridge(beams_, piece.line, i, piece.first, length)) return;
    const bool adjoins = i + 1 == piece.first;
    if (!isOn(piece.line, i)) continue;
    if (!adjoins && (i <= limit || !isOn(piece.line, i - 1))) continue;
    position += length;
    piece.first = i;
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

// Whether each return, by itself, is close enough to one line or the other. Mostly the first few
// tell.
SIGHTLINE_VECTOR_CLONES
bool BreakPoints::mayExplain(const LineEstimate& before, const LineEstimate& after,
                             const Piece& piece, double limit) const {
  double cost = 0.0;
  for (std::size_t i = piece.first; i < piece.end; i += kLanes) {
    const Packet closer = smaller(costsOf(beams_, i, before, gate_squared_),
                                  costsOf(beams_, i, after, gate_squared_));
    cost += sum(firstLanes(piece.end - i) * closer);
    if (cost > limit) return false;
  }
  return true;
}

bool BreakPoints::shareOut(const Piece& piece, Piece* before, Piece* after) const {
  if (before && !adjoin(*before, piece, before->line)) before = nullptr;
  if (after && !adjoin(piece, *after, after->line)) after = nullptr;
  if (!before && !after) return false;
  const double stray = static_cast<double>(piece.size()) - piece.beams;
  const double limit =
      piece.chi_square + stray * static_cast<double>(gate_squared_) + fragment_limit_;
  const LineEstimate& first_line = before ? before->line : after->line;
  const LineEstimate& second_line = after ? after->line : before->line;
  if (!mayExplain(first_line, second_line, piece, limit)) return false;
  Break split = bestBreak(first_line, second_line, piece.first, piece.end);
  if (split.cost > limit) return false;
  if (!after) split.at = piece.end;
  if (before && split.at > piece.first) {
    before->end = split.at;
    trim(*before);
  }
  if (after && split.at < piece.end) {
    after->first = split.at;
    trim(*after);
  }
  return true;
}

}  // namespace sightline::lines
