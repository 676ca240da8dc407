#include "sightline/simulation/scanner.h"

#include <numeric>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sightline/motion/sweep.h"

namespace sightline::simulation {
namespace {

using geometry::Pose2;
using geometry::radians;

world::World wallAhead(double distance, double reflectivity = 0.7) {
  world::World world;
  const auto material = world.addMaterial({"paint", reflectivity});
  world.add(world::WorldSegment{{{distance, -50.0}, {distance, 50.0}}, 0.0, 2.0, material});
  return world;
}

ScannerProfile exactProfile() {
  ScannerProfile profile;
  profile.beams = 181;
  profile.angle_min = radians(-90.0);
  profile.angle_max = radians(90.0);
  profile.resolution = 0.0;
  profile.noise.sigma = 1e-6;
  return profile;
}

// Many beams over a narrow fan, so that each of them meets the wall alike.
ScannerProfile fan(const scan::NoiseModel& noise) {
  ScannerProfile profile = exactProfile();
  profile.beams = 40001;
  profile.angle_min = -1e-4;
  profile.angle_max = 1e-4;
  profile.noise = noise;
  return profile;
}

Scanner::PoseAt standing(const Pose2& pose = {}) {
  return [pose](std::int64_t) { return pose; };
}

struct Statistics {
  double mean = 0.0;
  double variance = 0.0;
};

Statistics of(const std::vector<double>& values) {
  Statistics result;
  const auto count = static_cast<double>(values.size());
  result.mean = std::accumulate(values.begin(), values.end(), 0.0) / count;
  for (const double v : values) result.variance += (v - result.mean) * (v - result.mean) / count;
  return result;
}

TEST(Scanner, MeasuresTheWallFromAMountedSensor) {
  Mounting mounting;
  mounting.x = 0.3;
  mounting.z = 0.5;
  Scanner scanner(exactProfile(), mounting, 1);
  const scan::Scan scan = scanner.sweep(wallAhead(4.0), 0, standing(Pose2(1.0, 0.0, radians(20))));
  ASSERT_EQ(scan.beams(), 181u);
  const double distance = 4.0 - 1.0 - 0.3 * std::cos(radians(20));
  for (const double bearing : {-60.0, 0.0, 30.0}) {
    const auto beam = static_cast<std::size_t>(std::lround(bearing) + 90);
    EXPECT_NEAR(scan.ranges()[beam], distance / std::cos(radians(bearing + 20.0)), 1e-4);
  }
  EXPECT_EQ(scan.kinds().back(), scan::ReturnKind::kNothing) << "that beam goes along the wall";
  EXPECT_NEAR(scan.rangeVariances()[90], 1e-12, 1e-15);
}

TEST(Scanner, TakesEachBeamAtItsOwnTime) {
  ScannerProfile profile = exactProfile();
  profile.revolution = 0.2;
  profile.rate = 5.0;
  Mounting mounting;
  mounting.x = 0.2;
  mounting.y = -0.1;
  mounting.yaw = 0.4;
  mounting.z = 1.0;
  const Eigen::Vector3d velocity(0.8, 0.0, 1.5);
  const Pose2 start(0.5, 1.0, -0.7);
  const std::int64_t stamp = 3'000'000'000;
  const auto pose = [&](std::int64_t time) {
    return start * Pose2::exp(1e-9 * static_cast<double>(time - stamp) * velocity);
  };
  Scanner scanner(profile, mounting, 1);
  scan::Scan scan = scanner.sweep(wallAhead(4.0), stamp, pose);
  EXPECT_EQ(scan.stamp, stamp);
  const Pose2 T_base_sensor(mounting.x, mounting.y, mounting.yaw);
  const Pose2 T_start_end = Pose2::exp(profile.sweepDuration() * velocity);
  scan.setSensorMotion(motion::sweepMotion(*scan.geometry(), T_start_end, T_base_sensor));
  int seen = 0;
  for (std::size_t i = 0; i < scan.beams(); ++i) {
    if (!scan.isValid(i)) continue;
    EXPECT_NEAR((start * T_base_sensor * scan.point(i)).x(), 4.0, 1e-4);
    ++seen;
  }
  EXPECT_GT(seen, 100);
}

TEST(Scanner, SortsReturnsAsRep117Asks) {
  const auto kindAt = [](double distance) {
    Scanner scanner(exactProfile(), {}, 1);
    const scan::Scan scan = scanner.sweep(wallAhead(distance), 0, standing());
    return std::make_pair(scan.kinds()[90], scan.ranges()[90]);
  };
  EXPECT_EQ(kindAt(0.05).first, scan::ReturnKind::kTooNear);
  EXPECT_EQ(kindAt(0.05).second, -std::numeric_limits<double>::infinity());
  EXPECT_EQ(kindAt(5.0).first, scan::ReturnKind::kValid);
  EXPECT_EQ(kindAt(31.0).first, scan::ReturnKind::kNothing);
}

TEST(Scanner, LosesTheAskedShareOfItsBeams) {
  ScannerProfile profile = fan({});
  profile.dropout = 0.05;
  Scanner scanner(profile, {}, 4);
  const scan::Scan scan = scanner.sweep(wallAhead(5.0), 0, standing());
  const auto lost =
      std::count(scan.kinds().begin(), scan.kinds().end(), scan::ReturnKind::kInvalid);
  EXPECT_NEAR(static_cast<double>(lost) / 40001.0, 0.05, 0.004);
}

TEST(ScannerNoise, ConstantAndProportionalAreGaussianAlongTheBeam) {
  scan::NoiseModel noise;
  noise.sigma = 0.02;
  for (const double growth : {0.0, 0.01}) {
    noise.kind = growth > 0.0 ? scan::NoiseKind::kProportional : scan::NoiseKind::kConstant;
    noise.sigma_per_metre = growth;
    Scanner scanner(fan(noise), {}, 2);
    const auto statistics = of(scanner.sweep(wallAhead(5.0), 0, standing()).ranges());
    const double expected = noise.rangeVariance(5.0);
    EXPECT_NEAR(statistics.mean, 5.0, 5e-4);
    EXPECT_NEAR(statistics.variance, expected, 0.03 * expected);
  }
}

TEST(ScannerNoise, UniformRoundsToStepsAndSpreadsInAngle) {
  scan::NoiseModel noise;
  noise.kind = scan::NoiseKind::kUniform;
  noise.range_half_width = 0.025;
  noise.angle_half_width = radians(0.25);
  ScannerProfile profile = fan(noise);
  profile.angle_min = radians(-60.0);  // of many different ranges
  profile.angle_max = radians(60.0);
  Scanner scanner(profile, {}, 3);
  const scan::Scan scan = scanner.sweep(wallAhead(5.0), 0, standing());
  std::vector<double> across, along;
  for (std::size_t i = 0; i < scan.beams(); ++i) {
    const double steps = scan.ranges()[i] / 0.05;
    ASSERT_NEAR(steps, std::round(steps), 1e-9);
    const double angle = scan.geometry()->angles()[i];
    along.push_back((scan.ranges()[i] - 5.0 / std::cos(angle)));
    if (std::abs(angle) > radians(50.0)) across.push_back(along.back());
  }
  EXPECT_NEAR(of(along).mean, 0.0, 2e-3);
  // At an angle of incidence β, the angle error adds r tan β Δα to the error of rounding.
  double expected = 0.0;
  for (int i = 0; i < 1000; ++i) {
    const double beta = radians(50.0 + 0.01 * (i + 0.5));
    const double lever = 5.0 / std::cos(beta) * std::tan(beta);
    expected += (noise.rangeVariance(0.0) + lever * lever * noise.angularVariance()) / 1000.0;
  }
  EXPECT_NEAR(of(across).variance, expected, 0.03 * expected);
}

TEST(ScannerNoise, IsotropicSpreadsPointsAcrossAWallAlikeAtAnyIncidence) {
  scan::NoiseModel noise;
  noise.kind = scan::NoiseKind::kIsotropic;
  noise.sigma = 0.05;
  for (const double heading : {0.0, 30.0, 60.0}) {
    Scanner scanner(fan(noise), {}, 5);
    const Pose2 pose(0.0, 0.0, radians(heading));
    const scan::Scan scan = scanner.sweep(wallAhead(3.0), 0, standing(pose));
    std::vector<double> distances;
    for (std::size_t i = 0; i < scan.beams(); ++i) distances.push_back((pose * scan.point(i)).x());
    EXPECT_NEAR(of(distances).variance, 0.05 * 0.05, 0.04 * 0.05 * 0.05) << heading;
  }
}

TEST(ScannerNoise, IntensityDrivenGrowsAsTheLightFades) {
  scan::NoiseModel noise;
  noise.kind = scan::NoiseKind::kIntensity;
  noise.sigma = 0.005;
  noise.intensity_sigma = 10.0;
  ScannerProfile profile = fan(noise);
  profile.intensity = 1000.0;
  for (const double reflectivity : {0.9, 0.2}) {
    Scanner scanner(profile, {}, 6);
    const scan::Scan scan = scanner.sweep(wallAhead(10.0, reflectivity), 0, standing());
    EXPECT_NEAR(scan.intensities()[20000], 500.0 * reflectivity, 1.0);
    const double expected = noise.rangeVariance(10.0, 500.0 * reflectivity);
    EXPECT_NEAR(of(scan.ranges()).variance, expected, 0.03 * expected);
  }
}

TEST(ScannerNoise, ReportedRangesAreMultiplesOfTheResolution) {
  ScannerProfile profile = exactProfile();
  profile.resolution = 0.01;
  Scanner scanner(profile, {}, 7);
  const scan::Scan scan = scanner.sweep(wallAhead(3.0), 0, standing());
  for (std::size_t i = 10; i < 170; ++i) {
    EXPECT_NEAR(scan.ranges()[i] / 0.01, std::round(scan.ranges()[i] / 0.01), 1e-6);
  }
}

TEST(ScannerIntensity, FallsWithRangeAndIncidenceAndRisesWithReflectivity) {
  ScannerProfile profile = exactProfile();
  profile.intensity = 1000.0;
  const auto intensities = [&](double distance, double reflectivity) {
    Scanner scanner(profile, {}, 8);
    return scanner.sweep(wallAhead(distance, reflectivity), 0, standing()).intensities();
  };
  EXPECT_NEAR(intensities(10.0, 0.5)[90], 250.0, 0.1) << "half at the half range";
  EXPECT_NEAR(intensities(1.0, 0.5)[90], 1000.0 * 0.5 / 1.01, 0.1);
  EXPECT_NEAR(intensities(1.0, 0.5)[150], 1000.0 * 0.5 * 0.5 / 1.04, 0.1) << "at 60 degrees";
  EXPECT_EQ(intensities(40.0, 0.5)[90], 0.0) << "out of reach";
  profile.intensity = 0.0;
  EXPECT_TRUE(intensities(1.0, 0.5).empty());
}

TEST(ScannerMounting, LookingDownMeetsTheFloor) {
  world::World world;
  world.add(world::WorldPlate{{}, 0.0, 0});
  Mounting mounting;
  mounting.z = 1.2;
  mounting.pitch = radians(10.0);
  Scanner scanner(exactProfile(), mounting, 1);
  const scan::Scan scan = scanner.sweep(world, 0, standing());
  EXPECT_NEAR(scan.ranges()[90], 6.91, 0.005);
  EXPECT_NEAR(scan.ranges()[120], 1.2 / (std::sin(radians(10.0)) * std::cos(radians(30.0))), 1e-4);
}

TEST(ScannerMounting, UpsideDownScansTheOtherWayRound) {
  world::World world = wallAhead(5.0);
  world.add(world::WorldSegment{{{-50.0, 2.0}, {4.9, 2.0}}, 0.0, 2.0, 0});
  Mounting mounting;
  mounting.z = 1.0;
  Scanner upright(exactProfile(), mounting, 1);
  mounting.roll = geometry::kPi;
  Scanner overhead(exactProfile(), mounting, 1);
  const scan::Scan left = upright.sweep(world, 0, standing());
  const scan::Scan right = overhead.sweep(world, 0, standing());
  for (std::size_t i = 20; i < 161; ++i)
    EXPECT_NEAR(left.ranges()[i], right.ranges()[180 - i], 1e-4);
  EXPECT_NEAR(left.ranges()[160], 2.0 / std::sin(radians(70.0)), 1e-4);
}

TEST(Scanner, SameSeedSameScanToTheBit) {
  const auto ranges = [](std::uint64_t seed) {
    Scanner scanner(ScannerProfile{}, {}, seed);
    scanner.sweep(wallAhead(5.0), 0, standing());
    return scanner.sweep(wallAhead(5.0), 1'000'000, standing()).ranges();
  };
  EXPECT_EQ(ranges(1), ranges(1));
  EXPECT_NE(ranges(1), ranges(2));
}

TEST(ScannerProfile, ShippedFilesLoad) {
  const std::string folder = SIGHTLINE_SOURCE_DIR "/config/sensors/";
  const auto hokuyo = ScannerProfile::readFile(folder + "utm30lx.yaml");
  EXPECT_EQ(hokuyo.geometry()->beams(), 1081u);
  EXPECT_NEAR(hokuyo.geometry()->angleIncrement(), radians(0.25), 1e-9);
  EXPECT_NEAR(hokuyo.geometry()->timeOffsets().back(), 0.75 * 0.025, 1e-12);
  const auto pls = ScannerProfile::readFile(folder + "sick_pls200.yaml");
  EXPECT_EQ(pls.geometry()->beams(), 361u);
  EXPECT_NEAR(std::sqrt(pls.noise.rangeVariance(3.0)), 0.05 / std::sqrt(12.0), 1e-12);
  EXPECT_NEAR(pls.noise.angle_half_width, radians(0.25), 1e-9);
  EXPECT_EQ(ScannerProfile::readFile(folder + "sick_lms200.yaml").geometry()->beams(), 361u);
}

TEST(ScannerProfile, RefusesWhatDoesNotFit) {
  const auto errorOf = [](auto change) -> std::string {
    ScannerProfile profile;
    change(profile);
    try {
      Scanner(profile, {}, 1);
    } catch (const config::Error& error) {
      return error.what();
    }
    return "no error";
  };
  using testing::HasSubstr;
  EXPECT_THAT(errorOf([](auto& p) { p.range_min = 40.0; }), HasSubstr("range_min"));
  EXPECT_THAT(errorOf([](auto& p) { p.beams = 0; }), HasSubstr("beams: 0 is outside"));
  EXPECT_THAT(errorOf([](auto& p) { p.angle_max = p.angle_min; }), HasSubstr("angle_max"));
  EXPECT_THAT(errorOf([](auto& p) { p.angle_max = p.angle_min + 7.0; }), HasSubstr("angle_max"));
  EXPECT_THAT(errorOf([](auto& p) { p.rate = 60.0; }), HasSubstr("revolution: a sweep of 0.0187"));
  EXPECT_THAT(errorOf([](auto& p) { p.dropout = 2.0; }), HasSubstr("dropout: 2 is outside [0, 1]"));
}

}  // namespace
}  // namespace sightline::simulation
