// Filters on simulated teams: how near to the oracle they are, and whether their covariances hold.
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "monte_carlo.h"
#include "sightline/logs/ospa.h"
#include "sightline/targets/bernoulli_filter.h"
#include "sightline/targets/oracle.h"
#include "sightline/targets/phd_filter.h"
#include "sightline/targets/simulated_team.h"
#include "sightline/targets/target_log.h"

namespace sightline::targets {
namespace {

logs::Points reportedPlaces(const TargetEstimate& estimate) {
  logs::Points places;
  for (const Target& target : estimate.targets) places.push_back(target.mean);
  return places;
}

struct TeamScore {
  double ospa = 0.0;
  double oracle = 0.0;
  double nees = 0.0;  // mean over reported targets
};

template <class Filter>
TeamScore runTeam(const TeamConfig& config, Filter& filter, int seconds, std::uint64_t seed) {
  SimulatedTeam team(config, seed);
  Oracle oracle;
  for (int i = 0; i < seconds; ++i) {
    for (const SimulatedSet& set : team.step()) {
      filter.update(set.set, team.model());
      oracle.update(set.set, team.model(), set.origins);
    }
  }
  TeamScore score;
  const TargetEstimate estimate = filter.estimate();
  score.ospa = logs::ospa(team.targets(), reportedPlaces(estimate));
  score.oracle = logs::ospa(team.targets(), oracle.estimate());
  for (const Target& target : estimate.targets) {
    double least = 1e9;
    for (const Eigen::Vector2d& truth : team.targets()) {
      const Eigen::Vector2d error = target.mean - truth;
      least = std::min(least, test::normalisedSquare<2>(error, target.covariance));
    }
    score.nees += least / static_cast<double>(estimate.targets.size());
  }
  return score;
}

BernoulliFilterConfig inTheSquare() {
  BernoulliFilterConfig config;
  config.undetected.area = {0.0, 0.0, 20.0, 20.0};
  return config;
}

TEST(FilterStatistics, DefaultFilterIsNearTheOracleAndConsistent) {
  double nees = 0.0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    BernoulliFilter filter(inTheSquare());
    const TeamScore score = runTeam({}, filter, 300, seed);
    EXPECT_LT(score.ospa, score.oracle + 0.4) << seed;
    nees += 0.25 * score.nees;
  }
  EXPECT_GT(nees, 1.0);
  EXPECT_LT(nees, 3.5);
}

// From 200 to 400 s, over seeds.
TargetScore lateScore(const TeamConfig& config) {
  constexpr int kSeeds = 4;
  TargetScore mean;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    SimulatedTeam team(config, seed);
    BernoulliFilter filter(inTheSquare());
    std::vector<TargetEstimate> estimates;
    for (int i = 0; i < 400; ++i) {
      for (const SimulatedSet& set : team.step()) filter.update(set.set, team.model());
      estimates.push_back(filter.estimate());
    }
    const TargetScore one = score(estimates, team.targets(), {}, {200.0, 400.0}, 10.0);
    mean.nees += one.nees / kSeeds;
    mean.inside += one.inside / kSeeds;
  }
  return mean;
}

// Poses that err alike for a while, and sensors that do: more looks do not average it out.
TEST(FilterStatistics, DefaultFilterIsConsistentWhereErrorsLast) {
  TeamConfig off;
  off.position_sigma = 0.05;
  off.heading_sigma = geometry::radians(1.0);
  TeamConfig drifting;
  drifting.model.bearing.common_share = 0.6;
  drifting.model.bearing.lasting_share = 0.5;
  for (const TeamConfig& config : {off, drifting}) {
    const TargetScore mean = lateScore(config);
    EXPECT_GT(mean.nees, 1.0);
    EXPECT_LT(mean.nees, 3.0);
    EXPECT_GT(mean.inside, 0.9);
  }
}

TEST(FilterStatistics, PhdFindsMostTargets) {
  PhdFilterConfig config;
  config.undetected.area = {0.0, 0.0, 20.0, 20.0};
  config.particles_per_target = 300;
  PhdFilter filter(config);
  const TeamScore score = runTeam({}, filter, 300, 1);
  EXPECT_LT(score.ospa, 1.0);
  EXPECT_LT(std::abs(filter.mass() - 15.0), 6.0);
}

}  // namespace
}  // namespace sightline::targets
