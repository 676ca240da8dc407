#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "sightline/lines/beam_array.h"
#include "sightline/lines/gap.h"
#include "sightline/lines/line_extractor_config.h"
#include "sightline/lines/piece.h"

namespace sightline::lines {

/// Neighbouring returns [first, end) that no jump parts.
struct Run {
  std::size_t first;
  std::size_t end;
  std::size_t size() const { return end - first; }
};

/// Finds runs of returns that may lie on something round: returns that lie on no wall, or on walls
/// that may be chords of a curve, because they bend alike where they adjoin or the noise does not
/// explain their residuals.
class ArcRuns {
 public:
  explicit ArcRuns(const LineExtractorConfig& config);

  /// Looks at all returns and pieces of a scan; call it first.
  void assign(const BeamArray& beams, const std::vector<Piece>& pieces);
  /// Runs over everything but sure walls. On a full circle none is cut by the seam. Valid until the
  /// next call.
  const std::vector<Run>& withDoubtfulWalls();
  /// Runs within one of those over returns that lie on no wall at all.
  const std::vector<Run>& withoutWalls(const Run& run);
  bool isSureWall(std::size_t i) const { return ownerOf(i) == Owner::kWall; }
  bool isDoubtfulWall(std::size_t i) const { return ownerOf(i) == Owner::kDoubtfulWall; }

 private:
  /// Wall that a return lies on.
  enum class Owner : std::uint8_t { kNone, kDoubtfulWall, kWall };

  Owner ownerOf(std::size_t i) const { return owners_[i % owners_.size()]; }
  Owner judge(const std::vector<Piece>& pieces, std::size_t i) const;
  bool isChord(const std::vector<Piece>& pieces, std::size_t i) const;
  bool mayBeChords(const Piece& before, const Piece& after) const;
  void setOwner(const Piece& piece, Owner owner);
  void setOwner(std::size_t first, std::size_t end, Owner owner);
  void findRuns(std::size_t first, std::size_t end, Owner most, std::vector<Run>& runs) const;
  std::size_t skipWalls(std::size_t first, std::size_t end) const;
  bool isJump(std::size_t from, std::size_t to) const;

  LineExtractorConfig config_;
  Gap gap_;
  const BeamArray* beams_ = nullptr;
  std::size_t begin_ = 0;
  std::vector<Owner> owners_;  // of each return of a revolution
  std::vector<Run> runs_;
  std::vector<Run> loose_runs_;
};

}  // namespace sightline::lines
