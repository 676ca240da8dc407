#include "sightline/tracking/motion_response.h"

#include <gtest/gtest.h>

#include "monte_carlo.h"
#include "sightline/fitting/line_fit.h"
#include "sightline/tracking/gated_wall.h"

namespace sightline::tracking {
namespace {

constexpr int kPoints = 60;

// A wall 2 m ahead, seen from the second to the last but one quarter of a sweep.
std::vector<BeamPoint> wall() {
  std::vector<BeamPoint> points;
  for (int i = 0; i < kPoints; ++i) {
    const double ratio = static_cast<double>(i) / (kPoints - 1);
    BeamPoint point;
    point.position = {2.0, 3.0 * ratio - 1.0};
    point.covariance = 1e-6 * Eigen::Matrix2d::Identity();
    point.sweep_ratio = 0.25 + 0.5 * ratio;
    points.push_back(point);
  }
  return points;
}

std::vector<const BeamPoint*> pointersTo(const std::vector<BeamPoint>& points) {
  std::vector<const BeamPoint*> pointers;
  for (const BeamPoint& point : points) pointers.push_back(&point);
  return pointers;
}

Eigen::Matrix3d walkCovariance() {
  Eigen::Matrix3d walk;
  walk << 4e-6, 1e-6, 2e-6, 1e-6, 2e-6, 0.0, 2e-6, 0.0, 9e-6;
  return walk;
}

// A walk of the base over a sweep, in the order of time.
class Walk {
 public:
  explicit Walk(test::Gauss& gauss) : gauss_(gauss) {}

  const Eigen::Vector3d& at(double ratio) {
    for (; knot_ < kKnots && (knot_ + 1.0) / kKnots <= ratio; ++knot_) {
      errors_.segment<3>(3 * knot_) = advance((knot_ + 1.0) / kKnots);
    }
    return advance(ratio);
  }
  const SweepError& atKnots() const { return errors_; }

 private:
  const Eigen::Vector3d& advance(double ratio) {
    twist_ += std::sqrt(ratio - ratio_) * gauss_(walkCovariance());
    ratio_ = ratio;
    return twist_;
  }

  test::Gauss& gauss_;
  Eigen::Vector3d twist_ = Eigen::Vector3d::Zero();
  double ratio_ = 0.0;
  int knot_ = 0;
  SweepError errors_ = SweepError::Zero();
};

// Points as a base sees them that has walked, and where the walk was at the knots.
std::vector<BeamPoint> walked(test::Gauss& gauss, SweepError& errors) {
  std::vector<BeamPoint> points = wall();
  Walk walk(gauss);
  for (BeamPoint& point : points) {
    const Eigen::Vector3d twist = walk.at(point.sweep_ratio);
    const Eigen::Vector2d across(-point.position.y(), point.position.x());
    point.position += twist.head<2>() + twist[2] * across;
  }
  walk.at(1.0);
  errors = walk.atKnots();
  return points;
}

TEST(MotionResponseStatistics, WalkMovesTheLineByItsKnotsAndStraysBetweenThem) {
  const auto still = wall();
  const geometry::PolarLine line{2.0, 0.0, Eigen::Matrix2d::Identity()};
  const MotionResponse response(pointersTo(still), line, walkCovariance());
  test::Gauss gauss(3);
  test::Moments<2> all;
  test::Moments<2> strayed;
  for (int draw = 0; draw < 20000; ++draw) {
    SweepError errors;
    const auto points = walked(gauss, errors);
    const auto fit = fitting::refineLine(toFitPoints(pointersTo(points)), line);
    ASSERT_TRUE(fit);
    const Eigen::Vector2d moved(fit->line.rho - line.rho, fit->line.phi);
    all.add(moved);
    strayed.add(moved - response.jacobian() * errors);
  }
  const SweepErrorCovariance at_knots =
      SweepNoise{Eigen::Matrix3d::Zero(), walkCovariance()}.atKnots();
  const Eigen::Matrix2d of_knots = response.jacobian() * at_knots * response.jacobian().transpose();
  const Eigen::Matrix2d stray = response.strayCovariance();
  EXPECT_LT(test::relativeError<2>(strayed.covariance(), stray), 0.04);
  EXPECT_LT(test::relativeError<2>(all.covariance(), of_knots + stray), 0.04);
}

TEST(MotionResponse, WithoutAWalkNothingStrays) {
  const auto points = wall();
  const MotionResponse response(pointersTo(points), {2.0, 0.0, Eigen::Matrix2d::Identity()},
                                Eigen::Matrix3d::Zero());
  EXPECT_TRUE(response.strayCovariance().isZero(0.0));
}

}  // namespace
}  // namespace sightline::tracking
