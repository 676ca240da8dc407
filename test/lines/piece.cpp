#include "sightline/lines/piece.h"

#include <gtest/gtest.h>

#include "lines/corner_scan.h"

namespace sightline::lines {
namespace {

using test::SmallScan;

TEST(Refine, FindsTheLineFromNearby) {
  const SmallScan scan = test::cornerScan();
  LineEstimate nearby = test::kLineAhead;
  nearby.rho = 2.02;
  const Piece piece = scan.piece(200, 460, nearby);
  EXPECT_NEAR(piece.line.rho, 2.0, 1e-5);
  EXPECT_NEAR(piece.line.normal_x, 0.0, 1e-5);
  EXPECT_DOUBLE_EQ(piece.beams, 260.0);
  EXPECT_NEAR(piece.chi_square, 0.0, 1e-2);
  // Each beam says 1 / ((n·d)² σ²) of the distance.
  double expected = 0.0;
  for (std::size_t i = piece.first; i < piece.end; ++i) {
    const auto facing = static_cast<double>(scan.beams.direction_y[i]);
    expected += 1.0 / (facing * facing * 1e-4);
  }
  EXPECT_NEAR(piece.line.information.rho_rho, expected, 1e-3 * expected);
}

TEST(Refine, LeavesStrayReturnsOut) {
  SmallScan scan = test::cornerScan();
  scan.scan.setRange(300, 1.0);
  scan.beams.assign(scan.scan);
  const Piece piece = scan.piece(200, 460, test::kLineAhead);
  EXPECT_DOUBLE_EQ(piece.beams, 259.0);
  EXPECT_NEAR(piece.line.rho, 2.0, 1e-5);
}

TEST(Refine, AFewReturnsMoreAreTakenInAsInARefitOfAll) {
  const SmallScan scan = test::cornerScan();
  Piece piece = scan.piece(210, 450, test::kLineAhead);
  piece.first = scan.at(200);
  piece.end = scan.at(460);
  ASSERT_TRUE(refine(scan.beams, scan.config.gate * scan.config.gate, piece));
  const Piece whole = scan.piece(200, 460, test::kLineAhead);
  EXPECT_DOUBLE_EQ(piece.beams, whole.beams);
  EXPECT_NEAR(piece.line.information.rho_rho, whole.line.information.rho_rho,
              1e-4 * whole.line.information.rho_rho);
  EXPECT_NEAR(piece.line.information.phi_phi, whole.line.information.phi_phi,
              1e-4 * whole.line.information.phi_phi);
}

TEST(Refine, TwoReturnsDetermineNothing) {
  const SmallScan scan = test::cornerScan();
  Piece piece;
  piece.first = scan.at(300);
  piece.end = piece.first + 2;
  piece.line = test::kLineAhead;
  EXPECT_FALSE(refine(scan.beams, scan.config.gate * scan.config.gate, piece));
}

TEST(Piece, IsAWallWhereItHasEnoughReturnsThatTheNoiseExplains) {
  const SmallScan scan = test::cornerScan();
  Piece piece = scan.piece(200, 460, test::kLineAhead);
  EXPECT_TRUE(isWall(piece, scan.config));
  piece.chi_square = 4.0 * piece.beams;
  EXPECT_FALSE(isWall(piece, scan.config));
  EXPECT_FALSE(isWall(scan.piece(200, 209, test::kLineAhead), scan.config));
}

TEST(Piece, ExtentIsThatOfItsOutermostReturns) {
  const SmallScan scan = test::cornerScan();
  const Piece piece = scan.piece(180, 361, test::kLineAhead);  // 45° to 90°
  EXPECT_NEAR(extent(scan.beams, piece), 2.0, 1e-5);
}

}  // namespace
}  // namespace sightline::lines
