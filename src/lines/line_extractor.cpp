#include "sightline/lines/line_extractor.h"

#include <algorithm>
#include <cmath>

#include "sightline/lines/break_points.h"
#include "sightline/lines/end_points.h"
#include "sightline/lines/merging.h"

namespace sightline::lines {

namespace {

// Pieces that something small in front of a wall falls into, at most.
constexpr std::size_t kMostHiding = 4;

// Chosen, for speed: the part of a full circle that a place to begin is looked for in at first.
struct SeamConstants {
  std::size_t parts = 6;
  std::size_t fewest = 32;  // returns
};
constexpr SeamConstants kSeam{};

Piece shifted(const Piece& piece, std::size_t revolution) {
  Piece result = piece;
  for (std::size_t* index :
       {&result.first, &result.end, &result.refined_first, &result.refined_end}) {
    *index += revolution;
  }
  return result;
}

// They follow the sweep, which on a full circle may begin anywhere.
template <class Feature>
void inOrderOfBeams(std::vector<Feature>& features) {
  const auto isBefore = [](const Feature& a, const Feature& b) {
    return a.first_beam < b.first_beam;
  };
  const auto first = std::min_element(features.begin(), features.end(), isBefore);
  std::rotate(features.begin(), first, features.end());
}

}  // namespace

LineExtractor::LineExtractor(const LineExtractorConfig& config)
    : config_(config), segmentation_(config), arc_finder_(config) {
  config::validate(config_);
}

const std::vector<geometry::LineSegment>& LineExtractor::extract(const scan::Scan& scan) {
  reserve(scan.beams());
  findPieces(scan);
  placeBreaks();
  placeBreakAtSeam();
  refinePieces();
  extendBehindSmallThings();
  mergePieces();
  dropHidden();
  arc_finder_.find(scan, beams_, pieces_, arcs_);
  report(scan);
  return segments_;
}

// Reserves as much as there can be, so that no later scan of the size needs more.
void LineExtractor::reserve(std::size_t beams) {
  pieces_.clear();
  segments_.clear();
  arcs_.clear();
  pieces_.reserve(beams / Segmentation::kFewest + 1);
  segmentation_.reserve(beams);
  segments_.reserve(beams / static_cast<std::size_t>(config_.min_beams) + 1);
  arcs_.reserve(beams / static_cast<std::size_t>(config_.min_arc_beams) + 1);
}

void LineExtractor::findPieces(const scan::Scan& scan) {
  beams_.assign(scan);
  sweep_noise_.assign(scan, beams_);
  if (beams_.size > beams_.revolution) {
    // Begin the revolution where a piece ends, so that none is cut by the seam.
    const std::size_t end = endOfOnePiece();
    if (end < beams_.revolution) beams_.assign(scan, beams_.beam[end] % scan.beams());
  }
  segmentation_.divide(beams_, 0, beams_.revolution, pieces_);
}

// Divides no more than shows one piece, and another one after it.
std::size_t LineExtractor::endOfOnePiece() {
  std::size_t part = std::max(kSeam.fewest, beams_.revolution / kSeam.parts);
  while (true) {
    part = std::min(part, beams_.revolution);
    segmentation_.divide(beams_, 0, part, pieces_);
    const std::size_t end = pieces_.empty() ? 0 : pieces_.front().end;
    const bool is_known = pieces_.size() > 1 || part == beams_.revolution;
    pieces_.clear();
    if (is_known) return end;
    part *= 2;
  }
}

void LineExtractor::refinePieces() {
  const double gate_squared = config_.gate * config_.gate;
  const auto undetermined = [&](Piece& piece) { return !refine(beams_, gate_squared, piece); };
  pieces_.erase(std::remove_if(pieces_.begin(), pieces_.end(), undetermined), pieces_.end());
}

void LineExtractor::placeBreaks() {
  const BreakPoints breaks(beams_, config_);
  for (Piece& piece : pieces_) breaks.trim(piece);
  if (pieces_.empty()) return;
  breaks.extendBackward(pieces_.front(), 0);
  breaks.extendForward(pieces_.back(), beams_.revolution);
  for (std::size_t i = 0; i + 1 < pieces_.size(); ++i) {
    breaks.extendForward(pieces_[i], pieces_[i + 1].first);
    breaks.extendBackward(pieces_[i + 1], pieces_[i].end);
    if (pieces_[i].end < pieces_[i + 1].first) breaks.separate(pieces_[i], pieces_[i + 1]);
  }
}

void LineExtractor::placeBreakAtSeam() {
  if (pieces_.size() < 2 || beams_.size == beams_.revolution) return;
  const BreakPoints breaks(beams_, config_);
  // The first piece follows on the last one, a revolution on.
  std::rotate(pieces_.begin(), pieces_.begin() + 1, pieces_.end());
  Piece& last = pieces_[pieces_.size() - 2];
  Piece& first = pieces_.back();
  first = shifted(first, beams_.revolution);
  breaks.extendForward(last, first.first);
  breaks.extendBackward(first, last.end);
  breaks.separate(last, first);
}

void LineExtractor::mergePieces() {
  if (pieces_.empty()) return;
  const Merging merging(beams_, sweep_noise_, config_);
  std::size_t kept = 0;
  for (std::size_t i = 1; i < pieces_.size(); ++i) {
    const std::size_t merged = mergeWithOneFrom(i, merging, pieces_[kept]);
    if (merged < pieces_.size()) {
      i = merged;
    } else {
      pieces_[++kept] = pieces_[i];
    }
  }
  pieces_.resize(kept + 1);
  if (beams_.size > beams_.revolution && pieces_.size() > 1 &&
      merging.merge(pieces_.back(), shifted(pieces_.front(), beams_.revolution))) {
    pieces_.erase(pieces_.begin());
  }
}

// A wall may go on behind small things. Answers which piece it goes on with.
std::size_t LineExtractor::mergeWithOneFrom(std::size_t first, const Merging& merging,
                                            Piece& wall) const {
  for (std::size_t i = first; i < std::min(first + kMostHiding + 1, pieces_.size()); ++i) {
    if (merging.merge(wall, pieces_[i])) return i;
    if (extent(beams_, pieces_[i]) >= config_.min_length) break;
  }
  return pieces_.size();
}

// Extends walls behind small things, where too few of their returns may be left for a piece of
// their own.
void LineExtractor::extendBehindSmallThings() {
  const BreakPoints breaks(beams_, config_);
  const std::size_t count = pieces_.size();
  const bool circle = beams_.size > beams_.revolution;
  for (std::size_t i = 0; i < count; ++i) {
    Piece& piece = pieces_[i];
    if (!isWall(piece, config_) || 2.0 * extent(beams_, piece) < config_.min_length) continue;
    if (i > 0 && isSmall(pieces_[i - 1])) {
      const std::size_t limit = i > 1 ? pieces_[i - 2].end : 0;
      breaks.extendBackward(piece, pieces_[i - 1].first, limit);
    }
    if (i + 1 < count && isSmall(pieces_[i + 1])) {
      const std::size_t limit = i + 2 < count ? pieces_[i + 2].first
                                : circle      ? pieces_.front().first + beams_.revolution
                                              : beams_.size;
      breaks.extendForward(piece, pieces_[i + 1].end, limit);
    }
  }
  refinePieces();
}

bool LineExtractor::isSmall(const Piece& piece) const {
  return piece.beams < config_.min_beams || extent(beams_, piece) < config_.min_length;
}

// A thing in front of a wall that goes on behind it is no neighbour of the wall.
void LineExtractor::dropHidden() {
  const auto isHidden = [&](const Piece& piece) {
    return std::any_of(pieces_.begin(), pieces_.end(), [&](const Piece& other) {
      return other.first < piece.first && piece.end < other.end;
    });
  };
  pieces_.erase(std::remove_if(pieces_.begin(), pieces_.end(), isHidden), pieces_.end());
}

void LineExtractor::report(const scan::Scan& scan) {
  const bool circle = beams_.size > beams_.revolution;
  const EndPoints ends(scan, beams_);
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    const Piece& piece = pieces_[i];
    if (!isWall(piece, config_)) continue;
    const bool alone = pieces_.size() == 1;
    const Piece* before = i > 0 ? &pieces_[i - 1] : circle && !alone ? &pieces_.back() : nullptr;
    const Piece* after = i + 1 < pieces_.size() ? &pieces_[i + 1]
                         : circle && !alone     ? &pieces_.front()
                                                : nullptr;
    const EndPoint start = ends.start(piece, before);
    const EndPoint end = ends.end(piece, after);
    if (!isLong(piece, start, end)) continue;
    segments_.push_back(segmentOf(piece, start, end, scan));
    raiseCovariance(piece, segments_.back());
  }
  inOrderOfBeams(segments_);
  inOrderOfBeams(arcs_);
}

