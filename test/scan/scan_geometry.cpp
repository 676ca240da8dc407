#include "sightline/scan/scan_geometry.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>

#include "sightline/geometry/angle.h"

namespace sightline::scan {
namespace {

using geometry::kPi;
using geometry::radians;
using testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kEndless = std::numeric_limits<double>::infinity();

template <class Call>
std::string faultOf(const Call& call) {
  try {
    call();
  } catch (const InvalidScan& error) {
    return error.what();
  }
  ADD_FAILURE() << "no error";
  return "";
}

std::string faultOfUniform(double angle_min, double increment, std::size_t beams,
                           double time_increment = 0.0, double range_min = 0.1,
                           double range_max = 30.0) {
  return faultOf([&] {
    ScanGeometry::uniform(angle_min, increment, beams, time_increment, range_min, range_max);
  });
}

std::string faultOfAngles(const std::vector<double>& angles) {
  return faultOf([&] { ScanGeometry(angles, std::vector<double>(angles.size(), 0.0), 0.1, 30.0); });
}

TEST(ScanGeometry, HoldsWhatItIsGiven) {
  const auto geometry = ScanGeometry::uniform(-0.5 * kPi, radians(0.5), 361, 1e-4, 0.1, 30.0);
  ASSERT_EQ(geometry->beams(), 361u);
  EXPECT_NEAR(geometry->angles().front(), -0.5 * kPi, 1e-15);
  EXPECT_NEAR(geometry->angles().back(), 0.5 * kPi, 1e-13);
  EXPECT_NEAR(geometry->angleIncrement(), radians(0.5), 1e-15);
  EXPECT_NEAR(geometry->timeOffsets().back(), 0.036, 1e-15);
  EXPECT_EQ(geometry->rangeMin(), 0.1);
  EXPECT_EQ(geometry->rangeMax(), 30.0);
  for (std::size_t i = 0; i < geometry->beams(); ++i) {
    EXPECT_EQ(geometry->cosines()[i], std::cos(geometry->angles()[i]));
    EXPECT_EQ(geometry->sines()[i], std::sin(geometry->angles()[i]));
  }
}

TEST(ScanGeometry, MayRunClockwise) {
  const auto geometry = ScanGeometry::uniform(1.0, -0.01, 100, 0.0, 0.1, 30.0);
  EXPECT_NEAR(geometry->angleIncrement(), -0.01, 1e-15);
  EXPECT_NEAR(geometry->angles().back(), 0.01, 1e-13);
}

TEST(ScanGeometry, MayHaveOneBeamOfAnyIncrement) {
  for (const double increment : {0.0, 0.1, kNan, kEndless}) {
    const auto geometry = ScanGeometry::uniform(0.3, increment, 1, 0.0, 0.1, 30.0);
    EXPECT_EQ(geometry->angles().front(), 0.3);
    EXPECT_EQ(geometry->angleIncrement(), 0.0);
    EXPECT_FALSE(geometry->isFullCircle());
  }
}

TEST(ScanGeometry, MayBeUnevenAndUnlimited) {
  const ScanGeometry geometry({-1.0, 0.0, 0.5}, {0.0, 0.02, 0.01}, 0.0, kEndless);
  EXPECT_NEAR(geometry.angleIncrement(), 0.75, 1e-15);
  EXPECT_EQ(geometry.rangeMax(), kEndless);
}

TEST(ScanGeometry, RefusesNoBeams) {
  EXPECT_EQ(faultOfUniform(0.0, 0.1, 0), "no beams");
}

TEST(ScanGeometry, RefusesAnIncrementThatLeadsNowhere) {
  EXPECT_EQ(faultOfUniform(0.0, 0.0, 10), "an angle increment of 0");
  EXPECT_EQ(faultOfUniform(0.0, kNan, 10), "an angle increment of nan");
  EXPECT_EQ(faultOfUniform(0.0, kEndless, 10), "an angle increment of inf");
}

TEST(ScanGeometry, RefusesAnglesThatAreNotFinite) {
  EXPECT_THAT(faultOfUniform(kNan, 0.1, 10), HasSubstr("not finite"));
  EXPECT_THAT(faultOfUniform(kEndless, 0.1, 1), HasSubstr("not finite"));
  EXPECT_THAT(faultOfAngles({0.0, kNan, 0.2}), HasSubstr("not finite"));
}

TEST(ScanGeometry, RefusesAnglesThatTurnBackOrStand) {
  EXPECT_THAT(faultOfAngles({0.0, 0.1, 0.05}), HasSubstr("beam 2"));
  EXPECT_THAT(faultOfAngles({0.0, -0.1, -0.1}), HasSubstr("beam 2"));
  // An increment that is lost in rounding does not turn on either.
  EXPECT_THAT(faultOfUniform(1.0, 1e-20, 3), HasSubstr("beam 1"));
}

TEST(ScanGeometry, RefusesMoreThanOneTurn) {
  EXPECT_THAT(faultOfUniform(0.0, 0.1, 64), HasSubstr("more than a turn"));
  EXPECT_THAT(faultOfUniform(0.0, -0.1, 64), HasSubstr("more than a turn"));
}

TEST(ScanGeometry, RefusesRangeLimitsOutOfOrder) {
  EXPECT_THAT(faultOfUniform(0.0, 0.1, 10, 0.0, -0.1, 30.0), HasSubstr("range limits -0.1 to 30"));
  EXPECT_THAT(faultOfUniform(0.0, 0.1, 10, 0.0, 5.0, 5.0), HasSubstr("range limits"));
  EXPECT_THAT(faultOfUniform(0.0, 0.1, 10, 0.0, 0.0, 0.0), HasSubstr("range limits"));
  EXPECT_THAT(faultOfUniform(0.0, 0.1, 10, 0.0, kNan, 5.0), HasSubstr("range limits"));
  EXPECT_THAT(faultOfUniform(0.0, 0.1, 10, 0.0, 0.1, kNan), HasSubstr("range limits"));
}

TEST(ScanGeometry, RefusesTimesThatAreWrong) {
  EXPECT_THAT(faultOfUniform(0.0, 0.1, 10, kNan), HasSubstr("time offset that is not finite"));
  EXPECT_EQ(faultOf([] {
              ScanGeometry({0.0, 0.1}, {0.0}, 0.1, 30.0);
            }),
            "1 time offsets for 2 beams");
}

TEST(ScanGeometry, KnowsAFullCircle) {
  const auto turn = [](double increment, std::size_t beams) {
    return ScanGeometry::uniform(-kPi, increment, beams, 0.0, 0.1, 30.0)->isFullCircle();
  };
  EXPECT_TRUE(turn(radians(1.0), 360));
  EXPECT_TRUE(turn(radians(1.0), 361));  // the last beam repeats the first
  EXPECT_TRUE(turn(radians(1.0 + 1e-5), 360));
  EXPECT_FALSE(turn(radians(1.0), 358));
  EXPECT_FALSE(turn(radians(0.25), 1081));
  EXPECT_TRUE(ScanGeometry::uniform(kPi, -radians(1.0), 360, 0.0, 0.1, 30.0)->isFullCircle());
  // Floats of a message: 360 increments overshoot the turn by a little.
  EXPECT_TRUE(turn(static_cast<double>(0.0174532942f), 361));
}

TEST(ScanGeometry, AnotherTimeIncrementSharesTheDirections) {
  const auto geometry = ScanGeometry::uniform(-1.0, 0.1, 21, 1e-3, 0.1, 30.0);
  const auto slower = geometry->withTimeIncrement(2e-3);
  EXPECT_TRUE(slower->sharesDirections(*geometry));
  EXPECT_EQ(slower->sines().data(), geometry->sines().data());
  EXPECT_DOUBLE_EQ(slower->timeOffsets()[20], 0.04);
  EXPECT_DOUBLE_EQ(geometry->timeOffsets()[20], 0.02);
  EXPECT_EQ(slower->rangeMax(), 30.0);
  EXPECT_FALSE(slower->sharesDirections(*geometry->mirrored()));
  EXPECT_EQ(faultOf([&] { geometry->withTimeIncrement(kNan); }),
            "a time offset that is not finite");
}

}  // namespace
}  // namespace sightline::scan
