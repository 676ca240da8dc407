#include "sightline/mapping/pose_graph.h"

#include <ceres/ceres.h>
#include <Eigen/Eigenvalues>

#include "path_problem.h"
#include "pose_factors.h"
#include "sightline/motion/odometry_noise.h"
#include "sightline/pipeline/scan_odometry.h"

namespace sightline::mapping {

namespace {

using geometry::Pose2;

constexpr struct {
  // Residuals in standard deviations from which on a factor loses weight.
  double loss = 2.0;
  // Errors of wheels that nobody has measured: of their length, and of the heading by the metre, to
  // which jensfelt's robot turns half as much [rad/m].
  double scale_sigma = 0.05;
  double turn_sigma = 0.02;
  // Dead reckoning is made of the same scans and wheels: it holds what nothing else does.
  double reckoning_weakness = 10.0;
  double reckoning_position = 0.005;  // [m]
  double reckoning_heading = 0.002;   // [rad]
  int iterations = 30;
} kGraph{};

ceres::CostFunction* stepCost(const Pose2& T, const Eigen::Matrix3d& root) {
  return new ceres::AutoDiffCostFunction<StepFactor, 3, 3, 3>(new StepFactor(T, root));
}

Eigen::Vector3d variances(double position, double heading) {
  return {position * position, position * position, heading * heading};
}

}  // namespace

Eigen::Matrix3d rootOf(const Eigen::Matrix3d& information) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(
      0.5 * (information + information.transpose()));
  return solver.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal() *
         solver.eigenvectors().transpose();
}

PathProblem::PathProblem(const std::vector<KeyScan>& keys, const std::vector<Pose2>& poses)
    : keys_(keys) {
  values_.reserve(poses.size());
  for (const Pose2& pose : poses) {
    values_.push_back({pose.x(), pose.y(), pose.theta()});
    problem_.AddParameterBlock(values_.back().data(), 3);
  }
  problem_.SetParameterBlockConstant(values_.front().data());
}

void PathProblem::addSteps() {
  bool has_wheels = false;
  for (std::size_t i = 1; i < values_.size(); ++i) {
    if (keys_[i].wheel_step) addWheels(i, *keys_[i].wheel_step);
    has_wheels = has_wheels || keys_[i].wheel_step;
    addReckoning(i);
  }
  if (!has_wheels) return;
  const auto prior = [](double mean, double sigma) {
    return new ceres::AutoDiffCostFunction<PriorFactor, 1, 1>(new PriorFactor(mean, sigma));
  };
  problem_.AddResidualBlock(prior(1.0, kGraph.scale_sigma), nullptr, &scale_);
  problem_.AddResidualBlock(prior(0.0, kGraph.turn_sigma), nullptr, &turn_);
}

void PathProblem::add(const Relation& relation) {
  relations_.push_back(problem_.AddResidualBlock(
      stepCost(relation.T_from_to, rootOf(relation.information)),
      new ceres::CauchyLoss(kGraph.loss), pose(relation.from), pose(relation.to)));
}

void PathProblem::hold() {
  for (auto& value : values_) problem_.SetParameterBlockConstant(value.data());
}

void PathProblem::addWheels(std::size_t i, const Pose2& measured) {
  const pipeline::WheelsConfig wheels;
  Eigen::Matrix3d covariance = motion::stepCovariance(wheels.noise, measured);
  covariance.diagonal() += variances(wheels.position_sigma, wheels.heading_sigma);
  problem_.AddResidualBlock(new ceres::AutoDiffCostFunction<WheelFactor, 3, 3, 3, 1, 1>(
                                new WheelFactor(measured, rootOf(covariance.inverse()))),
                            new ceres::CauchyLoss(kGraph.loss), pose(i - 1), pose(i), &scale_,
                            &turn_);
}

void PathProblem::addReckoning(std::size_t i) {
  Eigen::Matrix3d covariance = keys_[i].step.covariance;
  covariance.diagonal() += variances(kGraph.reckoning_position, kGraph.reckoning_heading);
  const double weakness = keys_[i].wheel_step ? kGraph.reckoning_weakness : 1.0;
  problem_.AddResidualBlock(stepCost(keys_[i].step.mean, rootOf(covariance.inverse()) / weakness),
                            new ceres::CauchyLoss(kGraph.loss), pose(i - 1), pose(i));
}

void PathProblem::solve() {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.max_num_iterations = kGraph.iterations;
  options.function_tolerance = 1e-5;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem_, &summary);
}

std::vector<Pose2> PathProblem::poses() const {
  std::vector<Pose2> poses;
  for (const auto& value : values_) poses.emplace_back(value[0], value[1], value[2]);
  return poses;
}

std::vector<double> PathProblem::relationCosts() {
  std::vector<double> costs;
  for (const auto& block : relations_) {
    double cost = 0.0;
    problem_.EvaluateResidualBlock(block, /*apply_loss_function=*/false, &cost, nullptr, nullptr);
    costs.push_back(2.0 * cost);
  }
  return costs;
}

GraphSolution solvePoseGraph(const std::vector<KeyScan>& keys,
                             const std::vector<Relation>& relations,
                             const std::vector<Pose2>& poses) {
  if (poses.size() < 2) return {poses, 1.0, 0.0, {}};
  PathProblem problem(keys, poses);
  problem.addSteps();
  for (const Relation& relation : relations) problem.add(relation);
  problem.solve();
  return {problem.poses(), problem.wheelScale(), problem.wheelTurn(), problem.relationCosts()};
}

}  // namespace sightline::mapping