// A sensor that strays from its motion bends what is straight: the returns show it as they show a
// wall that is not, and so only the larger of the two counts.
void LineExtractor::raiseCovariance(const Piece& piece, geometry::LineSegment& segment) {
  const double gate_squared = config_.gate * config_.gate;
  const Eigen::Matrix2d uneven = unevenness(beams_, gate_squared, piece) * segment.line.covariance;
  if (!sweep_noise_.isZero()) sweep_noise_.widen(piece, gate_squared, segment);
  const Eigen::Matrix2d more = uneven - segment.line.covariance;
  if (more.diagonal().minCoeff() > 0.0) segment.line.covariance = uneven;
}

// An end between two beams may lie anywhere there, however far they are apart on the line: what
// counts is what has been seen.
bool LineExtractor::isLong(const Piece& piece, const EndPoint& start, const EndPoint& end) const {
  const bool corners =
      start.kind == geometry::EndKind::kCorner && end.kind == geometry::EndKind::kCorner;
  const double seen = extent(beams_, piece);
  const double between = std::abs(end.position - start.position);
  const double spacing = seen / static_cast<double>(piece.size() - 1);
  return (corners ? between : std::min(between, seen + 2.0 * spacing)) >= config_.min_length;
}

geometry::LineSegment LineExtractor::segmentOf(const Piece& piece, const EndPoint& start,
                                               const EndPoint& end, const scan::Scan& scan) const {
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
  segment.first_beam = beams_.beam[piece.first] % scan.beams();
  segment.last_beam = beams_.beam[piece.end - 1] % scan.beams();
  segment.beams = static_cast<std::size_t>(piece.beams);
  segment.chi_square = piece.chi_square;
  segment.degrees_of_freedom = segment.beams - 2;
  return segment;
}

}  // namespace sightline::lines
