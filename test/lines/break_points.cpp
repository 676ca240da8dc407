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

TEST(BreakPoints, FragmentIsSharedOutBetweenItsNeighbours) {
  const SmallScan scan = cornerScan();
  Piece before = scan.piece(250, 460, test::kLineAhead);
  Piece after = scan.piece(475, 600, test::kLineAside);
  Piece fragment;
  fragment.first = before.end;
  fragment.end = after.first;
  fragment.beams = static_cast<double>(fragment.size());
  EXPECT_TRUE(BreakPoints(scan.beams, scan.config).shareOut(fragment, &before, &after));
  EXPECT_EQ(before.end, scan.at(test::kFirstAside));
  EXPECT_EQ(after.first, scan.at(test::kFirstAside));
}

TEST(BreakPoints, WhatNeitherNeighbourExplainsIsNoFragment) {
  const SmallScan scan = cornerScan();
  Piece before = scan.piece(250, 460, test::kLineAhead);
  before.line.rho += 0.2;
  Piece after = scan.piece(475, 600, test::kLineAside);
  after.line.rho += 0.2;
  Piece piece;
  piece.first = before.end;
  piece.end = after.first;
  piece.beams = static_cast<double>(piece.size());
  const BreakPoints breaks(scan.beams, scan.config);
  EXPECT_FALSE(breaks.shareOut(piece, &before, &after));
  EXPECT_FALSE(breaks.shareOut(piece, nullptr, nullptr));
  EXPECT_EQ(before.end, scan.at(460));
  EXPECT_EQ(after.first, scan.at(475));
}

}  // namespace
}  // namespace sightline::lines
