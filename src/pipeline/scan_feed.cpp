#include "sightline/pipeline/scan_feed.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace sightline::pipeline {

namespace {

// Longest burst in which stamps of arrival go back [ns].
constexpr std::int64_t kLongestBurst = 10'000'000'000;

}  // namespace

ScanFeed::ScanFeed(const FeedConfig& config, const Frames& frames, const FeedNeeds& needs,
                   const Transforms& transforms)
    : config_(config), needs_(needs), locator_(config, frames, needs, transforms) {
  config::validate(config);
}

std::size_t ScanFeed::addScanner() {
  scanners_.emplace_back();
  scanners_.back().noise = scan::LearnedNoise(config_.noise);
  return scanners_.size() - 1;
}

void ScanFeed::add(std::size_t scanner, scan::Scan scan, std::int64_t now) {
  admit({scanner, std::move(scan), std::nullopt, now});
}

void ScanFeed::add(std::size_t scanner, motion::RangeScan range_scan, std::int64_t now) {
  admit({scanner, std::move(range_scan.scan), std::move(range_scan.head), now});
}

// Tells whether a stamp leaps since it is that of an arrival in bursts.
bool ScanFeed::isOnlyLate(const ArrivedScan& arrived) const {
  const Scanner& scanner = scanners_[arrived.scanner];
  return scanner.clock.isOfArrival() && std::abs(scanner.stamps.leap(arrived.scan.stamp)) <
                                            1e-9 * static_cast<double>(kLongestBurst);
}

void ScanFeed::admit(ArrivedScan arrived) {
  Scanner& scanner = scanners_[arrived.scanner];
  const std::string fault = faultOfStamp(arrived.scan.stamp);
  if (!fault.empty()) {
    ++scanner.counts.arrived;
    dropped_.push_back(drop(arrived, fault));
    return;
  }
  arrived.scan.stamp += std::llround(1e9 * config_.time_offset);
  if (isOnlyLate(arrived)) return take(std::move(arrived));
  switch (scanner.stamps.judge(arrived.scan.stamp, arrived.arrival)) {
    case StampWatch::Verdict::kGood:
      dropStrays(scanner);
      return take(std::move(arrived));
    case StampWatch::Verdict::kStray:
      if (scanner.stamps.strays() == 1) dropStrays(scanner);
      scanner.strays.push_back(std::move(arrived));
      return;
    case StampWatch::Verdict::kClockSet:
      scanner.clock.restart();
      scanner.strays.front().begins_new_time = true;
      for (ArrivedScan& stray : std::exchange(scanner.strays, {})) take(std::move(stray));
      return take(std::move(arrived));
  }
}

void ScanFeed::dropStrays(Scanner& scanner) {
  for (const ArrivedScan& stray : scanner.strays) {
    ++scanner.counts.arrived;
    dropped_.push_back(drop(stray, describeLeap(scanner.stamps.leap(stray.scan.stamp))));
  }
  scanner.strays.clear();
}

// Scans that bring no variances are those whose returns and turns nobody has looked at yet.
void ScanFeed::take(ArrivedScan arrived) {
  if (arrived.head) return enqueue(std::move(arrived));
  Scanner& scanner = scanners_[arrived.scanner];
  auto turn = scanner.turns.add(arrived.scan);
  if (!turn) return;
  arrived.scan = std::move(*turn);
  if (config_.correct_timing) arrived.odometry_shift = scanner.timing.correct(arrived.scan);
  if (config_.noise.kind == scan::NoiseKind::kIntensity && arrived.scan.intensities().empty()) {
    ++scanner.counts.arrived;
    dropped_.push_back(drop(arrived, "no intensities, by which the noise is to be known"));
    return;
  }
  scanner.misses.mark(arrived.scan);
  if (config_.noise.kind == scan::NoiseKind::kEstimated) {
    scanner.noise.apply(arrived.scan);
  } else {
    scan::applyNoise(config_.noise, arrived.scan);
  }
  enqueue(std::move(arrived));
}

void ScanFeed::enqueue(ArrivedScan arrived) {
  Scanner& scanner = scanners_[arrived.scanner];
  ++scanner.counts.arrived;
  scanner.clock.add(arrived.scan.stamp);
  scanner.schedule.add(arrived.scan.stamp, arrived.arrival);
  arrived.elapsed = scanner.clock.sinceBefore();
  auto place = waiting_.end();
  while (place != waiting_.begin() && goesBefore(arrived, *std::prev(place))) --place;
  waiting_.insert(place, std::move(arrived));
}

