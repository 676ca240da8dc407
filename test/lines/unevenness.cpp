#include <gtest/gtest.h>

#include "lines/turning_walls.h"
#include "sightline/lines/beam_array.h"
#include "sightline/lines/piece.h"

namespace sightline::lines {
namespace {

using test::Gauss;

// All returns as one piece, with the line through them.
Piece wholeOf(const BeamArray& beams, const LineExtractorConfig& config) {
  Piece piece;
  piece.end = beams.revolution;
  piece.line = {0.0, 1.0, 2.8, {}};
  for (int i = 0; i < 3; ++i) refine(beams, 1e4 * config.gate, piece);
  return piece;
}

TEST(Unevenness, RaisesTheCovarianceOfAWallThatIsNotStraightAlone) {
  Gauss gauss(5);
  const LineExtractorConfig config;
  const double gate_squared = config.gate * config.gate;
  BeamArray beams;
  double sum = 0.0;
  for (int i = 0; i < 200; ++i) {
    beams.assign(test::wallsThatTurn(0.0, 0.01).take(gauss));
    Piece piece = wholeOf(beams, config);
    ASSERT_TRUE(refine(beams, gate_squared, piece));
    sum += unevenness(beams, gate_squared, piece);
  }
  EXPECT_NEAR(sum / 200.0, 1.0, 0.1);
  // A bow of 1 cm over six metres.
  scan::Scan scan = test::wallsThatTurn(0.0, 0.01).take(gauss);
  for (std::size_t i = 0; i < scan.beams(); ++i) {
    if (!scan.isValid(i)) continue;
    const double x = scan.point(i).x();
    scan.setRange(i, scan.ranges()[i] + 0.02 * (1.0 - x * x / 9.0));
  }
  beams.assign(scan);
  Piece piece = wholeOf(beams, config);
  ASSERT_TRUE(refine(beams, gate_squared, piece));
  EXPECT_GT(unevenness(beams, gate_squared, piece), 5.0);
}

}  // namespace
}  // namespace sightline::lines
