#include "sightline/scan/range_step.h"

#include <cmath>

#include <gtest/gtest.h>

#include "lines/room_scan.h"

namespace sightline::scan {
namespace {

using test::Gauss;

// As messages hold them: rounded to floats, too.
Scan inSteps(double step, double offset, Gauss& gauss) {
  Scan scan = test::room().take(gauss);
  for (std::size_t i = 0; i < scan.beams(); ++i) {
    const double range = offset + step * std::round(scan.ranges()[i] / step);
    scan.setRange(i, static_cast<double>(static_cast<float>(range)));
  }
  return scan;
}

TEST(RangeStep, IsFound) {
  for (const double step : {0.002, 0.01, 0.05}) {
    Gauss gauss(1);
    RangeStep range_step;
    range_step.look(inSteps(step, 0.0, gauss));
    EXPECT_NEAR(range_step.step(), step, 1e-3 * step);
  }
}

TEST(RangeStep, NeedNotBeginAtZero) {
  Gauss gauss(2);
  RangeStep range_step;
  range_step.look(inSteps(0.05, 0.013, gauss));
  EXPECT_NEAR(range_step.step(), 0.05, 1e-4);
}

TEST(RangeStep, ContinuousRangesHaveNone) {
  Gauss gauss(3);
  RangeStep range_step;
  range_step.look(test::room().take(gauss));
  EXPECT_EQ(range_step.step(), 0.0);
  range_step.look(inSteps(0.05, 0.0, gauss));
  EXPECT_EQ(range_step.step(), 0.0);
}

TEST(RangeStep, IsNotGuessedFromAFewBeams) {
  Gauss gauss(4);
  RangeStep range_step;
  Scan scan = inSteps(0.05, 0.0, gauss);
  for (std::size_t i = 20; i < scan.beams(); ++i) scan.setKind(i, ReturnKind::kInvalid);
  range_step.look(scan);
  EXPECT_EQ(range_step.step(), 0.0);
}

}  // namespace
}  // namespace sightline::scan
