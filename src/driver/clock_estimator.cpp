#include "sightline/driver/clock_estimator.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace sightline::driver {

namespace {

constexpr double kOtherClock = 1.0;                  // [s]: no drift is so fast
constexpr double kRecent = 2.0;                      // [s]: no drift adds up to a millisecond in it
constexpr std::int64_t kAlwaysLate = 2'000'000'000;  // [ns]: no delay lasts so long

// Whether b lies on or above the straight line from a to c.
template <class Point>
bool isAbove(const Point& a, const Point& b, const Point& c) {
  return (b.ahead - a.ahead) * (c.device - a.device) >= (c.ahead - a.ahead) * (b.device - a.device);
}

// Lower hull of points that come in the order of their device times.
template <class Points, class Point = typename Points::value_type>
std::vector<Point> lowerHull(const Points& points) {
  std::vector<Point> hull;
  for (const Point& point : points) {
    while (hull.size() > 1 && isAbove(hull[hull.size() - 2], hull.back(), point)) hull.pop_back();
    hull.push_back(point);
  }
  return hull;
}

// Slope of the edge of a lower hull that lies at `device`. At the mean of the points, this edge is
// on the line below all points that is closest to them in the sum.
template <class Point>
double slopeAt(const std::vector<Point>& hull, double device) {
  for (std::size_t i = 1; i < hull.size(); ++i) {
    if (hull[i].device < device && i + 1 < hull.size()) continue;
    const double width = hull[i].device - hull[i - 1].device;
    return width > 0.0 ? (hull[i].ahead - hull[i - 1].ahead) / width : 0.0;
  }
  return 0.0;
}

}  // namespace

void ClockConfig::visit(config::FieldVisitor& visitor) {
  visitor.number("window", window,
                 {"s", {1.0, 1000.0}, "the device clock is estimated from messages of this time"});
  visitor.number("max_drift", max_drift,
                 {"ppm", {0.0, 1e4}, "no device clock is faster or slower by more"});
  visitor.number("latency", latency,
                 {"s",
                  {-1.0, 1.0},
                  "constant part of a message's delay; negative: measured, as half of a ping's"});
}

// Counts from the last arrival: 32 bits are more than an hour.
double ClockEstimator::deviceSeconds(std::uint32_t device) const {
  return last_seconds_ + 1e-6 * static_cast<std::int32_t>(device - last_device_);
}

void ClockEstimator::observeArrival(std::uint32_t device, std::int64_t host) {
  if (!arrivals_.empty()) {
    const double since = 1e-9 * static_cast<double>(host - origin_);
    // The host's clock tells the revolutions that the bits do not, after a long silence.
    const double wraps = std::round((since - deviceSeconds(device)) / (1e-6 * 4294967296.0));
    const double seconds = deviceSeconds(device) + wraps * (1e-6 * 4294967296.0);
    const double ahead = since - seconds;
    if (isOtherClock(ahead - aheadAt(seconds), host)) {
      ++resets_;
      reset();
    } else if (late_since_) {
      return;
    } else if (seconds >= arrivals_.back().device) {
      last_device_ = device;
      last_seconds_ = seconds;
      arrivals_.push_back({seconds, ahead});
      return fitBelowArrivals();
    } else {
      return;
    }
  }
  origin_ = host;
  last_device_ = device;
  arrivals_.push_back({0.0, 0.0});
}

// Nothing arrives before it left. A late arrival has waited somewhere, unless all are late for
// long.
bool ClockEstimator::isOtherClock(double late, std::int64_t host) {
  if (late <= kOtherClock) late_since_.reset();
  if (std::abs(late) <= kOtherClock) return false;
  if (late < 0.0) return true;
  if (!late_since_) late_since_ = host;
  return host - *late_since_ > kAlwaysLate;
}

double ClockEstimator::aheadOf(double device_seconds, std::int64_t host) const {
  return 1e-9 * static_cast<double>(host - origin_) - device_seconds;
}

std::optional<double> ClockEstimator::slackOfArrival(std::uint32_t device,
                                                     std::int64_t host) const {
  const double seconds = deviceSeconds(device);
  std::optional<double> slack;
  for (auto point = departures_.rbegin(); point != departures_.rend(); ++point) {
    if (point->device < seconds - kRecent) break;
    const double later = aheadOf(seconds, host) - point->ahead;
    slack = slack ? std::min(*slack, later) : later;
  }
  return slack;
}

std::optional<double> ClockEstimator::slackOfDeparture(std::int64_t host,
                                                       std::uint32_t device) const {
  const double seconds = deviceSeconds(device);
  std::optional<double> slack;
  for (auto point = arrivals_.rbegin(); point != arrivals_.rend(); ++point) {
    if (point->device < seconds - kRecent) break;
    const double earlier = point->ahead - aheadOf(seconds, host);
    slack = slack ? std::min(*slack, earlier) : earlier;
  }
  return slack;
}

void ClockEstimator::observeDeparture(std::int64_t host, std::uint32_t device) {
  if (arrivals_.empty()) return;
  const double seconds = deviceSeconds(device);
  departures_.push_back({seconds, aheadOf(seconds, host)});
}

void ClockEstimator::reset() {
  arrivals_.clear();
  departures_.clear();
  late_since_.reset();
  last_seconds_ = slope_ = ahead_ = held_back_ = 0.0;
}

void ClockEstimator::forgetBefore(double device) {
  while (arrivals_.size() > 1 && arrivals_.front().device < device) arrivals_.pop_front();
  while (!departures_.empty() && departures_.front().device < device) departures_.pop_front();
}

void ClockEstimator::fitBelowArrivals() {
  forgetBefore(last_seconds_ - config_.window);
  double mean = 0.0;
  for (const Point& point : arrivals_) mean += point.device / static_cast<double>(arrivals_.size());
  const double limit = 1e-6 * config_.max_drift;
  slope_ = std::clamp(slopeAt(lowerHull(arrivals_), mean), -limit, limit);
  const auto offset = [this](const Point& point) { return point.ahead - slope_ * point.device; };
  ahead_ = offset(arrivals_.front());
  for (const Point& point : arrivals_) ahead_ = std::min(ahead_, offset(point));
  if (departures_.empty()) return;
  double latest = offset(departures_.front());
  for (const Point& point : departures_) latest = std::max(latest, offset(point));
  held_back_ = ahead_ - latest;
}

std::optional<std::int64_t> ClockEstimator::hostTime(std::uint32_t device) const {
  if (arrivals_.empty()) return std::nullopt;
  const double seconds = deviceSeconds(device);
  return origin_ + std::llround(1e9 * (seconds + aheadAt(seconds) - latency()));
}

double ClockEstimator::latency() const {
  return config_.latency >= 0.0 ? config_.latency : std::max(0.0, 0.5 * held_back_);
}

}  // namespace sightline::driver
