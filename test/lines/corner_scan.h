#pragma once

#include "lines/room_scan.h"
#include "sightline/lines/beam_array.h"
#include "sightline/lines/line_extractor_config.h"
#include "sightline/lines/piece.h"
#include "sightline/lines/sweep_noise.h"

namespace sightline::test {

/// A scan without noise (σ = 1 cm for the estimators) from the origin, beam k at k / 4 degrees, and
/// what the classes of the extractor make of it.
struct SmallScan {
  explicit SmallScan(const ScanOf& of) : scan(of.takeWithoutNoise()) {
    beams.assign(scan);
    noise.assign(scan, beams);
  }

  SmallScan(const SmallScan&) = delete;

  /// Index of the return of a beam.
  std::size_t at(std::size_t beam) const {
    std::size_t i = 0;
    while (i < beams.size && beams.beam[i] < beam) ++i;
    return i;
  }
  /// The returns of [first_beam, end_beam), refined about a line; no more than it is where those do
  /// not determine one.
  lines::Piece piece(std::size_t first_beam, std::size_t end_beam,
                     const lines::LineEstimate& line) const {
    lines::Piece piece;
    piece.first = at(first_beam);
    piece.end = at(end_beam);
    piece.line = line;
    lines::refine(beams, config.gate * config.gate, piece);
    return piece;
  }

  scan::Scan scan;
  lines::BeamArray beams;
  lines::SweepNoise noise;
  lines::LineExtractorConfig config;
};

inline const lines::LineEstimate kLineAhead{0.0, 1.0, 2.0, {}};   // y = 2
inline const lines::LineEstimate kLineAside{-1.0, 0.0, 1.0, {}};  // x = -1

/// y = 2 from x = 2 to the corner at (-1, 2), and x = -1 from there on. Beams 180 to 466 meet the
/// first wall, 467 to 674 the second one.
inline SmallScan cornerScan() {
  ScanOf of = wallAhead(2.0, -1.0, 2.001);
  of.walls.push_back({{-1.0, 2.0}, {-1.0, 0.2}});
  return SmallScan(of);
}
inline constexpr std::size_t kFirstAhead = 180;
inline constexpr std::size_t kFirstAside = 467;
inline constexpr std::size_t kEndAside = 675;
/// 1.8 σ off the line ahead, the one after it 4.2 σ.
inline constexpr std::size_t kLastNearAhead = 467;

}  // namespace sightline::test
