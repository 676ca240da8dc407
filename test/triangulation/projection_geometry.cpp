#include "sightline/triangulation/projection_geometry.h"

#include <cmath>

#include <gtest/gtest.h>

#include "numeric_jacobian.h"
#include "property.h"

namespace sightline::triangulation {
namespace {

// The equations as printed, in the coordinates of the paper: θ from the z axis, clockwise.
struct Printed {
  double f, d, gamma, s;

  double z(double p, double theta) const {  // eqs 6-9
    const double q = 1.0 + f / p * std::tan(gamma);
    const double a1 = f * d / p * std::cos(theta) * std::cos(theta);
    const double a2 = 0.5 * d * std::sin(2.0 * theta);
    const double a3 = -s * std::cos(theta);
    const double g1 = 1.0 + (std::tan(theta) - p / f) * std::tan(gamma);
    return (a1 * g1 + a2 + a3 / std::cos(gamma)) / q;
  }
  double p(double z, double theta) const {  // eq. 10
    const double c = std::cos(theta);
    return f * (z * std::tan(gamma) - d * c * c * (1.0 + std::tan(theta) * std::tan(gamma))) /
           (d * c * (std::sin(theta) - c * std::tan(gamma)) - s * c / std::cos(gamma) - z);
  }
};

struct Sight {
  Intrinsics intrinsics;
  double range, angle;
};

double between(double least, double most) {
  return 0.5 * (least + most) + *test::within(0.5 * (most - least));
}

Sight anySight() {
  Sight sight;
  sight.intrinsics.focal_length = between(0.02, 0.1);
  sight.intrinsics.baseline = between(0.03, 0.2);
  sight.intrinsics.vergence = between(0.02, 0.3);
  sight.intrinsics.lens_distance = between(0.0, 0.05);
  sight.range = between(0.3, 3.0);
  sight.angle = between(-0.4, 0.4);
  return sight;
}

Printed printed(const Intrinsics& own) {
  return {own.focal_length, own.baseline, own.vergence, own.lens_distance};
}

RC_GTEST_PROP(ProjectionGeometry, AgreesWithThePrintedEquations, ()) {
  const Sight sight = anySight();
  const ProjectionGeometry geometry(sight.intrinsics);
  const Printed paper = printed(sight.intrinsics);
  const double p = geometry.imagePosition(sight.range, sight.angle);
  const double z = sight.range * std::cos(sight.angle);
  RC_ASSERT(std::abs(paper.p(z, -sight.angle) - p) < 1e-12);
  RC_ASSERT(std::abs(geometry.depth(p, sight.angle) - z) < 1e-9);
  if (std::abs(p) > 1e-5) RC_ASSERT(std::abs(paper.z(p, -sight.angle) - z) < 1e-7);
}

// Eqs 3 to 5, with a = s sin φ / cos(θ − γ − φ).
RC_GTEST_PROP(ProjectionGeometry, TheLightGoesStraightThroughTheLens, ()) {
  const Sight sight = anySight();
  const auto& [f, d, gamma, s, length] = sight.intrinsics;
  const ProjectionGeometry geometry(sight.intrinsics);
  const double theta = -sight.angle;
  const double phi = std::atan(geometry.imagePosition(sight.range, sight.angle) / f);
  const double a = s * std::sin(phi) / std::cos(theta - gamma - phi);
  const double x = sight.range * std::sin(theta);
  const double z = sight.range * std::cos(theta);
  RC_ASSERT(std::abs((x - d + a) / z - std::tan(theta - phi - gamma)) < 1e-9);
  const Eigen::Vector2d lens = geometry.lens(sight.angle).centre;
  RC_ASSERT(std::abs(lens.x() + s * std::cos(theta - gamma)) < 1e-12);
  RC_ASSERT(std::abs(-lens.y() - (d - s * std::sin(theta - gamma))) < 1e-12);
}

RC_GTEST_PROP(ProjectionGeometry, APointOnTheBeamHasTheImageOfItsRange, ()) {
  const Sight sight = anySight();
  const ProjectionGeometry geometry(sight.intrinsics);
  const double p = geometry.imagePosition(sight.range, sight.angle);
  const Eigen::Vector2d point = geometry.point(p, sight.angle);
  RC_ASSERT(
      (point - sight.range * Eigen::Vector2d(std::cos(sight.angle), std::sin(sight.angle))).norm() <
      1e-9);
  RC_ASSERT(std::abs(geometry.imagePosition(point, geometry.lens(sight.angle)) - p) < 1e-12);
}

RC_GTEST_PROP(ProjectionGeometry, JacobiansAreThoseOfTheFunctions, ()) {
  const Sight sight = anySight();
  const ProjectionGeometry geometry(sight.intrinsics);
  const Eigen::Vector2d seen(sight.range, sight.angle);
  const auto image = [&](const Eigen::Vector2d& at) {
    return Eigen::Matrix<double, 1, 1>(geometry.imagePosition(at[0], at[1]));
  };
  const Eigen::RowVector2d by_sight = test::numericJacobian<1, 2>(image, seen);
  RC_ASSERT((by_sight - geometry.imagePositionJacobian(seen[0], seen[1])).norm() < 1e-8);

  const auto by_intrinsics = [&](const Eigen::Vector4d& at) {
    const ProjectionGeometry other({at[0], at[1], at[2], at[3], 0.01});
    return Eigen::Matrix<double, 1, 1>(other.imagePosition(sight.range, sight.angle));
  };
  const auto& [f, d, gamma, s, length] = sight.intrinsics;
  const Eigen::RowVector4d expected =
      test::numericJacobian<1, 4>(by_intrinsics, Eigen::Vector4d(f, d, gamma, s + 1e-5));
  RC_ASSERT((expected - ProjectionGeometry({f, d, gamma, s + 1e-5, 0.01})
                            .intrinsicsJacobian(sight.range, sight.angle))
                .norm() < 1e-7);

  const double p = geometry.imagePosition(sight.range, sight.angle);
  const auto point = [&](const Eigen::Vector2d& at) -> Eigen::Vector2d {
    return geometry.point(at[0], at[1]);
  };
  const Eigen::Matrix2d jacobian = geometry.pointJacobian(p, sight.angle);
  const auto minus = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) -> Eigen::Vector2d {
    return a - b;
  };
  const Eigen::Matrix2d numeric =
      test::numericJacobian<2, 2>(point, Eigen::Vector2d(p, sight.angle), minus, 1e-8);
  RC_ASSERT((jacobian - numeric).norm() < 1e-5 * jacobian.norm());
  RC_ASSERT(geometry.rangeGain(p, sight.angle) < 0.0);
  RC_ASSERT(std::abs(geometry.depthGain(p, sight.angle) - jacobian(0, 0)) <
            1e-9 * std::abs(jacobian(0, 0)));
}

TEST(ProjectionGeometry, RefusesWhatNoSensorCanBe) {
  const auto faultOf = [](const Intrinsics& intrinsics) -> std::string {
    try {
      ProjectionGeometry geometry(intrinsics);
    } catch (const config::Error& error) {
      return error.key();
    }
    return "none";
  };
  Intrinsics intrinsics;
  EXPECT_EQ(faultOf(intrinsics), "none");
  intrinsics.focal_length = 0.0;
  EXPECT_EQ(faultOf(intrinsics), "focal_length");
  intrinsics = {};
  intrinsics.focal_length = -0.05;
  EXPECT_EQ(faultOf(intrinsics), "focal_length");
  intrinsics = {};
  intrinsics.vergence = geometry::radians(45.0);
  EXPECT_EQ(faultOf(intrinsics), "vergence");
  intrinsics = {};
  intrinsics.baseline = std::nan("");
  EXPECT_EQ(faultOf(intrinsics), "baseline");
}

// pears table 1: the whole detector serves 0.4 m to 2.5 m.
TEST(ProjectionGeometry, TheDefaultsCoverTheSpecifiedDepths) {
  const ProjectionGeometry geometry(Intrinsics{});
  EXPECT_NEAR(geometry.imagePosition(0.4, 0.0), 4.27e-3, 1e-5);
  EXPECT_NEAR(geometry.imagePosition(2.5, 0.0), -4.27e-3, 1e-5);
}

}  // namespace
}  // namespace sightline::triangulation
