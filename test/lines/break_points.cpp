#include "sightline/lines/break_points.h"

#include <gtest/gtest.h>

#include "lines/corner_scan.h"

namespace sightline::lines {
namespace {

using test::cornerScan;
using test::SmallScan;

TEST(BreakPoints, ExtendAsFarAsTheGateAllows) {
  const SmallScan scan = cornerScan();
  const BreakPoints breaks(scan.beams, scan.config);
  Piece piece = scan.piece(250, 300, test::kLineAhead);
  breaks.extendForward(piece, scan.beams.size);
  EXPECT_EQ(piece.end, scan.at(test::kLastNearAhead + 1));
  breaks.extendBackward(piece, scan.at(200));
  EXPECT_EQ(piece.first, scan.at(200));
  breaks.extendBackward(piece, 0);
  EXPECT_EQ(piece.first, scan.at(test::kFirstAhead));
}

TEST(BreakPoints, TrimTakesOffWhatIsNotOnTheLine) {
  const SmallScan scan = cornerScan();
  Piece piece = scan.piece(250, 300, test::kLineAhead);
  piece.end = scan.at(480);
  BreakPoints(scan.beams, scan.config).trim(piece);
  EXPECT_EQ(piece.first, scan.at(250));
  EXPECT_EQ(piece.end, scan.at(test::kLastNearAhead + 1));
}

TEST(BreakPoints, SeparatePutsTheBreakAtTheCorner) {
  const SmallScan scan = cornerScan();
  const BreakPoints breaks(scan.beams, scan.config);
  for (const std::size_t at : {460U, 467U, 474U}) {
    Piece before = scan.piece(250, 460, test::kLineAhead);
    Piece after = scan.piece(475, 600, test::kLineAside);
    before.end = after.first = scan.at(at);
    breaks.separate(before, after);
    EXPECT_EQ(before.end, scan.at(test::kFirstAside)) << at;
    EXPECT_EQ(after.first, scan.at(test::kFirstAside)) << at;
  }
}

// Beams 300 to 310 hit something; a single return between things in front is taken, between things
// behind it is not.
TEST(BreakPoints, OneReturnIsEnoughWhereTheLineIsHidden) {
  for (const bool is_hidden : {true, false}) {
    SmallScan scan = cornerScan();
    for (std::size_t beam = 300; beam <= 310; ++beam) {
      if (beam != 305) scan.scan.setRange(beam, is_hidden ? 1.0 : 3.0);
    }
    scan.beams.assign(scan.scan);
    Piece piece = scan.piece(250, 300, test::kLineAhead);
    BreakPoints(scan.beams, scan.config).extendForward(piece, scan.at(310));
    EXPECT_EQ(piece.end, scan.at(is_hidden ? 306 : 300));
  }
}

TEST(BreakPoints, BackwardTheyTakeTheSame) {
  for (const bool is_hidden : {true, false}) {
    SmallScan scan = cornerScan();
    for (std::size_t beam = 300; beam <= 310; ++beam) {
      if (beam != 305) scan.scan.setRange(beam, is_hidden ? 1.0 : 3.0);
    }
    scan.beams.assign(scan.scan);
    Piece piece = scan.piece(311, 400, test::kLineAhead);
    BreakPoints(scan.beams, scan.config).extendBackward(piece, scan.at(300));
    EXPECT_EQ(piece.first, scan.at(is_hidden ? 305 : 311));
  }
}

}  // namespace
}  // namespace sightline::lines
