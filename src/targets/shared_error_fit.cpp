#include "sightline/targets/shared_error_fit.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace sightline::targets {

namespace {

constexpr std::size_t kBins = 9;
constexpr double kFirst = 0.25;   // upper end of the first bin of times, each twice the last [s]
constexpr double kFewest = 30.0;  // pairs that tell a correlation at all
constexpr double kMany = 1000.0;  // pairs beyond which more tell hardly more
constexpr double kLeast = 0.05;   // correlation below which there is none to speak of
constexpr double kMost = 0.95;

struct TimedError {
  double seconds;
  double error;  // in standard deviations
};

std::vector<TimedError> errorsOf(const std::vector<KnownLook>& looks,
                                 const std::vector<Opportunity>& labelled, const ErrorFit& errors) {
  constexpr double kFarthest = 3.0;
  std::vector<TimedError> result;
  for (const Opportunity& one : labelled) {
    const KnownLook& look = looks[one.look];
    const double at_rest = errors.sigma * errors.tail;
    // What a turn makes of stamps that jitter is all bearings' alike, and no part of these shares.
    if (!one.is_detected || errors.jitter * std::abs(look.turn_rate) > 0.5 * at_rest) continue;
    result.push_back({1e-9 * static_cast<double>(look.stamp - looks[0].stamp),
                      std::clamp(one.error / at_rest, -kFarthest, kFarthest)});
  }
  return result;
}

struct PairSum {
  double products = 0.0;
  double pairs = 0.0;

  bool isEnough() const { return pairs >= kFewest; }
  double mean() const { return products / pairs; }
  /// Of bins with many pairs alike, as these are not independent.
  double weight() const { return pairs / (pairs + kMany); }
};

// Products of errors of one look, and by the time between two looks.
struct PairSums {
  PairSum together;
  std::array<PairSum, kBins> apart;

  void add(const TimedError& a, const TimedError& b) {
    const double seconds = b.seconds - a.seconds;
    PairSum& sum = seconds > 0.0 ? apart[binOf(seconds)] : together;
    sum.products += a.error * b.error;
    sum.pairs += 1.0;
  }
  static double farthest() { return kFirst * std::exp2(kBins - 1); }
  static double middleOf(std::size_t bin) {
    return bin == 0 ? 0.5 * kFirst : kFirst * std::exp2(static_cast<double>(bin) - 0.5);
  }

 private:
  static std::size_t binOf(double seconds) {
    if (seconds < kFirst) return 0;
    return std::min(static_cast<std::size_t>(std::log2(seconds / kFirst)) + 1, kBins - 1);
  }
};

PairSums pairsOf(const std::vector<TimedError>& errors) {
  PairSums sums;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    for (std::size_t j = i + 1; j < errors.size(); ++j) {
      if (errors[j].seconds - errors[i].seconds >= PairSums::farthest()) break;
      sums.add(errors[i], errors[j]);
    }
  }
  return sums;
}

// Least squares over the bins, which lie evenly in the logarithm of time.
void fitLasting(const PairSums& sums, double square, SharedErrorFit& fit) {
  double least = 0.0;
  for (double duration = 0.5; duration < 100.0; duration *= 1.25) {
    double products = 0.0;
    double squares = 0.0;
    for (std::size_t bin = 0; bin < kBins; ++bin) {
      if (!sums.apart[bin].isEnough()) continue;
      const double left = std::exp(-PairSums::middleOf(bin) / duration);
      const double weight = sums.apart[bin].weight();
      products += weight * left * sums.apart[bin].mean() / square;
      squares += weight * left * left;
    }
    if (!(squares > 0.0) || products <= 0.0) continue;
    const double change = -products * products / squares;  // of the sum of squares
    if (change >= least) continue;
    least = change;
    fit.lasting_share = std::min(products / squares, kMost);
    fit.lasting_duration = duration;
  }
  if (fit.lasting_share < kLeast) fit.lasting_share = 0.0;
}

}  // namespace

SharedErrorFit fitSharedErrors(const std::vector<KnownLook>& looks,
                               const std::vector<Opportunity>& labelled, const ErrorFit& errors) {
  SharedErrorFit fit;
  if (!(errors.sigma > 0.0)) return fit;
  const std::vector<TimedError> timed = errorsOf(looks, labelled, errors);
  double square = 0.0;
  for (const TimedError& one : timed) square += one.error * one.error;
  square /= std::max<double>(static_cast<double>(timed.size()), 1.0);
  if (!(square > 0.0)) return fit;
  const PairSums sums = pairsOf(timed);
  fitLasting(sums, square, fit);
  if (!sums.together.isEnough()) return fit;
  const double common = sums.together.mean() / square;
  if (common >= kLeast) fit.common_share = std::min(common, kMost);
  return fit;
}

}  // namespace sightline::targets
