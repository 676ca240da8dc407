#include "sightline/targets/sensor_model.h"

#include <cmath>
#include <memory>

#include <gtest/gtest.h>

#include "config_error.h"
#include "sightline/config/yaml_writer.h"

namespace sightline::targets {
namespace {

constexpr double kTapeInch = 0.0254;

// Sum over fine steps from −π to π.
template <class Density>
double integral(const Density& density) {
  constexpr int kSteps = 200000;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    sum += density(geometry::kPi * (2.0 * (i + 0.5) / kSteps - 1.0));
  }
  return sum * 2.0 * geometry::kPi / kSteps;
}

TEST(SensorModel, DetectionFollowsTheFormula) {
  SensorModelConfig config;
  config.detection.beam_spacing = geometry::radians(0.25);
  config.detection.range_max = 30.0;
  const SensorModel fine(config);
  EXPECT_NEAR(kneeRange(config.detection), 7.451, 1e-3);
  EXPECT_NEAR(fine.detection(Polar{7.0, 0.0}), 0.79, 1e-12);
  EXPECT_NEAR(fine.detection(Polar{14.902, 0.0}), 0.395, 1e-4);
  const SensorModel coarse;
  EXPECT_NEAR(kneeRange(coarse.config().detection), 1.863, 1e-3);
  EXPECT_NEAR(coarse.detection(Polar{4.0, 0.5}),
              0.79 * 1.28 * kTapeInch / (4.0 * geometry::radians(1.0)), 1e-12);
}

TEST(SensorModel, NothingIsDetectedOutOfView) {
  const SensorModel model;
  EXPECT_EQ(model.detection(Polar{5.001, 0.0}), 0.0);
  EXPECT_EQ(model.detection(Polar{1.0, 2.36}), 0.0);
  EXPECT_GT(model.detection(Polar{1.0, -2.35}), 0.0);
  const geometry::Pose2 pose(1.0, 2.0, geometry::kPi);
  EXPECT_GT(model.detection(Eigen::Vector2d(-1.0, 2.0), pose), 0.0);
  EXPECT_EQ(model.detection(Eigen::Vector2d(3.0, 2.0), pose), 0.0);
}

TEST(SensorModel, MeasurementDensityIntegratesToOne) {
  for (const double sigma : {0.01, 0.039, 0.5, 1.0}) {
    SensorModelConfig config;
    config.bearing.sigma = sigma;
    const SensorModel model(config);
    const auto density = [&](double z) { return model.likelihood(z, Polar{1.0, 3.1}); };
    EXPECT_NEAR(integral(density), 1.0, 1e-6) << sigma;
  }
}

TEST(SensorModel, ClutterIntegratesToItsMeanWithThePapersShareInThePeaks) {
  const SensorModel model;
  const geometry::Pose2 pose;
  EXPECT_NEAR(integral([&](double z) { return model.clutter(z, pose); }), 0.5319, 1e-5);
  EXPECT_NEAR(model.clutter(0.0, pose), 0.0818, 5e-5);
  EXPECT_NEAR(model.clutter(1.5, pose) - model.clutter(0.0, pose), 0.1164, 5e-5);
  EXPECT_EQ(model.clutter(2.5, pose), 0.0);
  const double in_peaks = integral([&](double z) {
    return std::abs(std::abs(z) - 0.5 * geometry::kPi) <= 0.1 * geometry::kPi
               ? model.clutter(z, pose)
               : 0.0;
  });
  EXPECT_NEAR(in_peaks / 0.5319, 0.468, 5e-4);
}

TEST(SensorModel, TableTakesTheFormulasPlace) {
  SensorModelConfig config;
  config.detection.table = DetectionTable{{1.0, 2.0, 5.0}, {-1.0, 0.0, 1.0}, {0.1, 0.2, 0.3, 0.4}};
  const SensorModel model(config);
  EXPECT_EQ(model.detection(Polar{0.9, 0.5}), 0.0);
  EXPECT_EQ(model.detection(Polar{1.5, -0.5}), 0.1);
  EXPECT_EQ(model.detection(Polar{1.5, 0.0}), 0.2);
  EXPECT_EQ(model.detection(Polar{5.0, 1.0}), 0.4);
  EXPECT_EQ(model.detection(Polar{3.0, 1.5}), 0.0);
}

TEST(SensorModel, WallsHideTargets) {
  world::World world;
  world.add(world::WorldSegment{geometry::Segment{{2.0, -1.0}, {2.0, 1.0}}});
  const SensorModel model({}, std::make_shared<WorldSight>(world, 0.3));
  EXPECT_EQ(model.detection(Eigen::Vector2d(3.0, 0.0), {}), 0.0);
  EXPECT_GT(model.detection(Eigen::Vector2d(1.5, 0.0), {}), 0.0);
  EXPECT_GT(model.detection(Eigen::Vector2d(2.05, 0.0), {}), 0.0);
  world::Occupancy grid{0.1, {0.0, -1.0}, 50, 20, std::vector<std::int8_t>(1000, 0)};
  for (std::size_t row = 0; row < 20; ++row)
    grid.cells[row * 50 + 20] = world::Occupancy::kOccupied;
  const SensorModel by_grid({}, std::make_shared<GridSight>(grid));
  EXPECT_EQ(by_grid.detection(Eigen::Vector2d(3.0, 0.0), {}), 0.0);
  EXPECT_GT(by_grid.detection(Eigen::Vector2d(1.5, 0.0), {}), 0.0);
  // The same cells, turned by a quarter about the map's origin.
  const GridSight turned(grid, {0.0, 0.0, 0.5 * geometry::kPi});
  EXPECT_FALSE(turned.isClear({0.0, 0.0}, {0.0, 3.0}));
  EXPECT_TRUE(turned.isClear({0.0, 0.0}, {3.0, 0.0}));
}

TEST(SensorModelConfig, SurvivesBeingWrittenAndRead) {
  SensorModelConfig config;
  config.bearing.distortion = DistortionConfig{{-0.5, 0.0, 0.5}, {0.01, 0.0, 0.03}};
  config.bearing.bias = 0.012345678901234567;
  config.detection.table = DetectionTable{{0.0, 1.0}, {-1.0, 1.0}, {0.25}};
  SensorModelConfig read;
  config::read(config::Node::parse(config::toYaml(config), "model.yaml"), read);
  EXPECT_EQ(read.bearing.bias, config.bearing.bias);
  ASSERT_TRUE(read.bearing.distortion.has_value());
  EXPECT_EQ(read.bearing.distortion->errors, config.bearing.distortion->errors);
  EXPECT_EQ(read.detection.table->probabilities, config.detection.table->probabilities);
}

TEST(SensorModelConfig, RefusesWhatDoesNotIntegrate) {
  SensorModelConfig camera;
  camera.field_of_view = {-0.6, 0.6};
  EXPECT_EQ(test::errorOf([&] { camera.check("camera.yaml"); }).key(), "clutter.peak_width");
  camera.clutter.uniform_share = 1.0;
  camera.check();
  SensorModelConfig spike;
  spike.clutter.peak_width = 0.0;
  EXPECT_EQ(test::errorOf([&] { spike.check(); }).key(), "clutter.peak_width");
}

TEST(SensorModelConfig, NamesWhatIsOutOfRange) {
  const auto keyOf = [](const auto& change) {
    SensorModelConfig config;
    change(config);
    return test::errorOf([&] { config.check("model.yaml"); }).key();
  };
  EXPECT_EQ(keyOf([](auto& c) { c.bearing.sigma = -0.1; }), "bearing.sigma");
  EXPECT_EQ(keyOf([](auto& c) { c.detection.false_negative = 1.2; }), "detection.false_negative");
  EXPECT_EQ(keyOf([](auto& c) { c.detection.range_min = 6.0; }), "detection.range_min");
  EXPECT_EQ(keyOf([](auto& c) { c.field_of_view = {1.0, -1.0}; }), "field_of_view");
  EXPECT_EQ(keyOf([](auto& c) {
              c.detection.table = DetectionTable{{1.0}, {0.0, 1.0}, {}};
            }),
            "detection.table.range_edges");
  EXPECT_EQ(keyOf([](auto& c) {
              c.detection.table = DetectionTable{{0.0, 1.0}, {0.0, 1.0}, {}};
            }),
            "detection.table.probabilities");
}

}  // namespace
}  // namespace sightline::targets
