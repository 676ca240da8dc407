#include "sightline/pipeline/sweep_timing.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "sightline/geometry/pose2.h"
#include "sightline/pipeline/seconds_between.h"

namespace sightline::pipeline {

using geometry::Pose2;

namespace {

constexpr struct {
  // Times that are looked for: from minus these to these [s], and how finely.
  double widest_middle = 0.5;
  double widest_sweep = 0.25;
  double step = 0.01;
  // Differences of ranges that count in full [m].
  double range_scale = 0.05;
  // Steps that tell: how long they may last [s], and how far they turn [rad].
  double longest = 0.5;
  double least_turn = 0.01;
  double most_turn = 0.5;
  // Share of what came before that a further step leaves: some 400 steps count.
  double kept = 0.9975;
  // Error of a time that is worth a word [s], and sigmas beyond it that are no chance, although one
  // looks again and again; what is once corrected is corrected more finely.
  double worth = 0.02;
  double sigmas = 4.0;
  double fine = 0.005;
  double fine_sigmas = 1.0;
  // Share of the time between two scans by which the middle may be found wrong: between poses that
  // far apart turns are interpolated, and noise that is averaged there attracts it.
  double coarse = 0.25;
  // Turn rate that tells the duration of a sweep [rad/s]: with less, what the carrier drives within
  // a sweep shows as much.
  double fast = 0.5;
  // Mountings that differ by less are one [m, rad].
  double fixed = 1e-4;
  // Share of the time between two scans by which a correction changes at most.
  double slew = 0.2;
} kTiming;

bool isCertainlyOff(const Determined& found, double taken, double worth = kTiming.worth) {
  return std::abs(found.value - taken) > worth + kTiming.sigmas * found.sigma;
}

bool isOff(const Determined& found, double taken) {
  return std::abs(found.value - taken) > kTiming.fine + kTiming.fine_sigmas * found.sigma;
}

// Mean place of what tells the turn, in the sweep.
double meanPlace(const std::vector<TurnResidual>& residuals) {
  double sum = 0.0;
  double weights = 1e-9;
  for (const TurnResidual& residual : residuals) {
    const double weight = residual.slope * residual.slope;
    sum += weight * residual.place;
    weights += weight;
  }
  return sum / weights;
}

}  // namespace

SweepTiming::SweepTiming()
    : middles_({kTiming.widest_middle, kTiming.step}),
      sweeps_({kTiming.widest_sweep, kTiming.step}, kTiming.range_scale),
      path_(std::llround(4e9 * kTiming.widest_middle)) {}

void SweepTiming::skip() {
  anchor_.reset();
  turns_.clear();
  path_.clear();
}

bool SweepTiming::isConsecutive(const Anchor& now) const {
  if (!anchor_) return false;
  const double elapsed = secondsBetween(anchor_->stamp, now.stamp);
  return elapsed > 0.0 && elapsed < kTiming.longest;
}

// A scanner on a turret turns by more than its carrier's odometry tells.
bool SweepTiming::isFixed(const Pose2& T_base_sensor) {
  const Pose2 moved = geometry::between(T_base_sensor_.value_or(T_base_sensor), T_base_sensor);
  T_base_sensor_ = T_base_sensor;
  return moved.translation().norm() < kTiming.fixed && std::abs(moved.theta()) < kTiming.fixed;
}

void SweepTiming::add(const scan::Scan& scan, std::int64_t shift, const Pose2& T_odom_base,
                      const Pose2& T_base_sensor) {
  if (scan.beams() < 2) return;
  if (!isFixed(T_base_sensor)) skip();
  path_.add(scan.stamp + shift, T_odom_base);
  Anchor now{scan.stamp, T_odom_base * T_base_sensor, orderedReturns(scan)};
  if (isConsecutive(now)) measure(scan, now);
  anchor_ = std::move(now);
  compareWithOdometry();
}

void SweepTiming::measure(const scan::Scan& scan, const Anchor& now) {
  const Pose2 T_before_now = geometry::between(anchor_->T_odom_sensor, now.T_odom_sensor);
  const double turned = std::abs(T_before_now.theta());
  if (turned < kTiming.least_turn || turned > kTiming.most_turn) return;
  const double elapsed = secondsBetween(anchor_->stamp, now.stamp);
  const auto found = turnBetween(anchor_->returns, scan, T_before_now,
                                 T_before_now.theta() * true_sweep_.value_or(0.0) / elapsed);
  if (!found) return;
  const double turn = T_before_now.theta() + found->beyond;
  const double late = (meanPlace(found->residuals) - 0.5) * duration();
  turns_.push_back({anchor_->stamp, now.stamp, turn, late});
  period_ = elapsed;
  const double rate = turn / elapsed;
  if (std::abs(rate) > kTiming.fast) takeSeam(found->residuals, rate);
}

// What is seen at another place of the sweep than before has turned for longer, or for less long,
// than the rest. All that is seen at the same place tells nothing.
void SweepTiming::takeSeam(const std::vector<TurnResidual>& residuals, double rate) {
  constexpr double kOtherPlace = 0.5;
  const double believed = true_sweep_.value_or(0.0);
  for (const TurnResidual& residual : residuals) {
    if (std::abs(residual.places) < kOtherPlace) continue;
    const double effect = residual.slope * rate * residual.places;  // [m/s]
    sweeps_.add([&](double sweep) { return residual.difference - effect * (sweep - believed); });
  }
  sweeps_.fade(kTiming.kept);
  judgeSweep();
}

void SweepTiming::compareWithOdometry() {
  const auto around = std::llround(1e9 * kTiming.widest_middle);
  while (!turns_.empty() && turns_.front().now + around < path_.newest()) {
    compare(turns_.front());
    turns_.pop_front();
  }
}

void SweepTiming::compare(const Turn& turn) {
  std::vector<double> turns;
  const EvenValues& delays = middles_.delays();
  for (std::size_t i = 0; i < delays.size(); ++i) {
    const auto shift = std::llround(1e9 * (delays.at(i) + turn.late));
    const auto before = path_.at(turn.before + shift);
    const auto now = path_.at(turn.now + shift);
    if (!before || !now) return;
    turns.push_back(geometry::between(*before, *now).theta());
  }
  middles_.add(turns, turn.turn);
  middles_.fade(kTiming.kept);
  judgeMiddle();
}

// What was declared, or its reverse, is taken where it may be true.
void SweepTiming::judgeSweep() {
  const auto found = sweeps_.least();
  if (!found) return;
  const bool is_off = true_sweep_ ? isOff(*found, *true_sweep_) : isCertainlyOff(*found, declared_);
  if (!is_off) return;
  if (!isCertainlyOff(*found, declared_)) {
    true_sweep_.reset();
  } else {
    true_sweep_ = isCertainlyOff(*found, -declared_) ? found->value : -declared_;
  }
}

void SweepTiming::judgeMiddle() {
  const auto found = middles_.delay();
  if (!found) return;
  const double declared = 0.5 * declared_;
  const bool is_wrong =
      isCertainlyOff(*found, declared, std::max(kTiming.worth, kTiming.coarse * period_));
  const bool is_off = middle_off_ == 0.0 ? is_wrong : isOff(*found, declared + middle_off_);
  if (is_off) middle_off_ = is_wrong ? found->value - declared : 0.0;
}

// Time of the first beam after the stamp, by the sweep's middle and its duration [s].
double SweepTiming::firstOff() const {
  return middle_off_ + 0.5 * (declared_ - duration());
}

std::int64_t SweepTiming::correct(scan::Scan& scan) {
  const double elapsed = last_ ? std::max(0.0, secondsBetween(*last_, scan.stamp)) : 0.0;
  last_ = scan.stamp;
  const double most = kTiming.slew * std::min(elapsed, kTiming.longest);
  applied_ += std::clamp(firstOff() - applied_, -most, most);
  correctSweep(scan);
  return std::llround(1e9 * applied_);
}

void SweepTiming::correctSweep(scan::Scan& scan) {
  declared_ = scan.duration();
  if (!true_sweep_ || scan.beams() < 2) return;
  if (arrived_ != scan.geometry() || corrected_->timeOffsets().back() != *true_sweep_) {
    arrived_ = scan.geometry();
    corrected_ =
        arrived_->withTimeIncrement(*true_sweep_ / (static_cast<double>(scan.beams()) - 1.0));
  }
  scan::Scan again(corrected_, scan.stamp, scan.ranges(), scan.intensities());
  again.frame = scan.frame;
  scan = std::move(again);
}

std::string SweepTiming::fault() const {
  std::string text;
  if (true_sweep_) {
    text = fmt::format("from its first beam to its last {:.2f} s pass, not {:.2f} s", *true_sweep_,
                       declared_);
  }
  const double off = firstOff();
  if (std::abs(off) > kTiming.fine) {
    text +=
        fmt::format("{}by the odometry's clock its first beam is measured {:.2f} s {} its stamp",
                    text.empty() ? "" : "; ", std::abs(off), off < 0.0 ? "before" : "after");
  }
  return text.empty() ? text : "as turns show, " + text;
}

}  // namespace sightline::pipeline
