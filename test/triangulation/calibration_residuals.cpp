#include "sightline/triangulation/calibration_residuals.h"

#include <cmath>

#include "property.h"
#include "sightline/triangulation/linear_start.h"
#include "sightline/triangulation/projection_geometry.h"

namespace sightline::triangulation {
namespace {

struct TrueSensor {
  Intrinsics intrinsics;
  ScanOrigin origin;
};

// Within some percent of the nominal one, the origin anywhere on the head.
TrueSensor anySensor() {
  TrueSensor sensor;
  sensor.intrinsics.focal_length *= 1.0 + *test::within(0.2);
  sensor.intrinsics.baseline *= 1.0 + *test::within(0.2);
  sensor.intrinsics.vergence *= 1.0 + *test::within(0.2);
  sensor.intrinsics.lens_distance *= 1.0 + *test::within(0.5);
  sensor.origin = {*test::within(0.1), *test::within(0.1), *test::within(0.1)};
  return sensor;
}

std::vector<ImageReading> exactImages(const TrueSensor& sensor) {
  const ProjectionGeometry geometry(sensor.intrinsics);
  std::vector<ImageReading> images;
  for (const double depth : {0.4, 0.6, 1.0, 1.5, 2.5}) {
    for (double angle = -0.35; angle < 0.36; angle += 0.07) {
      const double theta = angle + sensor.origin.projected_vergence;
      const double range = (depth - sensor.origin.x) / std::cos(theta);
      images.push_back({depth, angle, geometry.imagePosition(range, theta), 1e-6 * (1.0 + range)});
    }
  }
  return images;
}

std::vector<StripeEdge> exactEdges(const ScanOrigin& origin) {
  std::vector<StripeEdge> edges;
  for (const double depth : {0.4, 0.7, 1.1}) {
    for (double y = -0.15; y < 0.16; y += 0.05) {
      const double angle = std::atan2(y - origin.y, depth - origin.x);
      edges.push_back({depth, y, angle - origin.projected_vergence, 1e-4});
    }
  }
  return edges;
}

CalibrationResiduals exactResiduals(const TrueSensor& sensor) {
  return {exactImages(sensor), exactEdges(sensor.origin), sensor.intrinsics.detector_length};
}

RC_GTEST_PROP(CalibrationResiduals, VanishAtTheTruth, ()) {
  const TrueSensor sensor = anySensor();
  const auto residuals = exactResiduals(sensor);
  RC_ASSERT(residuals.at(toVector(sensor.intrinsics, sensor.origin)).cwiseAbs().maxCoeff() < 1e-8);
}

RC_GTEST_PROP(CalibrationResiduals, HaveTheJacobianOfTheirDifferences, ()) {
  const TrueSensor sensor = anySensor();
  const auto residuals = exactResiduals(sensor);
  ParameterVector at = toVector(sensor.intrinsics, sensor.origin);
  at *= 1.01;
  const auto jacobian = residuals.jacobianAt(at);
  for (int i = 0; i < kParameterCount; ++i) {
    const double step = 1e-6;
    ParameterVector ahead = at;
    ParameterVector behind = at;
    ahead[i] += step;
    behind[i] -= step;
    const Eigen::VectorXd numeric = (residuals.at(ahead) - residuals.at(behind)) / (2.0 * step);
    const double size = jacobian.col(i).cwiseAbs().maxCoeff();
    RC_ASSERT((jacobian.col(i) - numeric).cwiseAbs().maxCoeff() < 1e-5 * size);
  }
}

TEST(CalibrationResiduals, OfFlatTargetsSayNothingOfTheLateralOrigin) {
  const TrueSensor sensor;
  const CalibrationResiduals residuals(exactImages(sensor), {}, 0.010);
  EXPECT_EQ(
      residuals.jacobianAt(toVector(sensor.intrinsics, sensor.origin)).col(5).cwiseAbs().maxCoeff(),
      0.0);
}

RC_GTEST_PROP(LinearStart, IsExactWithoutNoise, ()) {
  const TrueSensor sensor = anySensor();
  const auto origin = startOrigin(exactEdges(sensor.origin));
  RC_ASSERT(origin.has_value());
  RC_ASSERT(std::abs(origin->x - sensor.origin.x) < 1e-10);
  RC_ASSERT(std::abs(origin->y - sensor.origin.y) < 1e-10);
  RC_ASSERT(std::abs(origin->projected_vergence - sensor.origin.projected_vergence) < 1e-10);
  const auto intrinsics = startIntrinsics(exactImages(sensor), sensor.origin, 0.010);
  RC_ASSERT(intrinsics.has_value());
  const ParameterVector error =
      toVector(*intrinsics, *origin) - toVector(sensor.intrinsics, sensor.origin);
  RC_ASSERT(error.cwiseAbs().maxCoeff() < 1e-8);
}

TEST(LinearStart, HasNoAnswerWithoutEnoughToGoBy) {
  const TrueSensor sensor;
  auto edges = exactEdges(sensor.origin);
  edges.resize(2);
  EXPECT_FALSE(startOrigin(edges));
  EXPECT_FALSE(startOrigin({}));
  auto images = exactImages(sensor);
  images.resize(5);
  EXPECT_FALSE(startIntrinsics(images, sensor.origin, 0.010));
  EXPECT_FALSE(startIntrinsics({}, sensor.origin, 0.010));
}

TEST(ParameterVector, HoldsEveryParameterOnce) {
  ParameterVector numbers;
  numbers << 1, 2, 3, 4, 5, 6, 7;
  Intrinsics intrinsics;
  ScanOrigin origin;
  fromVector(numbers, intrinsics, origin);
  EXPECT_EQ(toVector(intrinsics, origin), numbers);
  EXPECT_EQ(intrinsics.detector_length, Intrinsics().detector_length);
}

}  // namespace
}  // namespace sightline::triangulation
