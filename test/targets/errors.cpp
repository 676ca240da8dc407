// What errors of bearings are found to be.
#include <cmath>

#include <gtest/gtest.h>

#include "monte_carlo.h"
#include "sightline/targets/likelihood_fit.h"
#include "sightline/targets/shared_error_fit.h"

namespace sightline::targets {
namespace {

TEST(Errors, FindBiasAndLagInTails) {
  test::Gauss gauss(4);
  std::vector<KnownLook> looks;
  std::vector<Opportunity> labelled;
  for (std::size_t i = 0; i < 20000; ++i) {
    KnownLook look;
    look.turn_rate = gauss(0.3);
    const double sigma = i % 10 == 0 ? 0.025 : 0.01;
    labelled.push_back({i, 0, {2.0, 0.0}, true, -0.014 + 0.04 * look.turn_rate + gauss(sigma)});
    looks.push_back(look);
  }
  const ErrorFit fit = fitErrors(looks, labelled, 0.1);
  EXPECT_NEAR(fit.sigma, 0.01, 5e-4);
  EXPECT_NEAR(fit.bias, -0.014, 5e-4);
  EXPECT_NEAR(fit.lag, 0.04, 3.0 * fit.lag_sigma + 5e-4);
  EXPECT_NEAR(fit.tail, std::sqrt(0.9 + 0.1 * 6.25), 0.05);
}

// A lens: more the farther from its middle, and not alike on both sides.
double lensError(double bearing) {
  return 0.01 * bearing + 0.05 * bearing * bearing;
}

TEST(Errors, FindWhatALensDoes) {
  for (const bool is_lens : {true, false}) {
    test::Gauss gauss(6);
    std::vector<KnownLook> looks;
    std::vector<Opportunity> labelled;
    for (std::size_t i = 0; i < 4000; ++i) {
      KnownLook look;
      look.turn_rate = gauss(0.3);
      const double bearing = -0.6 + 1.2 * static_cast<double>(i % 997) / 997.0;
      const double lens = is_lens ? lensError(bearing) : 0.0;
      const double error = 0.01 + lens + 0.03 * look.turn_rate + gauss(0.006);
      labelled.push_back({i, i % 7, {2.0, bearing}, true, error});
      looks.push_back(look);
    }
    const ErrorFit fit = fitErrors(looks, labelled, 0.1);
    EXPECT_EQ(fit.distortion.has_value(), is_lens);
    EXPECT_NEAR(fit.sigma, 0.006, 4e-4);
    EXPECT_NEAR(fit.lag, 0.03, 3.0 * fit.lag_sigma);
    for (const double bearing : {-0.5, -0.2, 0.1, 0.5}) {
      EXPECT_NEAR(fit.biasAt(bearing), 0.01 + (is_lens ? lensError(bearing) : 0.0), 8e-4);
    }
  }
}

// Errors of a first-order process: the sum of its correlations is known.
TEST(Errors, ThatLastDoNotAverageOut) {
  for (const double kept : {0.0, 0.8}) {
    test::Gauss gauss(4);
    const std::vector<KnownLook> looks(6000);
    std::vector<Opportunity> labelled;
    double error = 0.0;
    for (std::size_t i = 0; i < looks.size(); ++i) {
      error = kept * error + gauss(0.01 * std::sqrt(1.0 - kept * kept));
      labelled.push_back({i, 0, {2.0, 0.0}, true, error + 0.02});
    }
    ErrorFit fit;
    fit.sigma = 0.01;
    fit.bias = 0.02;
    const double expected = (1.0 + kept) / (1.0 - kept);
    EXPECT_NEAR(inflationOf(looks, labelled, fit), expected, 0.2 * expected) << kept;
  }
}

// Stamps that jitter make bearings err in turns; σ is that of a sensor at rest.
TEST(Errors, GrowWithTheTurnRateByTheJitterOfStamps) {
  for (const double jitter : {0.0, 0.03}) {
    test::Gauss gauss(7);
    std::vector<KnownLook> looks;
    std::vector<Opportunity> labelled;
    for (std::size_t i = 0; i < 3000; ++i) {
      KnownLook look;
      look.turn_rate = 0.25 * static_cast<double>(i % 3);
      looks.push_back(look);
      labelled.push_back(
          {i, 0, {2.0, 0.0}, true, gauss(std::hypot(0.005, jitter * look.turn_rate))});
    }
    const ErrorFit fit = fitErrors(looks, labelled, 0.1);
    EXPECT_NEAR(fit.sigma * fit.tail, 0.005, 4e-4) << jitter;
    EXPECT_NEAR(fit.jitter, jitter, 0.004);
    EXPECT_NEAR(fit.sigmaAt(0.5), std::hypot(0.005, 0.5 * jitter), 1.2e-3);
  }
}

// Two targets in each look of a robot whose sensor drifts.
TEST(Errors, ShareOfThemThatLooksHaveInCommonIsFound) {
  constexpr double kPeriod = 0.25;
  constexpr double kDuration = 8.0;
  for (const double lasting : {0.0, 0.3}) {
    test::Gauss gauss(8);
    const double kept = std::exp(-kPeriod / kDuration);
    std::vector<KnownLook> looks;
    std::vector<Opportunity> labelled;
    double drift = 0.0;
    for (std::size_t i = 0; i < 12000; ++i) {
      drift = kept * drift + gauss(std::sqrt((1.0 - kept * kept) * lasting));
      const double common = drift + gauss(std::sqrt(0.6 - lasting));
      KnownLook look;
      look.stamp = std::llround(1e9 * kPeriod * static_cast<double>(i));
      looks.push_back(look);
      for (std::size_t target = 0; target < 2; ++target) {
        const double error = 0.01 * (common + gauss(std::sqrt(0.4)));
        labelled.push_back({i, target, {2.0, 0.0}, true, error});
      }
    }
    ErrorFit fit;
    fit.sigma = 0.01;
    const SharedErrorFit shared = fitSharedErrors(looks, labelled, fit);
    EXPECT_NEAR(shared.common_share, 0.6, 0.05);
    EXPECT_NEAR(shared.lasting_share, lasting, 0.07);
    if (lasting == 0.0) continue;
    EXPECT_NEAR(shared.lasting_duration, kDuration, 4.0);
  }
}

}  // namespace
}  // namespace sightline::targets
