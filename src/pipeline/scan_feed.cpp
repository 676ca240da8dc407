#include "sightline/pipeline/scan_feed.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace sightline::pipeline {

namespace {

// A scan this much older than the last one means that the clock was set back, not that a message
// came late [ns]; where stamps are those of arrival, as long as the longest burst.
constexpr std::int64_t kSetBack = 1'000'000'000;
constexpr std::int64_t kSetBackInBursts = 10'000'000'000;

}  // namespace

ScanFeed::ScanFeed(const FeedConfig& config, const Frames& frames, const FeedNeeds& needs,
                   const Transforms& transforms)
    : config_(config), locator_(config, frames, needs, transforms) {
  config::validate(config);
}

std::size_t ScanFeed::addScanner() {
  counts_.emplace_back();
  before_.emplace_back();
  clocks_.emplace_back();
  skipped_.push_back(0.0);
  noise_.emplace_back(config_.noise);
  return counts_.size() - 1;
}

void ScanFeed::add(std::size_t scanner, scan::Scan scan, std::int64_t now) {
  if (config_.noise.kind == scan::NoiseKind::kEstimated) {
    noise_[scanner].apply(scan);
  } else {
    scan::applyNoise(config_.noise, scan);
  }
  enqueue({scanner, std::move(scan), std::nullopt, now, std::nullopt});
}

void ScanFeed::add(std::size_t scanner, motion::RangeScan range_scan, std::int64_t now) {
  enqueue({scanner, std::move(range_scan.scan), std::move(range_scan.head), now, std::nullopt});
}

void ScanFeed::enqueue(ArrivedScan arrived) {
  ++counts_[arrived.scanner].arrived;
  ScanClock& clock = clocks_[arrived.scanner];
  clock.add(arrived.scan.stamp);
  arrived.elapsed = clock.sinceBefore();
  auto place = waiting_.end();
  while (place != waiting_.begin() && goesBefore(arrived, *std::prev(place))) --place;
  waiting_.insert(place, std::move(arrived));
}

// Scans of the time before the clock was set back stay in front.
bool ScanFeed::goesBefore(const ArrivedScan& arrived, const ArrivedScan& other) const {
  if (arrived.scanner == other.scanner && clocks_[other.scanner].isOfArrival()) return false;
  return other.scan.stamp > arrived.scan.stamp && other.scan.stamp <= arrived.scan.stamp + kSetBack;
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
  const bool is_over = isSetBack(waiting_.back()) && waiting_.size() > 1;
  return settle(
      {!is_over && waited < config_.patience, !is_over && waited < config_.start_patience});
}

std::optional<FeedResult> ScanFeed::flush() {
  if (waiting_.empty()) return std::nullopt;
  return settle({false, false});
}

bool ScanFeed::isSetBack(const ArrivedScan& arrived) const {
  return newest_ &&
         arrived.scan.stamp < *newest_ - (arrived.elapsed ? kSetBackInBursts : kSetBack);
}

std::optional<FeedResult> ScanFeed::settle(const Patience& patience) {
  ArrivedScan& front = waiting_.front();
  if (isSetBack(front)) {
    newest_.reset();
    before_.assign(scanners(), std::nullopt);
    clock_restarted_ = true;
    locator_.restartClock(front.scan.stamp);
  }
  ScanLocator::Outcome outcome;
  const auto& before = before_[front.scanner];
  if (before && front.scan.stamp < *before && !front.elapsed) {
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
    if (arrived.elapsed) skipped_[arrived.scanner] += arrived.elapsed->usual;
    return result;
  }
  if (const scan::RangeNoise* noise = learnedNoise(arrived.scanner)) result.located->noise = *noise;
  const double skipped = std::exchange(skipped_[arrived.scanner], 0.0);
  if (const auto& time = arrived.elapsed) {
    result.located->elapsed = scan::ElapsedTime{time->usual + skipped, time->longest + skipped, time->sigma};
  }
  ++counts.located;
  if (!result.located->motion_known) ++counts.without_motion;
  result.located->clock_restarted = std::exchange(clock_restarted_, false);
  before_[arrived.scanner] = arrived.scan.stamp;
  newest_ = std::max(newest_.value_or(arrived.scan.stamp), arrived.scan.stamp);
  return result;
}

}  // namespace sightline::pipeline
