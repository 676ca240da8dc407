#include "sightline/tracking/hypothesis.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sightline::tracking {

namespace {

constexpr struct {
  double claim = 9.2;  // log odds, 10⁴
  double dropped = -14.0;
  std::size_t most = 40;
  double same_position = 0.1;  // [m]
  double same_heading = 0.05;  // [rad]
} kHypotheses;

double sumOfExponentials(double a, double b) {
  return std::max(a, b) + std::log1p(std::exp(-std::abs(a - b)));
}

double highestPosterior(const std::vector<Hypothesis>& all) {
  double highest = -std::numeric_limits<double>::infinity();
  for (const Hypothesis& each : all) highest = std::max(highest, each.log_posterior);
  return highest;
}

}  // namespace

bool areOne(const geometry::Pose2& a, const geometry::Pose2& b) {
  return (a.translation() - b.translation()).norm() < kHypotheses.same_position &&
         std::abs(geometry::wrapAngle(a.theta() - b.theta())) < kHypotheses.same_heading;
}

double probabilityOf(const std::vector<Hypothesis>& all, const Hypothesis& hypothesis) {
  double sum = hypothesis.log_posterior;
  for (const Hypothesis& other : all) {
    if (&other != &hypothesis) sum = sumOfExponentials(sum, other.log_posterior);
  }
  return std::exp(hypothesis.log_posterior - sum);
}

bool isCertain(const std::vector<Hypothesis>& all, const Hypothesis& hypothesis) {
  // What nobody has thought of.
  double rivals = hypothesis.log_posterior - 2.0 * kHypotheses.claim;
  for (const Hypothesis& other : all) {
    if (&other != &hypothesis) rivals = sumOfExponentials(rivals, other.log_posterior);
  }
  return hypothesis.log_posterior - rivals >= kHypotheses.claim &&
         hypothesis.belief.probability() >= kSure && isSound(hypothesis.update.agreement);
}

std::vector<Hypothesis> thinnedOut(std::vector<Hypothesis> all, bool keeps_published) {
  const auto is_better = [=](const Hypothesis& a, const Hypothesis& b) {
    if (keeps_published && a.is_published != b.is_published) return a.is_published;
    return a.log_posterior > b.log_posterior;
  };
  std::stable_sort(all.begin(), all.end(), is_better);
  const double least = highestPosterior(all) + kHypotheses.dropped;
  std::vector<Hypothesis> kept;
  for (Hypothesis& hypothesis : all) {
    if (kept.size() >= kHypotheses.most) break;
    const bool is_safe = keeps_published && hypothesis.is_published;
    if (hypothesis.log_posterior < least && !is_safe) continue;
    const auto same = std::find_if(kept.begin(), kept.end(), [&](const Hypothesis& other) {
      return areOne(other.track.pose().mean, hypothesis.track.pose().mean);
    });
    if (same == kept.end()) {
      kept.push_back(std::move(hypothesis));
    } else {
      same->is_published = same->is_published || hypothesis.is_published;
    }
  }
  return kept;
}

}  // namespace sightline::tracking
