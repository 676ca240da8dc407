#include "sightline/pipeline/turn_sense.h"

#include <algorithm>
#include <cmath>

#include "sightline/geometry/angle.h"

namespace sightline::pipeline {

namespace {

constexpr struct {
  // A turn that tells, and motion by which the view has become another [rad, m].
  double turn = 0.12;
  double most_turn = 0.8;
  double most_way = 0.7;
  // Returns that have to meet others at least.
  double fewest = 15.0;
  // Difference of ranges that counts most [m]: what was hidden, or moves.
  double most_off = 0.5;
  // One sense is meant where its mean difference is less than this share of the other's.
  double share = 0.6;
  // Votes that it takes, and their ratio.
  double votes = 4.5;  // less than five, as they age
  double ratio = 4.0;
  // Share of the votes that the next one leaves: a driver may be mended while the node runs.
  double kept = 0.95;
} kSense;

// Mean difference between ranges that are seen and those that are expected of returns [m]; nothing
// where too few of them are in view.
std::optional<double> meanDifference(const scan::Scan& scan, double sense,
                                     const std::vector<OrderedReturn>& returns,
                                     const geometry::Pose2& T_now_before) {
  const scan::ScanGeometry& geometry = *scan.geometry();
  const double first = geometry.angles().front();
  const double increment = geometry.angleIncrement();
  double sum = 0.0;
  double count = 0.0;
  for (const OrderedReturn& before : returns) {
    const Eigen::Vector2d point(before.point.x(), sense * before.point.y());
    const Eigen::Vector2d place = T_now_before * point;
    const double angle = std::atan2(sense * place.y(), place.x());
    double turns = (angle - first) / increment;
    const double circle = 2.0 * geometry::kPi / std::abs(increment);
    turns -= circle * std::floor(turns / circle);
    const auto beam = static_cast<std::size_t>(std::lround(turns));
    if (beam >= scan.beams() || !scan.isValid(beam)) continue;
    sum += std::min(kSense.most_off, std::abs(scan.ranges()[beam] - place.norm()));
    count += 1.0;
  }
  if (count < kSense.fewest) return std::nullopt;
  return sum / count;
}

}  // namespace

void TurnSense::add(const scan::Scan& scan, const geometry::Pose2& T_odom_base,
                    const geometry::Pose2& T_base_sensor) {
  if (scan.beams() < 2) return;
  const geometry::Pose2 step =
      anchor_ ? geometry::between(anchor_->T_odom_base, T_odom_base) : geometry::Pose2();
  const bool is_near = step.translation().norm() < kSense.most_way;
  if (anchor_ && is_near && std::abs(step.theta()) < kSense.turn) return;
  if (anchor_ && is_near && std::abs(step.theta()) < kSense.most_turn) {
    vote(scan, T_base_sensor.inverse() * step * T_base_sensor);
  }
  anchor_ = Anchor{T_odom_base, orderedReturns(scan)};
}

void TurnSense::vote(const scan::Scan& scan, const geometry::Pose2& T_before_now) {
  const geometry::Pose2 T_now_before = T_before_now.inverse();
  const auto same = meanDifference(scan, 1.0, anchor_->returns, T_now_before);
  const auto opposite = meanDifference(scan, -1.0, anchor_->returns, T_now_before);
  if (!same || !opposite) return;
  for (double& votes : votes_) votes *= kSense.kept;
  if (*same < kSense.share * *opposite) votes_[kSame] += 1.0;
  if (*opposite < kSense.share * *same) votes_[kOpposite] += 1.0;
}

bool TurnSense::isOpposite() const {
  return votes_[kOpposite] >= kSense.votes && votes_[kOpposite] > kSense.ratio * votes_[kSame];
}

}  // namespace sightline::pipeline
