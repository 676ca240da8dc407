// The laws of the group SE(2) and of its derivatives, for drawn poses: rotations of every size,
// nearly none and nearly half a turn among them.
#if __has_include(<rapidcheck/gtest.h>)

#include "sightline/geometry/pose2.h"

#include "numeric_jacobian.h"
#include "property.h"

namespace sightline::geometry {
namespace {

rc::Gen<double> turns() {
  return rc::gen::oneOf(
      test::within(kPi), test::within(1e-3), test::within(1e-9), rc::gen::just(0.0),
      rc::gen::map(test::within(1e-6), [](double d) { return d > 0.0 ? kPi - d : -kPi - d; }));
}

}  // namespace
}  // namespace sightline::geometry

namespace rc {

template <>
struct Arbitrary<sightline::geometry::Pose2> {
  static Gen<sightline::geometry::Pose2> arbitrary() {
    return gen::construct<sightline::geometry::Pose2>(
        sightline::test::within(20.0), sightline::test::within(20.0), sightline::geometry::turns());
  }
};

}  // namespace rc

namespace sightline::geometry {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

Vector3d minus(const Pose2& a, const Pose2& b) {
  return {a.x() - b.x(), a.y() - b.y(), wrapAngle(a.theta() - b.theta())};
}

void expectNear(const Pose2& a, const Pose2& b, double tolerance = 1e-11) {
  RC_ASSERT(minus(a, b).norm() < tolerance);
}

template <class Matrix>
void expectAlike(const Matrix& a, const Matrix& b, double tolerance = 1e-7) {
  RC_ASSERT((a - b).cwiseAbs().maxCoeff() < tolerance);
}

Vector3d drawTangent() {
  return {*test::within(20.0), *test::within(20.0), *turns()};
}

RC_GTEST_PROP(Pose2Laws, CompositionIsAssociative,
              (const Pose2& a, const Pose2& b, const Pose2& c)) {
  expectNear((a * b) * c, a * (b * c));
}

RC_GTEST_PROP(Pose2Laws, IdentityChangesNothing, (const Pose2& a)) {
  expectNear(a * Pose2(), a, 1e-300);
  expectNear(Pose2() * a, a, 1e-300);
}

RC_GTEST_PROP(Pose2Laws, InverseUndoesFromBothSides, (const Pose2& a)) {
  expectNear(a * a.inverse(), Pose2());
  expectNear(a.inverse() * a, Pose2());
  expectNear(a.inverse().inverse(), a);
}

RC_GTEST_PROP(Pose2Laws, ActsAsItComposes, (const Pose2& a, const Pose2& b)) {
  const Vector2d p(*test::within(20.0), *test::within(20.0));
  RC_ASSERT(((a * b) * p - a * (b * p)).norm() < 1e-11);
}

RC_GTEST_PROP(Pose2Laws, HeadingIsWrapped, (const Pose2& a, const Pose2& b)) {
  RC_ASSERT((a * b).theta() > -kPi);
  RC_ASSERT((a * b).theta() <= kPi);
}

RC_GTEST_PROP(Pose2Laws, BetweenLeadsFromOneToTheOther, (const Pose2& a, const Pose2& b)) {
  expectNear(a * between(a, b), b);
}

RC_GTEST_PROP(Pose2Laws, ExpUndoesLog, (const Pose2& a)) {
  expectNear(Pose2::exp(a.log()), a);
}

RC_GTEST_PROP(Pose2Laws, LogUndoesExp, ()) {
  const Vector3d tau = drawTangent();
  RC_PRE(std::abs(tau[2]) < kPi);
  RC_ASSERT((Pose2::exp(tau).log() - tau).norm() < 1e-10);
}

RC_GTEST_PROP(Pose2Laws, ExpOfTheNegativeIsTheInverse, ()) {
  const Vector3d tau = drawTangent();
  expectNear(Pose2::exp(-tau), Pose2::exp(tau).inverse());
}

RC_GTEST_PROP(Pose2Laws, ExpIsTheLimitOfManySmallSteps, ()) {
  const Vector3d tau = drawTangent();
  Pose2 pose = Pose2::exp(tau / 1024.0);
  for (int doubling = 0; doubling < 10; ++doubling) pose = pose * pose;
  expectNear(pose, Pose2::exp(tau), 1e-9);
}

RC_GTEST_PROP(Pose2Laws, AdjointCarriesATangentAcross, (const Pose2& X)) {
  const Vector3d tau = drawTangent();
  expectNear(X * Pose2::exp(tau) * X.inverse(), Pose2::exp(X.adjoint() * tau), 1e-10);
}

RC_GTEST_PROP(Pose2Laws, AdjointComposes, (const Pose2& a, const Pose2& b)) {
  expectAlike<Eigen::Matrix3d>((a * b).adjoint(), a.adjoint() * b.adjoint(), 1e-11);
  expectAlike<Eigen::Matrix3d>(a.inverse().adjoint() * a.adjoint(), Eigen::Matrix3d::Identity(),
                               1e-11);
}

RC_GTEST_PROP(Pose2Laws, ExpRightJacobianIsTheDerivative, ()) {
  const Vector3d tau = drawTangent();
  const auto step = [&](const Vector3d& at) {
    return between(Pose2::exp(tau), Pose2::exp(at)).log();
  };
  expectAlike<Eigen::Matrix3d>(expRightJacobian(tau), test::numericJacobian<3, 3>(step, tau));
}

RC_GTEST_PROP(Pose2Laws, LogRightJacobianIsTheDerivative, (const Pose2& X)) {
  // Half a turn away log jumps, and differences with it.
  RC_PRE(std::abs(X.theta()) < kPi - 1e-5);
  const auto log = [&](const Vector3d& delta) { return (X * Pose2::exp(delta)).log(); };
  expectAlike<Eigen::Matrix3d>(logRightJacobian(X.log()),
                               test::numericJacobian<3, 3>(log, Vector3d(Vector3d::Zero())), 1e-6);
}

RC_GTEST_PROP(Pose2Laws, RightJacobiansAreInverses, ()) {
  const Vector3d tau = drawTangent();
  expectAlike<Eigen::Matrix3d>(expRightJacobian(tau) * logRightJacobian(tau),
                               Eigen::Matrix3d::Identity(), 1e-11);
}

RC_GTEST_PROP(Pose2Laws, ComposeJacobiansAreTheDerivatives, (const Pose2& a, const Pose2& b)) {
  const auto by_first = [&](const Vector3d& at) { return Pose2(at) * b; };
  const auto by_second = [&](const Vector3d& at) { return a * Pose2(at); };
  expectAlike<Eigen::Matrix3d>(composeJacobianFirst(a, b),
                               test::numericJacobian<3, 3>(by_first, a.coordinates(), minus));
  expectAlike<Eigen::Matrix3d>(composeJacobianSecond(a),
                               test::numericJacobian<3, 3>(by_second, b.coordinates(), minus));
}

RC_GTEST_PROP(Pose2Laws, InverseJacobianIsTheDerivative, (const Pose2& a)) {
  const auto invert = [](const Vector3d& at) { return Pose2(at).inverse(); };
  expectAlike<Eigen::Matrix3d>(inverseJacobian(a),
                               test::numericJacobian<3, 3>(invert, a.coordinates(), minus));
}

RC_GTEST_PROP(Pose2Laws, ActJacobianIsTheDerivative, (const Pose2& a)) {
  const Vector2d p(*test::within(20.0), *test::within(20.0));
  const auto act = [&](const Vector3d& at) -> Vector2d { return Pose2(at) * p; };
  expectAlike<Eigen::Matrix<double, 2, 3>>(actJacobian(a, p),
                                           test::numericJacobian<2, 3>(act, a.coordinates()));
}

RC_GTEST_PROP(Pose2Laws, InterpolationMeetsBothEnds, (const Pose2& a, const Pose2& b)) {
  expectNear(interpolate(a, b, 0.0), a);
  expectNear(interpolate(a, b, 1.0), b);
}

RC_GTEST_PROP(Pose2Laws, InterpolationMovesWithOneVelocity, (const Pose2& a, const Pose2& b)) {
  const double ratio = 0.5 * (1.0 + *test::within(1.0));
  const Pose2 middle = interpolate(a, b, ratio);
  RC_ASSERT((between(a, middle).log() - ratio * between(a, b).log()).norm() < 1e-9);
}

}  // namespace
}  // namespace sightline::geometry

#endif
