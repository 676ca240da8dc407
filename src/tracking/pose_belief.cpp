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
  // Log odds by the first view in which far fewer beams meet walls than usual: less than this share
  // of the usual ones, and so many fewer that somewhere else is as likely as the robot having been
  // carried there. What is usual follows slowly, more slowly still while it is not.
  double surprising = -5.0;
  double surprise = 0.5;
  double carried = 9.2;  // log odds
  double statement =
      0.85;  // log odds of an independent beam that meets a wall to one that does not
  double learning = 0.1;
  double doubtful_learning = 0.005;
  double most_through = 0.04;
  double least_hits = 0.3;
  // Gates that are wider find a wall somewhere [m]; independent beams on walls that are no chance.
  double narrow = 0.15;
  double least_found = 2.0;
} kBelief;

double saidBy(const ScanAgreement& agreement, const scan::ScanGeometry& geometry) {
  return std::clamp(logOdds(agreement, geometry), kBelief.most_against, kBelief.most_for);
}

}  // namespace

bool goesThroughWalls(const ScanAgreement& agreement) {
  return static_cast<double>(agreement.beyond) >=
         kBelief.most_through * static_cast<double>(agreement.judged());
}

void PoseBelief::take(const TrackerUpdate& update, const scan::ScanGeometry& geometry,
                      const geometry::Pose2& T_odom_base) {
  const ScanAgreement& agreement = update.agreement;
  if (!view_ || isAnotherView(*view_, T_odom_base)) {
    before_ = std::clamp(before_ + last_, -kBelief.most, kBelief.most);
    view_ = T_odom_base;
    was_surprised_ = isSurprised();
    has_jumped_ = is_dismissed_ = false;
  }
  last_ = saidBy(agreement, geometry);
  if (update.is_outside) last_ = std::min(last_, kBelief.outside);
  is_surprised_ = isSurprising(agreement, geometry);
  is_dismissed_ = is_dismissed_ && !goesThroughWalls(agreement);
  // A surprise counts once, however long what causes it is seen.
  if (isSurprised()) last_ = std::min(last_, was_surprised_ ? 0.0 : kBelief.surprising);
  has_jumped_ = has_jumped_ || update.jumped;
  if (has_jumped_) last_ = std::min(last_, kBelief.surprising);
}

void PoseBelief::dismissSurprise(const TrackerUpdate& update, const scan::ScanGeometry& geometry) {
  is_dismissed_ = true;
  if (!has_jumped_ && !update.is_outside) last_ = saidBy(update.agreement, geometry);
}

bool PoseBelief::isSurprising(const ScanAgreement& agreement, const scan::ScanGeometry& geometry) {
  if (agreement.judged() < kLeastEvidence) return is_surprised_;
  const auto judged = static_cast<double>(agreement.judged());
  const double hits = static_cast<double>(agreement.on_wall) / judged;
  const double usual = usual_hits_.value_or(hits);
  const double missing =
      kBelief.statement * (usual - hits) * judged * weightOf(agreement, geometry);
  const bool is_surprising = hits < kBelief.surprise * usual && missing > kBelief.carried;
  const double learning = is_surprising ? kBelief.doubtful_learning : kBelief.learning;
  usual_hits_ = usual + learning * (hits - usual);
  return is_surprising;
}

double PoseBelief::probability() const {
  const double log_odds = std::clamp(before_ + last_, -kBelief.most, kBelief.most);
  return 1.0 / (1.0 + std::exp(-log_odds));
}

bool isSound(const ScanAgreement& agreement) {
  const auto judged = static_cast<double>(agreement.judged());
  if (judged == 0.0) return false;
  return !goesThroughWalls(agreement) &&
         static_cast<double>(agreement.on_wall) >= kBelief.least_hits * judged;
}

bool isAsPredicted(const TrackerUpdate& update, const scan::ScanGeometry& geometry) {
  double found = 0.0;
  for (const WallUpdate& wall : update.walls) {
    const bool is_narrow = wall.gate.opening <= kBelief.narrow;
    if (wall.accepted() && is_narrow) found += static_cast<double>(wall.acceptedBeams());
  }
  return !goesThroughWalls(update.agreement) &&
         found * weightOf(update.agreement, geometry) >= kBelief.least_found;
}

}  // namespace sightline::tracking
