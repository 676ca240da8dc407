#include "sightline/gaze/head_watch.h"

#include <cmath>

namespace sightline::gaze {

namespace {

// Steps of the drive by which a head may miss its target, and that count as motion.
constexpr double kArrivedSteps = 3.0;
constexpr double kMovedSteps = 1.5;

}  // namespace

HeadWatch::HeadWatch(const motion::HeadLimits& limits, double answer)
    : step_(limits.resolution), answer_(std::llround(1e9 * answer)) {}

bool HeadWatch::hasArrived() const {
  return !target_ || (angle_ && std::abs(*target_ - *angle_) <= kArrivedSteps * step_);
}

void HeadWatch::command(double position, std::int64_t now) {
  // The first command begins the time that the head has for its first report.
  if (!target_) reported_at_ = std::max(reported_at_, now);
  const bool rested = hasArrived();
  target_ = position;
  if (rested) moved_at_ = now;
}

void HeadWatch::report(double angle, std::int64_t now) {
  const bool moved = !angle_ || std::abs(angle - moved_from_) >= kMovedSteps * step_;
  angle_ = angle;
  reported_at_ = now;
  if (!moved && !hasArrived()) return;
  moved_from_ = angle;
  moved_at_ = now;
}

std::string HeadWatch::fault(std::int64_t now) const {
  if (!target_) return "";
  if (isSilent(now)) return "the head does not answer";
  if (!hasArrived() && now - moved_at_ > answer_) return "the head is stuck";
  return "";
}

bool HeadWatch::isSilent(std::int64_t now) const {
  return target_ && now - reported_at_ > answer_;
}

void HeadWatch::restart(std::int64_t now) {
  target_.reset();
  reported_at_ = now;
  moved_at_ = now;
}

}  // namespace sightline::gaze
