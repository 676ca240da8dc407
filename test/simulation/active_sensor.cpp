#include "sightline/simulation/active_sensor.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/Cholesky>

#include "sightline/lines/line_extractor.h"
#include "sightline/simulation/simulation.h"

namespace sightline::simulation {
namespace {

using motion::HeadCommand;
using motion::RangeScan;
using scan::ReturnKind;
using triangulation::Ranger;
using Mode = HeadCommand::Mode;

constexpr std::int64_t kScan = 102'400'000;  // ns, 256 samples at 2.5 kHz

world::World cardAhead(double x, double reflectivity = 1.0) {
  world::World world;
  const std::size_t card = world.addMaterial({"card", reflectivity});
  world.add(world::WorldSegment{{{x, 3.0}, {x, -3.0}}, 0.0, 2.0, card});
  return world;
}

Eigen::Isometry3d stillAt(std::int64_t) {
  return Eigen::Isometry3d(Eigen::Translation3d(0.0, 0.0, 1.0));
}

RangeScan firstScan(const world::World& world, const ActiveSensorProfile& profile = {},
                    std::uint64_t seed = 1) {
  ActiveSensor sensor(profile, seed);
  return Ranger(profile.calibrated()).range(sensor.advance(world, kScan, stillAt).at(0));
}

TEST(ActiveSensor, SamplesWithoutAPause) {
  ActiveSensor sensor({}, 1);
  const auto world = cardAhead(1.0);
  EXPECT_TRUE(sensor.advance(world, kScan - 400'001, stillAt).empty());
  const auto first = sensor.advance(world, kScan - 400'000, stillAt);
  ASSERT_EQ(first.size(), 1u);
  EXPECT_EQ(first[0].stamp, 0);
  EXPECT_EQ(first[0].currents.size(), 256u);
  const auto more = sensor.advance(world, 1'000'000'000, stillAt);
  ASSERT_EQ(more.size(), 8u);
  EXPECT_EQ(more[0].stamp, kScan);
  EXPECT_EQ(more[7].stamp, 8 * kScan);
}

TEST(ActiveSensor, GivesTheSameRunHoweverOftenItIsLookedAt) {
  const auto world = cardAhead(1.3);
  ActiveSensor at_once({}, 4);
  ActiveSensor in_steps({}, 4);
  ActiveSensor other_seed({}, 5);
  const auto whole = at_once.advance(world, 2 * kScan, stillAt);
  std::vector<triangulation::RawScan> parts;
  for (std::int64_t time = 0; time <= 2 * kScan; time += 7'000'000) {
    for (auto& scan : in_steps.advance(world, time, stillAt)) parts.push_back(scan);
  }
  ASSERT_GE(parts.size(), 1u);
  EXPECT_EQ(parts[0].currents[77].first, whole[0].currents[77].first);
  EXPECT_NE(other_seed.advance(world, kScan, stillAt)[0].currents[77].first,
            whole[0].currents[77].first);
}

// NEES of every beam against the wall that is there: calibration, noise and geometry in one.
TEST(ActiveSensor, RangesErrAsTheirVariancesSay) {
  const double wall = 1.4;
  const ActiveSensorProfile profile;
  const Eigen::Vector2d origin = profile.sensor.origin.position();
  double sum = 0.0;
  int count = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const scan::Scan scan = firstScan(cardAhead(wall), profile, seed).scan;
    for (std::size_t i = 0; i < scan.beams(); ++i) {
      ASSERT_TRUE(scan.isValid(i));
      const double truth = (wall - origin.x()) / scan.geometry()->cosines()[i];
      sum += std::pow(scan.ranges()[i] - truth, 2) / scan.rangeVariances()[i];
      ++count;
    }
  }
  EXPECT_NEAR(sum / count, 1.0, 4.0 * std::sqrt(2.0 / count) + 0.01);
}

TEST(ActiveSensor, TooLittleLightIsInvalidAndTooFarIsNothing) {
  EXPECT_THAT(firstScan(cardAhead(2.3, 0.05)).scan.kinds(), testing::Each(ReturnKind::kInvalid));
  EXPECT_THAT(firstScan(world::World()).scan.kinds(), testing::Each(ReturnKind::kInvalid));
  const scan::Scan far = firstScan(cardAhead(2.75)).scan;
  EXPECT_GT(std::count(far.kinds().begin(), far.kinds().end(), ReturnKind::kNothing), 200);
  EXPECT_THAT(firstScan(cardAhead(0.43)).scan.kinds()[128], ReturnKind::kTooNear);
}

// pears section 3.3: missing parts. The far wall beside a post is lit, but the post hides it from
// the lens, on one side of it only.
TEST(ActiveSensor, APostMakesAMissingPartOnTheSideOfTheLens) {
  world::World world = cardAhead(2.2);
  world.add(world::WorldSegment{{{1.0, 0.05}, {1.0, -0.05}}, 0.0, 2.0, 1});
  const scan::Scan scan = firstScan(world).scan;
  std::size_t missing_left = 0;
  std::size_t missing_right = 0;
  const double post = std::atan2(0.03, 0.95);  // of its middle, from the scan's origin
  for (std::size_t i = 0; i < scan.beams(); ++i) {
    if (scan.kinds()[i] != ReturnKind::kInvalid) continue;
    ++(scan.geometry()->angles()[i] > post ? missing_left : missing_right);
  }
  EXPECT_EQ(missing_right, 0u);
  EXPECT_GT(missing_left, 5u);
}

// The walls of a room do not move, however the head turns while it looks.
TEST(ActiveSensor, LinesHoldWhileTheHeadTurns) {
  const ActiveSensorProfile profile;
  const Ranger ranger(profile.calibrated());
  const auto world = cardAhead(1.2);
  ActiveSensor sensor(profile, 7);
  sensor.command({Mode::kRate, 0.0, 0.6});
  lines::LineExtractor extractor;
  for (const auto& raw : sensor.advance(world, 6 * kScan, stillAt)) {
    const RangeScan range_scan = ranger.range(raw);
    EXPECT_FALSE(range_scan.scan.sensorMotion().empty());
    const auto& segments = extractor.extract(range_scan.scan);
    ASSERT_EQ(segments.size(), 1u);
    const geometry::Pose2 T_map_projection = geometry::Pose2(0.0, 0.0, raw.head_angles[0]) *
                                             geometry::Pose2(profile.sensor.origin.position(), 0.0);
    const auto line = geometry::transform(T_map_projection, segments[0].line);
    EXPECT_NEAR(line.rho, 1.2, 0.005);
    EXPECT_NEAR(line.phi, 0.0, 0.005);
  }
}

// NEES of walls seen near, far and obliquely, the head still or turning: the covariance of a line
// follows from photocurrents, calibration and motion.
TEST(ActiveSensorStatistics, CovariancesOfLinesAreHonest) {
  const ActiveSensorProfile profile;
  const Ranger ranger(profile.calibrated());
  const geometry::Pose2 T_head_projection(profile.sensor.origin.position(), 0.0);
  struct View {
    double rho, phi, rate;
  };
  for (const View& view :
       {View{0.8, 0.6, 0.8}, {1.3, 0.0, 0.0}, {1.5, -0.5, 0.8}, {2.2, 0.0, 0.0}}) {
    const Eigen::Vector2d normal(std::cos(view.phi), std::sin(view.phi));
    const Eigen::Vector2d along(-normal.y(), normal.x());
    world::World world;
    const std::size_t card = world.addMaterial({"card", 1.0});
    world.add(world::WorldSegment{
        {view.rho * normal + 4.0 * along, view.rho * normal - 4.0 * along}, 0.0, 2.0, card});
    const geometry::PolarLine wall{view.rho, view.phi, Eigen::Matrix2d::Zero()};
    double nees = 0.0;
    constexpr int kRuns = 100;
    for (int run = 1; run <= kRuns; ++run) {
      ActiveSensor sensor(profile, static_cast<std::uint64_t>(run));
      if (view.rate != 0.0) sensor.command({Mode::kRate, 0.0, view.rate});
      const auto raw = sensor.advance(world, 2 * kScan, stillAt).back();
      lines::LineExtractor extractor;
      const auto& segments = extractor.extract(ranger.range(raw).scan);
      ASSERT_EQ(segments.size(), 1u);
      const geometry::Pose2 T_map_head(0.0, 0.0, raw.head_angles[0]);
      const auto line = geometry::transform(T_map_head * T_head_projection, segments[0].line);
      const Eigen::Vector2d error = geometry::difference(line, wall);
      nees += error.dot(line.covariance.ldlt().solve(error)) / kRuns;
    }
    EXPECT_NEAR(nees, 2.0, 0.6) << view.rho << " " << view.phi;
  }
}

TEST(Simulation, CarriesActiveSensorsBesideScanners) {
  Simulation simulation(cardAhead(1.5), {}, {}, 1);
  simulation.carrier().addScanner({}, {});
  simulation.carrier().addActiveSensor({}, {});
  simulation.carrier().commandHead(0, {Mode::kPosition, 0.3, 0.0});
  std::size_t scans = 0;
  std::size_t range_scans = 0;
  for (int i = 0; i < 100; ++i) {
    const Outputs outputs = simulation.step();
    scans += outputs.sweeps.size();
    for (const auto& finished : outputs.range_scans) {
      EXPECT_EQ(finished.sensor, 0u);
      EXPECT_EQ(finished.range_scan.scan.stamp, static_cast<std::int64_t>(range_scans) * kScan);
      ++range_scans;
    }
  }
  EXPECT_EQ(range_scans, 4u);
  EXPECT_EQ(scans, 20u);
  EXPECT_NEAR(simulation.carrier().head(0).angle(), 0.3, 0.0032);
}

TEST(Simulation, TellsWhereTheHeadIsOnceAStep) {
  Simulation simulation(cardAhead(1.5), {}, {}, 1);
  simulation.carrier().addActiveSensor({}, {});
  simulation.carrier().commandHead(0, {Mode::kRate, 0.0, 0.5});
  for (int i = 0; i < 40; ++i) {
    const auto heads = simulation.step().heads;
    ASSERT_EQ(heads.size(), 1u);
    EXPECT_EQ(heads[0].stamp, simulation.time());
    EXPECT_EQ(heads[0].angle, simulation.carrier().head(0).angle());
    EXPECT_EQ(heads[0].rate, simulation.carrier().head(0).rate());
  }
}

// Bearing of a wall's bright half at each sample, without any noise but the jitter's: only where a
// ray crosses the edge of a card does the angle of the head show, so ranges of an oblique wall are
// taken instead. With dr/dφ known, the standard deviation of the angle follows.
TEST(ActiveSensor, HeadAngleJittersAsItsProfileSays) {
  const double distance = 1.2;
  world::World world;
  const double slope = geometry::radians(50.0);  // of the wall against the line of sight
  const Eigen::Vector2d along(std::cos(slope), std::sin(slope));
  const Eigen::Vector2d middle(distance, 0.0);
  world.add(world::WorldSegment{{middle - 3.0 * along, middle + 3.0 * along}, 0.0, 2.0, 0});
  ActiveSensorProfile profile;
  profile.sensor.noise_current = 1e-14;
  const Ranger ranger(profile.calibrated());
  const auto scan = [&](double jitter) {
    profile.jitter = jitter;
    ActiveSensor sensor(profile, 3);
    return sensor.advance(world, 20 * kScan, stillAt);
  };
  const double jitter = geometry::radians(0.36);
  const auto steady = scan(0.0);
  const auto shaken = scan(jitter);
  // The gain of the middle beam from a head that truly turned a little.
  const auto turned = [&](double angle) {
    ActiveSensor sensor(profile, 3);
    const auto raw = sensor.advance(world, kScan, [&](std::int64_t) {
      return stillAt(0) * Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ());
    });
    return ranger.range(raw.at(0)).scan.ranges()[128];
  };
  profile.jitter = 0.0;
  const double gain = (turned(1e-3) - turned(-1e-3)) / 2e-3;  // [m/rad]
  double sum = 0.0;
  int count = 0;
  for (std::size_t s = 0; s < shaken.size(); ++s) {
    EXPECT_EQ(shaken[s].head_angles, steady[s].head_angles) << "what is reported does not jitter";
    const auto with = ranger.range(shaken[s]).scan;
    const auto without = ranger.range(steady[s]).scan;
    for (std::size_t i = 126; i <= 130; ++i, ++count) {
      sum += std::pow((with.ranges()[i] - without.ranges()[i]) / (gain * jitter), 2);
    }
  }
  EXPECT_NEAR(sum / count, 1.0, 4.0 * std::sqrt(2.0 / count) + 0.05);
}

}  // namespace
}  // namespace sightline::simulation
