#include "sightline/targets/joint_association.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "bearing_looks.h"

namespace sightline::targets {
namespace {

Bernoulli knownTarget(double bearing) {
  Bernoulli target;
  target.existence = 1.0;
  target.stamp = 1'000'000'000;
  target.mixture.push_back({1.0, 3.0 * Eigen::Vector2d(std::cos(bearing), std::sin(bearing)),
                            1e-6 * Eigen::Matrix2d::Identity()});
  return target;
}

// Three targets one and two standard deviations apart, seen in one look that is off by one: the
// first bearing is where the second target is.
double probabilityOfTruth(double common_share) {
  constexpr double kSigma = 0.02;
  SensorModelConfig config;
  config.bearing.sigma = kSigma;
  config.bearing.common_share = common_share;
  const SensorModel model(config);
  const std::vector<double> places = {-kSigma, 0.0, 2.0 * kSigma};
  std::vector<double> bearings;
  for (const double place : places) bearings.push_back(place + kSigma);
  const BearingSet set = test::lookFrom({}, bearings);
  const Look look(set, model);
  std::vector<Bernoulli> targets;
  for (const double place : places) targets.push_back(knownTarget(place));
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < targets.size(); ++i) candidates.emplace_back(i, targets[i], look);
  const Association association = associateTogether(candidates, look, {2.0, 2.0, 2.0});
  return association.assigned.topRows(3).diagonal().mean();
}

TEST(JointAssociation, TellsNeighboursApartByWhatTheirBearingsHaveInCommon) {
  const double apart = probabilityOfTruth(0.0);
  const double together = probabilityOfTruth(0.95);
  EXPECT_LT(apart, 0.7);
  EXPECT_GT(together, apart + 0.1);
}

TEST(JointAssociation, OfOneBearingIsThatOfEachByItself) {
  SensorModelConfig config;
  config.bearing.common_share = 0.9;
  const SensorModel model(config);
  const BearingSet set = test::lookFrom({}, {0.1});
  const Look look(set, model);
  const Bernoulli target = knownTarget(0.1);
  const std::vector<Candidate> candidates{Candidate(0, target, look)};
  Eigen::MatrixXd ratio(1, 1);
  ratio << candidates[0].ratio(0) / 0.05;
  EXPECT_DOUBLE_EQ(associateTogether(candidates, look, {0.05}).assigned(0, 0),
                   associate(ratio).assigned(0, 0));
}

}  // namespace
}  // namespace sightline::targets
