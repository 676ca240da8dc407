#pragma once

#include <vector>

#include "sightline/geometry/line_segment.h"
#include "sightline/lines/beam_array.h"
#include "sightline/lines/line_extractor_config.h"
#include "sightline/lines/piece.h"
#include "sightline/scan/scan.h"

namespace sightline::lines {

/// Straight walls in a scan, each once, with its covariance and its ends.
///
/// The line filter of pears section 4 finds the pieces. Each is then fitted to its beams by maximum
/// likelihood, the breaks between neighbours are put where the two lines explain the beams best,
/// and pieces of one wall are joined; what is left that is long enough, and that the noise of the
/// beams explains, is a wall.
class LineExtractor {
 public:
  /// Throws config::Error where a setting is out of range.
  explicit LineExtractor(const LineExtractorConfig& config = {});

  /// Segments in the scan's frame at its stamp, in the order of their first beams; one that crosses
  /// the seam of a full circle comes last. Valid until the next call. Nothing is allocated once
  /// scans no larger and no richer have been seen.
  const std::vector<geometry::LineSegment>& extract(const scan::Scan& scan);

 private:
  void findPieces(const scan::Scan& scan);
  std::size_t findPiecesIn(std::size_t first, std::size_t end, std::size_t most);
  void refinePieces();
  void dropFragments();
  void mergePieces();
  void placeBreaks();
  bool isWall(const Piece& piece) const;
  void report(const scan::Scan& scan);

  LineExtractorConfig config_;
  BeamArray beams_;
  std::vector<Piece> pieces_;
  std::vector<geometry::LineSegment> segments_;
};

}  // namespace sightline::lines
