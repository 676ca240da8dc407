#include "sightline/logs/nees.h"

#include <stdexcept>

#include <Eigen/Cholesky>

namespace sightline::logs {

double nees(const Eigen::VectorXd& error, const Eigen::MatrixXd& covariance) {
  const Eigen::LLT<Eigen::MatrixXd> factor(covariance);
  if (factor.info() != Eigen::Success) {
    throw std::invalid_argument("a covariance that is not positive definite");
  }
  return factor.matrixL().solve(error).squaredNorm();
}

double nees(const geometry::UncertainPose2& estimate, const geometry::Pose2& truth) {
  Eigen::Vector3d error = estimate.mean.coordinates() - truth.coordinates();
  error.z() = geometry::wrapAngle(error.z());
  return nees(Eigen::VectorXd(error), Eigen::MatrixXd(estimate.covariance));
}

}  // namespace sightline::logs
