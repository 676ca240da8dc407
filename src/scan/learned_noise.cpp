#include "sightline/scan/learned_noise.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sightline::scan {

namespace {

struct LearnedNoiseConstants {
  // Distances that are noise, at least, for a fit to be believed.
  double enough = 60.0;
  // Scans that are all learned from; after them one in `later` is.
  std::size_t first = 16;
  std::size_t later = 16;
  // Distances that are remembered: with more, the old ones lose half their weight.
  double most = 2e5;
  // Steps of a fit anew, and of one that goes on from the last.
  int first_steps = 20;
  int later_steps = 3;
};
constexpr LearnedNoiseConstants kLearning{};

}  // namespace

LearnedNoise::LearnedNoise(const NoiseModel& model) : model_(model) {
  noise_.sigma = std::max(model.sigma, model.least_sigma);
}

void LearnedNoise::apply(Scan& scan) {
  learn(scan);
  std::vector<double> variances(scan.beams());
  for (std::size_t i = 0; i < scan.beams(); ++i) {
    variances[i] = noise_.variance(scan.isValid(i) ? scan.ranges()[i] : 0.0);
  }
  scan.setRangeVariances(std::move(variances));
  scan.angular_variance = model_.angularVariance();
  scan.transverse_variance = 0.0;
}

void LearnedNoise::learn(const Scan& scan) {
  const std::size_t number = scans_++;
  if (number >= kLearning.first && number % kLearning.later != 0) return;
  const double step_before = step_.step();
  step_.look(scan);
  // What was counted before the step was known was not spread over it.
  if (step_.step() != step_before) histogram_ = {};
  histogram_.add(scan, step_.step());
  if (histogram_.total() > kLearning.most) histogram_.scale(0.5);
  if (histogram_.total() > 0.0) fit();
}

void LearnedNoise::fit() {
  if (scans_ <= kLearning.first) fit_.start(histogram_);
  fit_.improve(histogram_,
               scans_ <= kLearning.first ? kLearning.first_steps : kLearning.later_steps);
  if (fit_.normal() < kLearning.enough) return;
  const double of_step = step_.step() * step_.step() / 12.0;
  const double least = std::max(of_step, model_.least_sigma * model_.least_sigma);
  noise_.sigma = std::sqrt(std::max(fit_.constant() - of_step, least));
  noise_.sigma_per_metre = std::sqrt(fit_.growth());
  noise_.step = step_.step();
  noise_.is_learned = true;
}

}  // namespace sightline::scan