// Scans of the time before the clock was set back stay in front.
bool ScanFeed::goesBefore(const ArrivedScan& arrived, const ArrivedScan& other) const {
  const bool are_in_order =
      arrived.scanner == other.scanner && scanners_[other.scanner].clock.isOfArrival();
  return !are_in_order && other.scan.stamp > arrived.scan.stamp &&
         other.scan.stamp <= arrived.scan.stamp + StampWatch::kSetBack;
}

const scan::RangeNoise* ScanFeed::learnedNoise(std::size_t scanner) const {
  const scan::RangeNoise& noise = scanners_[scanner].noise.noise();
  return noise.is_learned ? &noise : nullptr;
}

void ScanFeed::refuse(std::size_t scanner, const std::string& reason) {
  ++scanners_[scanner].counts.arrived;
  ++scanners_[scanner].counts.dropped[reason];
}

namespace {

// Readings that may be of a new time are not kept: the next ones come soon.
std::string faultOfReading(StampWatch& stamps, std::int64_t stamp, std::int64_t now) {
  const std::string fault = faultOfStamp(stamp);
  if (!fault.empty()) return fault;
  const double leap = stamps.leap(stamp);
  return stamps.judge(stamp, now) == StampWatch::Verdict::kStray ? describeLeap(leap) : "";
}

}  // namespace

std::string ScanFeed::addOdometry(std::int64_t stamp, const geometry::Pose2& T_odom_base,
                                  std::int64_t now) {
  std::string fault = faultOfReading(odometry_stamps_, stamp, now);
  if (fault.empty()) locator_.addOdometry(stamp, T_odom_base);
  return fault;
}

std::string ScanFeed::addImu(const ImuReading& reading, std::int64_t now) {
  std::string fault = faultOfReading(imu_stamps_, reading.stamp, now);
  if (fault.empty() && config_.use_imu) locator_.addImu(reading);
  return fault;
}

std::optional<FeedResult> ScanFeed::nextDropped() {
  if (dropped_.empty()) return std::nullopt;
  FeedResult result = std::move(dropped_.front());
  dropped_.pop_front();
  return result;
}

std::optional<FeedResult> ScanFeed::next(std::int64_t now) {
  if (auto dropped = nextDropped()) return dropped;
  if (waiting_.empty()) return std::nullopt;
  const double waited = 1e-9 * static_cast<double>(now - waiting_.front().arrival);
  // A scan of the new time behind it: what it waits for will not come any more.
  const bool is_over = isSetBack(waiting_.back()) && waiting_.size() > 1;
  if (!is_over && needs_.odometry && isPreceded(waiting_.front(), now)) return std::nullopt;
  return settle(
      {!is_over && waited < config_.patience, !is_over && waited < config_.start_patience});
}

std::optional<FeedResult> ScanFeed::flush() {
  for (Scanner& scanner : scanners_) dropStrays(scanner);
  if (auto dropped = nextDropped()) return dropped;
  if (waiting_.empty()) return std::nullopt;
  return settle({false, false});
}

// Tells whether another scanner is about to bring a scan with an earlier stamp.
bool ScanFeed::isPreceded(const ArrivedScan& arrived, std::int64_t now) const {
  for (std::size_t i = 0; i < scanners_.size(); ++i) {
    const Scanner& other = scanners_[i];
    if (i == arrived.scanner || other.clock.isOfArrival()) continue;
    if (other.schedule.awaits(arrived.scan.stamp, now)) return true;
  }
  return false;
}

bool ScanFeed::isSetBack(const ArrivedScan& arrived) const {
  const std::int64_t back = arrived.elapsed ? kLongestBurst : StampWatch::kSetBack;
  return newest_ && arrived.scan.stamp < *newest_ - back;
}

