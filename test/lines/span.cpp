#include "sightline/lines/span.h"

#include <cmath>

#include <gtest/gtest.h>

#include "lines/corner_scan.h"

namespace sightline::lines {
namespace {

// A wall on y = 2 that ends at x = 0.2, and what goes on there: so long, set back, and turned.
struct WallWithPlace {
  explicit WallWithPlace(double length, double set_back, double turn = 0.0) : atoms({}) {
    test::ScanOf of = test::wallAhead(2.0, 0.2, 2.0);
    of.walls.push_back({{0.2 - length, 2.0 + set_back + turn * length}, {0.2, 2.0 + set_back}});
    scan.scan = of.takeWithoutNoise();
    scan.beams.assign(scan.scan);
    atoms.reserve(scan.beams.revolution);
    atoms.assign(scan.beams, 0, scan.beams.revolution);
  }
  double misfit() const {
    const std::size_t end = scan.at(kFirstOnPlace);
    SpanBreaks breaks(scan.config);
    breaks.assign(atoms, scan.beams);
    return breaks.misfit(span(0, end), span(end, scan.beams.revolution));
  }
  Span span(std::size_t first, std::size_t end) const {
    Span result;
    result.first = first;
    result.end = end;
    result.moments = momentsOf(scan.beams, first, end);
    return result;
  }

  static constexpr std::size_t kFirstOnPlace = 338;
  test::SmallScan scan{test::wallAhead(2.0, 0.2, 2.0)};
  Atoms atoms;
};

TEST(SpanBreaks, AShortPlaceMayLeaveWhatAWallMay) {
  EXPECT_LT(WallWithPlace(0.3, 0.02).misfit(), 1.0);
  EXPECT_GT(WallWithPlace(0.3, 0.05).misfit(), 1.0);
  EXPECT_NEAR(WallWithPlace(0.3, 0.0).misfit(), 0.0, 1e-3);
}

TEST(SpanBreaks, TwoWallsAreNoPlacesOfOne) {
  EXPECT_TRUE(std::isinf(WallWithPlace(0.8, 0.02).misfit()));
  EXPECT_TRUE(std::isinf(WallWithPlace(0.2, 0.0, 0.15).misfit())) << "a bend";
}

TEST(SpanBreaks, TwoShortOnesMayLeaveWhatTheNoiseDoes) {
  WallWithPlace of(0.3, 0.012);
  const std::size_t middle = of.scan.at(WallWithPlace::kFirstOnPlace);
  SpanBreaks breaks(of.scan.config);
  breaks.assign(of.atoms, of.scan.beams);
  const Span place = of.span(middle, of.scan.beams.revolution);
  const double beside_a_wall = breaks.misfit(of.span(0, middle), place);
  const double beside_a_short_one = breaks.misfit(of.span(middle - 40, middle), place);
  EXPECT_LT(beside_a_wall, 1.0);
  of.scan.config.misfit = 3.0;
  SpanBreaks lenient(of.scan.config);
  lenient.assign(of.atoms, of.scan.beams);
  EXPECT_LT(lenient.misfit(of.span(0, middle), place), 0.5 * beside_a_wall);
  EXPECT_DOUBLE_EQ(lenient.misfit(of.span(middle - 40, middle), place), beside_a_short_one);
}

}  // namespace
}  // namespace sightline::lines
