#include "sightline/lines/line_moments.h"

#include <cmath>

#include <gtest/gtest.h>

#include "lines/corner_scan.h"
#include "lines/turning_walls.h"
#include "sightline/lines/atoms.h"

namespace sightline::lines {
namespace {

using test::Gauss;
using test::SmallScan;

TEST(LineMoments, TellTheLineOfAnyRun) {
  const SmallScan scan = test::cornerScan();
  const LineMoments ahead = momentsOf(scan.beams, 0, scan.at(test::kFirstAside));
  const LineEstimate line = ahead.line();
  EXPECT_NEAR(line.rho, 2.0, 1e-5);
  EXPECT_NEAR(line.normal_y, 1.0, 1e-6);
  EXPECT_NEAR(ahead.cost(), 0.0, 1e-2);
  LineMoments one_by_one;
  for (std::size_t i = 0; i < scan.at(test::kFirstAside); ++i) {
    one_by_one += momentsOf(scan.beams, i);
  }
  EXPECT_NEAR(one_by_one.xy, ahead.xy, 1e-9 * std::abs(ahead.one));
  one_by_one -= momentsOf(scan.beams, 0);
  EXPECT_NEAR(one_by_one.one, momentsOf(scan.beams, 1, scan.at(test::kFirstAside)).one,
              1e-9 * ahead.one);
}

TEST(LineMoments, TellTheCostOfAnyLine) {
  const SmallScan scan = test::cornerScan();
  const LineMoments all = momentsOf(scan.beams, 0, scan.beams.revolution);
  LineEstimate line = all.line();
  EXPECT_NEAR(all.costAbout(line), all.cost(), 1e-6 * all.one);
  line.rho += 0.1;
  EXPECT_GT(all.costAbout(line), all.cost());
  EXPECT_TRUE(all.costsAtMost(1.01 * all.cost()));
  EXPECT_FALSE(all.costsAtMost(0.99 * all.cost()));
  const LineMoments one = momentsOf(scan.beams, 3);
  EXPECT_TRUE(one.costsAtMost(one.one)) << "one return determines no line";
  EXPECT_FALSE(one.costsAtMost(0.5 * one.one));
}

TEST(LineMomentsStatistics, TheirCostIsChiSquare) {
  Gauss gauss(1);
  BeamArray beams;
  double sum = 0.0;
  for (int i = 0; i < 400; ++i) {
    beams.assign(test::wallsThatTurn(0.0, 0.01).take(gauss));
    sum += momentsOf(beams, 0, beams.revolution).cost() /
           (static_cast<double>(beams.revolution) - 2.0);
  }
  EXPECT_NEAR(sum / 400.0, 1.0, 0.02);
}

// Two halves of one wall have one direction and one distance where they meet: χ² of one degree.
TEST(LineMomentsStatistics, DistanceWhereTwoMeetIsInStandardDeviations) {
  Gauss gauss(2);
  BeamArray beams;
  double sum = 0.0;
  for (int i = 0; i < 2000; ++i) {
    beams.assign(test::wallsThatTurn(0.0, 0.01).take(gauss));
    const std::size_t middle = beams.revolution / 2;
    const Eigen::Vector2d direction = beams.direction(middle);
    sum += apartSquared(momentsOf(beams, 0, middle), momentsOf(beams, middle, beams.revolution),
                        direction, direction);
  }
  EXPECT_NEAR(sum / 2000.0, 1.0, 0.1);
}

TEST(Atoms, AreShortWhereTheScanHasAStepAlone) {
  const SmallScan scan = test::cornerScan();
  Atoms atoms({});
  atoms.reserve(scan.beams.revolution);
  atoms.assign(scan.beams, 0, scan.beams.revolution);
  EXPECT_LT(atoms.size(), 2 * scan.beams.revolution / 8);
  std::size_t next = 0;
  for (std::size_t i = 0; i < atoms.size(); ++i) {
    EXPECT_EQ(atoms.beginOf(i), next);
    next = atoms.beginOf(i + 1);
    EXPECT_GT(next, atoms.beginOf(i));
    EXPECT_FALSE(atoms[i].is_cut);
  }
  EXPECT_EQ(next, scan.beams.revolution);
}

TEST(Atoms, LeaveAStrayReturnOut) {
  SmallScan scan(test::wallAhead(2.0, -1.0, 2.0));
  scan.scan.setRange(320, 1.0);
  scan.beams.assign(scan.scan);
  Atoms atoms({});
  atoms.reserve(scan.beams.revolution);
  atoms.assign(scan.beams, 0, scan.beams.revolution);
  std::size_t strays = 0;
  for (std::size_t i = 0; i < atoms.size(); ++i) {
    if (atoms[i].stray == Atom::kNone) continue;
    ++strays;
    EXPECT_EQ(atoms[i].stray, scan.at(320));
    EXPECT_EQ(atoms.momentsOf(scan.beams, i, scan.at(320)).xx, 0.0);
  }
  EXPECT_EQ(strays, 1U);
}

}  // namespace
}  // namespace sightline::lines
