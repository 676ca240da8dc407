#include "sightline/logs/ospa.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <stdexcept>

#include <gtest/gtest.h>

#include "monte_carlo.h"
#include "sightline/logs/assignment.h"

namespace sightline::logs {
namespace {

const Points kPair{{0.0, 0.0}, {3.0, 4.0}};
const Points kThree{{0.0, 0.0}, {10.0, 0.0}, {0.0, 10.0}};
const Points kTwo{{1.0, 0.0}, {10.0, 2.0}};

// Values on which two other libraries agree.
TEST(Ospa, AgreesWithPublishedImplementations) {
  EXPECT_NEAR(ospa(kPair, {{0.0, 1.0}}, {1.0, 5.0}), 3.0, 1e-9);
  EXPECT_NEAR(ospa(kPair, {{0.0, 1.0}}, {2.0, 5.0}), 3.605551275463989, 1e-9);
  EXPECT_NEAR(ospa(kThree, kTwo, {1.0, 5.0}), 8.0 / 3.0, 1e-9);
  EXPECT_NEAR(ospa(kThree, kTwo, {2.0, 5.0}), 3.162277660168379, 1e-9);
}

TEST(Ospa, OfEmptySets) {
  EXPECT_EQ(ospa({}, {}), 0.0);
  EXPECT_NEAR(ospa({}, {{1.0, 2.0}}, {1.0, 5.0}), 5.0, 1e-9);
  EXPECT_NEAR(ospa({{1.0, 2.0}}, {}, {2.0, 3.0}), 3.0, 1e-9);
}

TEST(Ospa, RefusesWhatIsNoMetricOrPoint) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(ospa({}, {}, {0.5, 5.0}), std::invalid_argument);
  EXPECT_THROW(ospa({}, {}, {1.0, 0.0}), std::invalid_argument);
  EXPECT_THROW(ospa({{nan, 0.0}}, {}), std::invalid_argument);
  EXPECT_THROW(gospa({}, {{0.0, nan}}), std::invalid_argument);
}

TEST(Ospa, IsSymmetricAndKeepsTheTriangleInequality) {
  test::Gauss gauss(1);
  const auto drawn = [&] {
    Points points(static_cast<std::size_t>(gauss.uniform(0.0, 6.0)));
    for (auto& point : points) point = {gauss(4.0), gauss(4.0)};
    return points;
  };
  for (int i = 0; i < 300; ++i) {
    const Points a = drawn(), b = drawn(), c = drawn();
    const SetMetric metric{1.0 + i % 3, 5.0};
    EXPECT_NEAR(ospa(a, b, metric), ospa(b, a, metric), 1e-12);
    EXPECT_LE(ospa(a, c, metric), ospa(a, b, metric) + ospa(b, c, metric) + 1e-9);
    EXPECT_LE(gospa(a, c, metric).value,
              gospa(a, b, metric).value + gospa(b, c, metric).value + 1e-9);
  }
}

TEST(Gospa, CountsMissedAndSpurious) {
  const Gospa result = gospa(kThree, kTwo, {1.0, 5.0});
  EXPECT_NEAR(result.value, 1.0 + 2.0 + 2.5, 1e-9);
  EXPECT_NEAR(result.localisation, 3.0, 1e-9);
  EXPECT_EQ(result.missed, 1U);
  EXPECT_EQ(result.spurious, 0U);
  const Gospa far = gospa({{0.0, 0.0}}, {{100.0, 0.0}}, {2.0, 4.0});
  EXPECT_EQ(far.missed, 1U);
  EXPECT_EQ(far.spurious, 1U);
  EXPECT_NEAR(far.value, 4.0, 1e-9);
}

// The cost of the best of all permutations.
double leastCost(const Eigen::MatrixXd& cost) {
  std::vector<Eigen::Index> columns(static_cast<std::size_t>(cost.cols()));
  std::iota(columns.begin(), columns.end(), 0);
  double least = std::numeric_limits<double>::infinity();
  do {
    double sum = 0.0;
    for (Eigen::Index row = 0; row < cost.rows(); ++row) {
      sum += cost(row, columns[static_cast<std::size_t>(row)]);
    }
    least = std::min(least, sum);
  } while (std::next_permutation(columns.begin(), columns.end()));
  return least;
}

TEST(Assignment, IsTheBestOfAll) {
  test::Gauss gauss(2);
  for (int i = 0; i < 200; ++i) {
    Eigen::MatrixXd cost(1 + i % 5, 5);
    for (double& entry : cost.reshaped()) entry = gauss();
    double sum = 0.0;
    const auto columns = assign(cost);
    for (Eigen::Index row = 0; row < cost.rows(); ++row) {
      sum += cost(row, static_cast<Eigen::Index>(columns[static_cast<std::size_t>(row)].value()));
    }
    EXPECT_NEAR(sum, leastCost(cost), 1e-12);
  }
}

TEST(Assignment, LeavesRowsOutWhereColumnsAreFew) {
  const auto columns = assign((Eigen::MatrixXd(3, 1) << 2.0, 1.0, 3.0).finished());
  EXPECT_FALSE(columns[0]);
  EXPECT_EQ(columns[1], 0U);
  EXPECT_FALSE(columns[2]);
  EXPECT_TRUE(assign(Eigen::MatrixXd(0, 3)).empty());
}

}  // namespace
}  // namespace sightline::logs
