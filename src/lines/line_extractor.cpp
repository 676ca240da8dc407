#include "sightline/lines/line_extractor.h"

#include <algorithm>
#include <cmath>

#include "sightline/lines/break_points.h"
#include "sightline/lines/chi_square.h"
#include "sightline/lines/end_points.h"
#include "sightline/lines/line_filter.h"
#include "sightline/lines/merging.h"

namespace sightline::lines {

namespace {

Piece shifted(const Piece& piece, std::size_t round) {
  Piece result = piece;
  for (std::size_t* index :
       {&result.first, &result.end, &result.refined_first, &result.refined_end}) {
    *index += round;
  }
  return result;
}

}  // namespace

LineExtractor::LineExtractor(const LineExtractorConfig& config) : config_(config) {
  config::validate(config_);
}

const std::vector<geometry::LineSegment>& LineExtractor::extract(const scan::Scan& scan) {
  pieces_.clear();
  segments_.clear();
  findPieces(scan);
  dropFragments();
  placeBreaks();
  refinePieces();
  mergePieces();
  report(scan);
  return segments_;
}

void LineExtractor::findPieces(const scan::Scan& scan) {
  beams_.assign(scan);
  if (beams_.size > beams_.round) {
    // Begin the round where a piece ends, so that none is cut by the seam.
    const std::size_t end = findPiecesIn(0, beams_.round, 1);
    pieces_.clear();
    if (end < beams_.round) beams_.assign(scan, beams_.beam[end] % scan.beams());
  }
  findPiecesIn(0, beams_.round, beams_.round);
}

std::size_t LineExtractor::findPiecesIn(std::size_t first, std::size_t end, std::size_t most) {
  LineFilter filter(beams_, config_);
  std::size_t next = first;
  while (next < end && pieces_.size() < most) {
    if (!filter.start(next, end)) {
      ++next;
      continue;
    }
    pieces_.push_back(filter.follow(end));
    next = pieces_.back().end;
  }
  return next;
}

void LineExtractor::refinePieces() {
  const double gate_squared = config_.gate * config_.gate;
  const auto undetermined = [&](Piece& piece) { return !refine(beams_, gate_squared, piece); };
  pieces_.erase(std::remove_if(pieces_.begin(), pieces_.end(), undetermined), pieces_.end());
}

void LineExtractor::dropFragments() {
  const BreakPoints breaks(beams_, config_);
  std::size_t kept = 0;  // pieces_[0, kept) are settled
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    const Piece piece = pieces_[i];
    Piece* before = kept > 0 ? &pieces_[kept - 1] : nullptr;
    Piece* after = i + 1 < pieces_.size() ? &pieces_[i + 1] : nullptr;
    if (before && before->beams < piece.beams) before = nullptr;
    if (after && after->beams < piece.beams) after = nullptr;
    if (!breaks.shareOut(piece, before, after)) pieces_[kept++] = piece;
  }
  pieces_.resize(kept);
}

void LineExtractor::placeBreaks() {
  const BreakPoints breaks(beams_, config_);
  for (Piece& piece : pieces_) breaks.trim(piece);
  for (std::size_t i = 0; i + 1 < pieces_.size(); ++i) {
    breaks.extendForward(pieces_[i], pieces_[i + 1].first);
    breaks.extendBackward(pieces_[i + 1], pieces_[i].end);
    breaks.separate(pieces_[i], pieces_[i + 1]);
  }
  if (pieces_.size() < 2) return;
  if (beams_.size > beams_.round) {
    // The first piece follows on the last one, a round on.
    std::rotate(pieces_.begin(), pieces_.begin() + 1, pieces_.end());
    Piece& last = pieces_[pieces_.size() - 2];
    Piece& first = pieces_.back();
    first = shifted(first, beams_.round);
    breaks.extendForward(last, first.first);
    breaks.extendBackward(first, last.end);
    breaks.separate(last, first);
  }
}

void LineExtractor::mergePieces() {
  if (pieces_.empty()) return;
  const Merging merging(beams_, config_);
  std::size_t kept = 0;
  for (std::size_t i = 1; i < pieces_.size(); ++i) {
    if (!merging.merge(pieces_[kept], pieces_[i])) pieces_[++kept] = pieces_[i];
  }
  pieces_.resize(kept + 1);
  if (beams_.size > beams_.round && pieces_.size() > 1 &&
      merging.merge(pieces_.back(), shifted(pieces_.front(), beams_.round))) {
    pieces_.erase(pieces_.begin());
  }
}

bool LineExtractor::isWall(const Piece& piece) const {
  if (piece.beams < config_.min_beams) return false;
  const double limit = chiSquareLimit(config_.gate, piece.beams - 2.0);
  return piece.chi_square <= limit * config_.misfit * config_.misfit;
}

void LineExtractor::report(const scan::Scan& scan) {
  const bool circle = beams_.size > beams_.round;
  const EndPoints ends(scan, beams_);
  const auto beamAt = [&](std::size_t i) { return beams_.beam[i] % scan.beams(); };
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    const Piece& piece = pieces_[i];
    if (!isWall(piece)) continue;
    const Piece* before = i > 0 ? &pieces_[i - 1] : circle ? &pieces_.back() : nullptr;
    const Piece* after = i + 1 < pieces_.size() ? &pieces_[i + 1]
                         : circle               ? &pieces_.front()
                                                : nullptr;
    const EndPoint start = ends.start(piece, before == &piece ? nullptr : before);
    const EndPoint end = ends.end(piece, after == &piece ? nullptr : after);
    if (std::abs(end.position - start.position) < config_.min_length) continue;
    const LineEstimate& line = piece.line;
    const Eigen::Vector2d foot(line.rho * line.normal_x, line.rho * line.normal_y);
    const Eigen::Vector2d along(line.alongX(), line.alongY());
    geometry::LineSegment segment;
    segment.line = line.polar();
    segment.ends = {foot + start.position * along, foot + end.position * along};
    segment.start_sigma = std::sqrt(start.variance);
    segment.end_sigma = std::sqrt(end.variance);
    segment.start_kind = start.kind;
    segment.end_kind = end.kind;
    segment.first_beam = beamAt(piece.first);
    segment.last_beam = beamAt(piece.end - 1);
    segment.beams = static_cast<std::size_t>(piece.beams);
    segment.chi_square = piece.chi_square;
    segment.degrees_of_freedom = segment.beams - 2;
    segments_.push_back(segment);
  }
}

}  // namespace sightline::lines