std::optional<FeedResult> ScanFeed::settle(const Patience& patience) {
  ArrivedScan& front = waiting_.front();
  if (front.begins_new_time || isSetBack(front)) {
    front.begins_new_time = false;
    newest_.reset();
    last_.reset();
    for (Scanner& scanner : scanners_) {
      scanner.before.reset();
      scanner.repeats = RepeatWatch();
    }
    clock_restarted_ = true;
    locator_.restartClock(front.scan.stamp);
  }
  ScanLocator::Outcome outcome;
  const auto& before = scanners_[front.scanner].before;
  if (before && front.scan.stamp <= *before && !front.elapsed) {
    const bool is_same = front.scan.stamp == *before;
    outcome.reason = is_same ? "the stamp of the scan before it" : "older than the scan before it";
  } else {
    outcome = locator_.locate(front, patience, last_);
  }
  if (outcome.waits) return std::nullopt;
  const FeedResult result = finish(front, std::move(outcome));
  waiting_.pop_front();
  return result;
}

FeedResult ScanFeed::drop(const ArrivedScan& arrived, const std::string& reason) {
  ++scanners_[arrived.scanner].counts.dropped[reason];
  return {arrived.scanner, arrived.scan.stamp, std::nullopt, reason};
}

FeedResult ScanFeed::finish(const ArrivedScan& arrived, ScanLocator::Outcome outcome) {
  Scanner& scanner = scanners_[arrived.scanner];
  if (!outcome.located) {
    if (arrived.elapsed) scanner.skipped += arrived.elapsed->usual;
    return drop(arrived, outcome.reason);
  }
  if (outcome.located->odometry_broke) scanner.repeats = RepeatWatch();
  if (isRepeat(*outcome.located)) {
    if (arrived.elapsed) scanner.skipped += arrived.elapsed->usual;
    odometry_broke_ |= outcome.located->odometry_broke;
    return drop(arrived,
                "the ranges of the scan before it, to the last digit: its driver repeats it");
  }
  FeedResult result{arrived.scanner, arrived.scan.stamp, std::move(outcome.located), ""};
  result.located->odometry_broke |= std::exchange(odometry_broke_, false);
  if (const scan::RangeNoise* noise = learnedNoise(arrived.scanner)) result.located->noise = *noise;
  const double skipped = std::exchange(scanner.skipped, 0.0);
  if (const auto& time = arrived.elapsed) {
    result.located->elapsed =
        scan::ElapsedTime{time->usual + skipped, time->longest + skipped, time->sigma};
  }
  ++scanner.counts.located;
  if (!result.located->motion_known) ++scanner.counts.without_motion;
  if (result.located->odometry_broke) ++scanner.counts.odometry_broke;
  result.located->clock_restarted = std::exchange(clock_restarted_, false);
  watchTurns(arrived, *result.located);
  scanner.before = arrived.scan.stamp;
  last_ = arrived.scan.stamp;
  newest_ = std::max(newest_.value_or(arrived.scan.stamp), arrived.scan.stamp);
  return result;
}

bool ScanFeed::isRepeat(const LocatedScan& located) {
  const auto& T_odom_base = located.T_path_base ? located.T_path_base : located.T_odom_base;
  return scanners_[located.scanner].repeats.isRepeat(located.scan, learnedNoise(located.scanner),
                                                     T_odom_base);
}

std::string ScanFeed::timingFault(std::size_t scanner) const {
  const std::string fault = scanners_[scanner].timing.fault();
  if (fault.empty()) return fault;
  return fault + (config_.correct_timing ? ": made good" : ": left so by correct_timing");
}

void ScanFeed::watchTurns(const ArrivedScan& arrived, LocatedScan& located) {
  Scanner& scanner = scanners_[located.scanner];
  if (located.turn) heading_ += *located.turn;
  auto T_odom_base = located.T_path_base;
  if (!T_odom_base && located.turn) T_odom_base = geometry::Pose2(0.0, 0.0, heading_);
  if (!T_odom_base || located.odometry_broke || located.clock_restarted) {
    scanner.sense.skip();
    scanner.timing.skip();
  }
  if (!T_odom_base || arrived.head) return;
  const geometry::Pose2 T_base_sensor = located.T_base_sensor.value_or(geometry::Pose2());
  scanner.sense.add(located.scan, *T_odom_base, T_base_sensor);
  located.turns_opposite = scanner.sense.isOpposite();
  if (located.turns_opposite) ++scanner.counts.turns_opposite;
  if (located.T_path_base && !arrived.elapsed && !located.turns_opposite) {
    scanner.timing.add(located.scan, arrived.odometry_shift, *T_odom_base, T_base_sensor);
  }
}

}  // namespace sightline::pipeline
