#include "sightline/tracking/pose_belief.h"

#include <algorithm>
#include <cmath>

namespace sightline::tracking {

namespace {

constexpr struct {
  double most = 7.0;          // log odds, either way: what has not been thought of stays possible
  double most_by_scan = 4.0;  // scans that follow each other see the same
  double outside = -1.0;      // of a scan taken outside every room
  // A scan that meets less than this share of what is usual is a surprise; what is usual follows
  // slowly.
  double surprise = 0.6;
  double learning = 0.1;
  double most_through = 0.04;
  double least_hits = 0.3;
} kBelief;

}  // namespace

void PoseBelief::take(const ScanAgreement& agreement, const scan::ScanGeometry& geometry,
                      bool is_outside) {
  last_ = std::clamp(logOdds(agreement, geometry), -kBelief.most_by_scan, kBelief.most_by_scan);
  if (is_outside) last_ = std::min(last_, kBelief.outside);
  log_odds_ = std::clamp(log_odds_ + last_, -kBelief.most, kBelief.most);
  compareHits(agreement);
}

void PoseBelief::compareHits(const ScanAgreement& agreement) {
  const auto judged = static_cast<double>(agreement.judged());
  is_surprised_ = false;
  if (judged < 20.0) return;
  const double hits = static_cast<double>(agreement.on_wall) / judged;
  is_surprised_ = usual_hits_ && hits < kBelief.surprise * *usual_hits_;
  const double usual = usual_hits_.value_or(hits);
  usual_hits_ = usual + kBelief.learning * (hits - usual);
}

double PoseBelief::probability() const {
  return 1.0 / (1.0 + std::exp(-log_odds_));
}

bool isSound(const ScanAgreement& agreement) {
  const auto judged = static_cast<double>(agreement.judged());
  if (judged == 0.0) return false;
  return static_cast<double>(agreement.beyond) < kBelief.most_through * judged &&
         static_cast<double>(agreement.on_wall) >= kBelief.least_hits * judged;
}

}  // namespace sightline::tracking
