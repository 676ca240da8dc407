#pragma once

#include <vector>

#include "sightline/geometry/arc.h"
#include "sightline/geometry/line_segment.h"
#include "sightline/lines/arc_finder.h"
#include "sightline/lines/beam_array.h"
#include "sightline/lines/end_points.h"
#include "sightline/lines/line_extractor_config.h"
#include "sightline/lines/merging.h"
#include "sightline/lines/piece.h"
#include "sightline/lines/segmentation.h"
#include "sightline/lines/sweep_noise.h"
#include "sightline/scan/scan.h"

namespace sightline::lines {

/// Straight walls in a scan, each once, with its covariance and its ends.
///
/// The returns are divided into pieces by penalised maximum likelihood (Segmentation). Each is then
/// fitted to its beams by the iterated filter of pears section 4 (eqs 37 and 39), and pieces of one
/// wall are joined; what is left that is long enough, and that the noise of the beams explains, is
/// a wall. A run that is likelier round than straight is an arc.
class LineExtractor {
 public:
  /// Throws config::Error where a setting is out of range.
  explicit LineExtractor(const LineExtractorConfig& config = {});

  /// Segments in the scan's frame at its stamp, in the order of their first beams; one that crosses
  /// the seam of a full circle comes last. Valid until the next call. Nothing is allocated once
  /// scans no larger and no richer have been seen.
  const std::vector<geometry::LineSegment>& extract(const scan::Scan& scan);
  /// Round things in the scan that was extracted last, in the same frame and order.
  const std::vector<geometry::Arc>& arcs() const { return arcs_; }

 private:
  void reserve(std::size_t beams);
  void findPieces(const scan::Scan& scan);
  std::size_t endOfOnePiece();
  void refinePieces();
  void mergePieces();
  std::size_t mergeWithOneFrom(std::size_t first, const Merging& merging, Piece& wall) const;
  void placeBreaks();
  void placeBreakAtSeam();
  void extendBehindSmallThings();
  bool isSmall(const Piece& piece) const;
  void dropHidden();
  void report(const scan::Scan& scan);
  void raiseCovariance(const Piece& piece, geometry::LineSegment& segment);
  bool isLong(const Piece& piece, const EndPoint& start, const EndPoint& end) const;
  geometry::LineSegment segmentOf(const Piece& piece, const EndPoint& start, const EndPoint& end,
                                  const scan::Scan& scan) const;

  LineExtractorConfig config_;
  BeamArray beams_;
  SweepNoise sweep_noise_;
  std::vector<Piece> pieces_;
  Segmentation segmentation_;
  ArcFinder arc_finder_;
  std::vector<geometry::LineSegment> segments_;
  std::vector<geometry::Arc> arcs_;
};

}  // namespace sightline::lines
