#include "sightline/tracking/pose_belief.h"

#include <algorithm>
#include <cmath>

#include "sightline/tracking/key_scans.h"

namespace sightline::tracking {

namespace {

constexpr struct {
  double most = 7.0;  // log odds, either way: what has not been thought of stays possible
  // By a view: a door that is drawn as wall, or furniture in line with walls, is one error of the
  // map, however many beams meet it.
  double most_for = 4.0;
  double most_against = -14.0;
  double outside = -1.0;  // of a view from outside every room
  // Of a view in which less than this share of the usual beams meet walls; what is usual follows
  // slowly.
  double surprising = -5.0;
  double surprise = 0.6;
  double learning = 0.1;
  double most_through = 0.04;
  double least_hits = 0.3;
} kBelief;

}  // namespace

void PoseBelief::take(const ScanAgreement& agreement, const scan::ScanGeometry& geometry,
                      bool is_outside, const geometry::Pose2& T_odom_base) {
  if (!view_ || isAnotherView(*view_, T_odom_base)) {
    before_ = std::clamp(before_ + last_, -kBelief.most, kBelief.most);
    view_ = T_odom_base;
  }
  last_ = std::clamp(logOdds(agreement, geometry), kBelief.most_against, kBelief.most_for);
  if (is_outside) last_ = std::min(last_, kBelief.outside);
  if (isSurprising(agreement)) last_ = std::min(last_, kBelief.surprising);
}

bool PoseBelief::isSurprising(const ScanAgreement& agreement) {
  if (agreement.judged() < kLeastEvidence) return false;
  const double hits =
      static_cast<double>(agreement.on_wall) / static_cast<double>(agreement.judged());
  const double usual = usual_hits_.value_or(hits);
  usual_hits_ = usual + kBelief.learning * (hits - usual);
  return hits < kBelief.surprise * usual;
}

double PoseBelief::probability() const {
  const double log_odds = std::clamp(before_ + last_, -kBelief.most, kBelief.most);
  return 1.0 / (1.0 + std::exp(-log_odds));
}

bool isSound(const ScanAgreement& agreement) {
  const auto judged = static_cast<double>(agreement.judged());
  if (judged == 0.0) return false;
  return static_cast<double>(agreement.beyond) < kBelief.most_through * judged &&
         static_cast<double>(agreement.on_wall) >= kBelief.least_hits * judged;
}

}  // namespace sightline::tracking
