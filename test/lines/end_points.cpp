#include "sightline/lines/end_points.h"

#include <cmath>

#include <gtest/gtest.h>

#include "lines/corner_scan.h"

namespace sightline::lines {
namespace {

using geometry::EndKind;
using test::cornerScan;
using test::SmallScan;

// Place where a beam meets y = 2, along the line (x runs against it).
double positionAhead(double beam) {
  return -2.0 / std::tan(geometry::radians(0.25 * beam));
}

TEST(EndPoints, WallsThatMeetEndWhereTheirLinesCross) {
  const SmallScan scan = cornerScan();
  const Piece ahead = scan.piece(test::kFirstAhead, test::kFirstAside, test::kLineAhead);
  const Piece aside = scan.piece(test::kFirstAside, test::kEndAside, test::kLineAside);
  const EndPoints ends(scan.scan, scan.beams);
  const EndPoint end = ends.end(ahead, &aside);
  EXPECT_EQ(end.kind, EndKind::kCorner);
  EXPECT_NEAR(end.position, 1.0, 1e-4);
  EXPECT_GT(end.variance, 0.0);
  const EndPoint start = ends.start(aside, &ahead);
  EXPECT_EQ(start.kind, EndKind::kCorner);
  EXPECT_NEAR(start.position, -2.0, 1e-4);
}

TEST(EndPoints, HiddenWallEndsBetweenTwoBeams) {
  const SmallScan scan = cornerScan();
  const Piece ahead = scan.piece(test::kFirstAhead, test::kFirstAside, test::kLineAhead);
  const EndPoint end = EndPoints(scan.scan, scan.beams).end(ahead, nullptr);
  EXPECT_EQ(end.kind, EndKind::kOccluded);
  EXPECT_NEAR(end.position, 0.5 * (positionAhead(466) + positionAhead(467)), 1e-4);
  const double step = positionAhead(467) - positionAhead(466);
  EXPECT_GT(end.variance, step * step / 12.0);
}

TEST(EndPoints, WallThatBeamsPassByHasAnOccludingEdge) {
  const SmallScan scan = cornerScan();
  const Piece ahead = scan.piece(test::kFirstAhead, test::kFirstAside, test::kLineAhead);
  const EndPoint start = EndPoints(scan.scan, scan.beams).start(ahead, nullptr);
  EXPECT_EQ(start.kind, EndKind::kOccludingEdge);
  EXPECT_NEAR(start.position, 0.5 * (positionAhead(179) + positionAhead(180)), 1e-4);
}

TEST(EndPoints, WallThatGoesOnBeyondTheFirstBeamEndsThere) {
  test::ScanOf of = test::wallAhead(2.0, -5.0, 5.0);
  of.angle_min = geometry::radians(60.0);
  of.beams = 200;
  const SmallScan scan(of);
  const Piece wall = scan.piece(0, 200, test::kLineAhead);
  const EndPoint start = EndPoints(scan.scan, scan.beams).start(wall, nullptr);
  EXPECT_EQ(start.kind, EndKind::kScanLimit);
  EXPECT_NEAR(start.position, positionAhead(240), 1e-4);
}

// A direction that errs by δ moves the end by δ times the squared range over the distance.
TEST(EndPoints, JitterOfTheHeadMovesAnEnd) {
  test::ScanOf of = test::wallAhead(2.0, -5.0, 5.0);
  of.angle_min = geometry::radians(60.0);
  of.beams = 200;
  SmallScan scan(of);
  const Piece wall = scan.piece(0, 200, test::kLineAhead);
  const double before = EndPoints(scan.scan, scan.beams).start(wall, nullptr).variance;
  scan.scan.motion_noise.jitter = 1e-4;
  const double after = EndPoints(scan.scan, scan.beams).start(wall, nullptr).variance;
  const double range = scan.scan.ranges()[0];
  EXPECT_NEAR(after - before, 1e-4 * std::pow(range * range / 2.0, 2), 1e-8);
}

}  // namespace
}  // namespace sightline::lines
