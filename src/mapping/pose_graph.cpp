#include "sightline/mapping/pose_graph.h"

#include <array>

#include <ceres/ceres.h>
#include <Eigen/Eigenvalues>

#include "pose_factors.h"
#include "sightline/motion/odometry_noise.h"
#include "sightline/pipeline/scan_odometry.h"

namespace sightline::mapping {

namespace {

using geometry::Pose2;
using Coordinates = std::array<double, 3>;

constexpr struct {
  // Residuals in standard deviations from which on a factor loses weight.
  double loss = 2.0;
  double scale_sigma = 0.05;  // of wheels that nobody has measured
  // Dead reckoning is made of the same scans and wheels: it holds what nothing else does.
  double reckoning_weakness = 10.0;
  double reckoning_position = 0.005;  // [m]
  double reckoning_heading = 0.002;   // [rad]
  int iterations = 30;
} kGraph{};

class Graph {
 public:
  Graph(const std::vector<KeyScan>& keys, std::vector<Pose2> poses)
      : keys_(keys), poses_(std::move(poses)) {
    for (const Pose2& pose : poses_) {
      values_.push_back({pose.x(), pose.y(), pose.theta()});
    }
    for (Coordinates& value : values_) problem_.AddParameterBlock(value.data(), 3);
    problem_.SetParameterBlockConstant(values_.front().data());
  }

  void addSteps() {
    bool has_wheels = false;
    for (std::size_t i = 1; i < values_.size(); ++i) {
      if (keys_[i].wheel_step) {
        addWheels(i, *keys_[i].wheel_step);
        has_wheels = true;
      }
      addReckoning(i);
    }
    if (!has_wheels) return;
    problem_.AddResidualBlock(new ceres::AutoDiffCostFunction<PriorFactor, 1, 1>(
                                  new PriorFactor(1.0, kGraph.scale_sigma)),
                              nullptr, &scale_);
  }

  void add(const Relation& relation) {
    blocks_.push_back(problem_.AddResidualBlock(
        step(relation.T_from_to, rootOf(relation.information)), new ceres::CauchyLoss(kGraph.loss),
        values_[relation.from].data(), values_[relation.to].data()));
  }

  GraphSolution solve() {
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
    options.max_num_iterations = kGraph.iterations;
    options.function_tolerance = 1e-5;
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem_, &summary);
    GraphSolution solution;
    for (const Coordinates& v : values_) solution.poses.emplace_back(v[0], v[1], v[2]);
    solution.wheel_scale = scale_;
    for (const auto& block : blocks_) solution.relation_cost.push_back(costOf(block));
    return solution;
  }

 private:
  static ceres::CostFunction* step(const Pose2& T, const Eigen::Matrix3d& root) {
    return new ceres::AutoDiffCostFunction<StepFactor, 3, 3, 3>(new StepFactor(T, root));
  }

  void addWheels(std::size_t i, const Pose2& measured) {
    const pipeline::WheelsConfig wheels;
    Eigen::Matrix3d covariance = motion::stepCovariance(wheels.noise, measured);
    covariance.diagonal() +=
        Eigen::Vector3d(wheels.position_sigma, wheels.position_sigma, wheels.heading_sigma)
            .cwiseAbs2();
    problem_.AddResidualBlock(new ceres::AutoDiffCostFunction<WheelFactor, 3, 3, 3, 1>(
                                  new WheelFactor(measured, rootOf(covariance.inverse()))),
                              new ceres::CauchyLoss(kGraph.loss), values_[i - 1].data(),
                              values_[i].data(), &scale_);
  }

  void addReckoning(std::size_t i) {
    Eigen::Matrix3d covariance = keys_[i].step.covariance;
    covariance.diagonal() += Eigen::Vector3d(kGraph.reckoning_position, kGraph.reckoning_position,
                                             kGraph.reckoning_heading)
                                 .cwiseAbs2();
    const double weakness = keys_[i].wheel_step ? kGraph.reckoning_weakness : 1.0;
    problem_.AddResidualBlock(step(keys_[i].step.mean, rootOf(covariance.inverse()) / weakness),
                              new ceres::CauchyLoss(kGraph.loss), values_[i - 1].data(),
                              values_[i].data());
  }

  double costOf(const ceres::ResidualBlockId& block) {
    double cost = 0.0;
    problem_.EvaluateResidualBlock(block, /*apply_loss_function=*/false, &cost, nullptr, nullptr);
    return 2.0 * cost;
  }

  const std::vector<KeyScan>& keys_;
  std::vector<Pose2> poses_;
  std::vector<Coordinates> values_;
  double scale_ = 1.0;
  ceres::Problem problem_;
  std::vector<ceres::ResidualBlockId> blocks_;
};

}  // namespace

Eigen::Matrix3d rootOf(const Eigen::Matrix3d& information) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(
      0.5 * (information + information.transpose()));
  return solver.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal() *
         solver.eigenvectors().transpose();
}

GraphSolution solvePoseGraph(const std::vector<KeyScan>& keys,
                             const std::vector<Relation>& relations, std::vector<Pose2> poses) {
  if (poses.size() < 2) return {poses, 1.0, {}};
  Graph graph(keys, std::move(poses));
  graph.addSteps();
  for (const Relation& relation : relations) graph.add(relation);
  return graph.solve();
}

}  // namespace sightline::mapping
