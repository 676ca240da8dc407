#include "sightline/pipeline/scan_feed.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace sightline::pipeline {

namespace {

// A scan this much older than the last one means that the clock was set back, not that a message
// came late [ns].
constexpr std::int64_t kSetBack = 1'000'000'000;

}  // namespace

ScanFeed::ScanFeed(const FeedConfig& config, const Frames& frames, const FeedNeeds& needs,
                   const Transforms& transforms)
    : config_(config), locator_(config, frames, needs, transforms) {
  config::validate(config);
}

std::size_t ScanFeed::addScanner() {
  counts_.emplace_back();
  before_.emplace_back();
  noise_.emplace_back(config_.noise);
  return counts_.size() - 1;
}

void ScanFeed::add(std::size_t scanner, scan::Scan scan, std::int64_t now) {
  if (config_.noise.kind == scan::NoiseKind::kEstimated) {
    noise_[scanner].apply(scan);
  } else {
    scan::applyNoise(config_.noise, scan);
  }
  enqueue({scanner, std::move(scan), std::nullopt, now});
}

void ScanFeed::add(std::size_t scanner, motion::RangeScan range_scan, std::int64_t now) {
  enqueue({scanner, std::move(range_scan.scan), std::move(range_scan.head), now});
}

void ScanFeed::enqueue(ArrivedScan arrived) {
  ++counts_[arrived.scanner].arrived;
  // Scans of the time before the clock was set back stay in front.
  const std::int64_t stamp = arrived.scan.stamp;
  auto place = waiting_.end();
  while (place != waiting_.begin()) {
    const std::int64_t other = std::prev(place)->scan.stamp;
    if (other <= stamp || other > stamp + kSetBack) break;
    --place;
  }
  waiting_.insert(place, std::move(arrived));
}

const scan::RangeNoise* ScanFeed::learnedNoise(std::size_t scanner) const {
  const scan::RangeNoise& noise = noise_[scanner].noise();
  return noise.is_learned ? &noise : nullptr;
}

void ScanFeed::refuse(std::size_t scanner, const std::string& reason) {
  ++counts_[scanner].arrived;
  ++counts_[scanner].dropped[reason];
}

void ScanFeed::addOdometry(std::int64_t stamp, const geometry::Pose2& T_odom_base) {
  locator_.addOdometry(stamp, T_odom_base);
}

void ScanFeed::addImu(const ImuReading& reading) {
  if (config_.use_imu) locator_.addImu(reading);
}

std::optional<FeedResult> ScanFeed::next(std::int64_t now) {
  if (waiting_.empty()) return std::nullopt;
  const double waited = 1e-9 * static_cast<double>(now - waiting_.front().arrival);
  // A scan of the new time behind it: what it waits for will not come any more.
  const bool is_over = isSetBack(waiting_.back().scan.stamp) && waiting_.size() > 1;
  return settle(
      {!is_over && waited < config_.patience, !is_over && waited < config_.start_patience});
}

std::optional<FeedResult> ScanFeed::flush() {
  if (waiting_.empty()) return std::nullopt;
  return settle({false, false});
}

bool ScanFeed::isSetBack(std::int64_t stamp) const {
  return newest_ && stamp < *newest_ - kSetBack;
}

std::optional<FeedResult> ScanFeed::settle(const Patience& patience) {
  ArrivedScan& front = waiting_.front();
  if (isSetBack(front.scan.stamp)) {
    newest_.reset();
    before_.assign(scanners(), std::nullopt);
    clock_restarted_ = true;
    locator_.restartClock(front.scan.stamp);
  }
  ScanLocator::Outcome outcome;
  const auto& before = before_[front.scanner];
  if (before && front.scan.stamp < *before) {
    outcome.reason = "older than the scan before it";
  } else {
    outcome = locator_.locate(front, patience, before);
  }
  if (outcome.waits) return std::nullopt;
  const FeedResult result = finish(front, std::move(outcome));
  waiting_.pop_front();
  return result;
}

FeedResult ScanFeed::finish(const ArrivedScan& arrived, ScanLocator::Outcome outcome) {
  FeedCounts& counts = counts_[arrived.scanner];
  FeedResult result{arrived.scanner, arrived.scan.stamp, std::move(outcome.located),
                    std::move(outcome.reason)};
  if (!result.located) {
    ++counts.dropped[result.reason];
    return result;
  }
  ++counts.located;
  if (!result.located->motion_known) ++counts.without_motion;
  result.located->clock_restarted = std::exchange(clock_restarted_, false);
  before_[arrived.scanner] = arrived.scan.stamp;
  newest_ = std::max(newest_.value_or(arrived.scan.stamp), arrived.scan.stamp);
  return result;
}

}  // namespace sightline::pipeline
