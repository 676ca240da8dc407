#include "sightline/bridge/scanner_check.h"

#include <cmath>

#include <fmt/format.h>

#include "sightline/bridge/pose_conversion.h"
#include "sightline/bridge/time.h"
#include "sightline/geometry/angle.h"

namespace sightline::bridge {

namespace {

using geometry::degrees;

constexpr double kFewValid = 0.05;  // share of the readings
constexpr double kLongSweep = 1.5;  // periods

void add(Findings& findings, Severity severity, std::string text) {
  findings.push_back({severity, std::move(text)});
}

}  // namespace

void ScannerCheck::take(const sensor_msgs::LaserScan& message, std::int64_t arrival) {
  stamps_.add(nanoseconds(message.header.stamp), arrival);
  try {
    read(message);
  } catch (const scan::InvalidScan& fault) {
    ++unread_[fault.what()];
  }
  if (!last_.ranges.empty()) compare(message);
  last_ = message;
}

void ScannerCheck::read(const sensor_msgs::LaserScan& message) {
  scan::Scan scan = reader_.read(message);
  misses_.mark(scan);
  ranges_.add(scan);
  sweep_ = std::abs(scan.duration());
}

void ScannerCheck::compare(const sensor_msgs::LaserScan& message) {
  if (last_.ranges.size() != message.ranges.size()) ++changes_["another number of beams"];
  if (last_.header.frame_id != message.header.frame_id) ++changes_["another frame"];
}

std::string ScannerCheck::frame() const {
  return withoutSlash(last_.header.frame_id);
}

std::string ScannerCheck::description() const {
  const logs::StampSummary stamps = stamps_.summary();
  return fmt::format(
      "{} scans, {:.2f} Hz, {} beams from {:.1f} to {:.1f} degrees, {:.3g} to {:.3g} m, frame {}, "
      "arriving {:.0f} ms after their stamp",
      stamps.messages, stamps.period > 0.0 ? 1.0 / stamps.period : 0.0, last_.ranges.size(),
      degrees(last_.angle_min), degrees(last_.angle_max), last_.range_min, last_.range_max, frame(),
      1e3 * stamps.delay);
}

Findings ScannerCheck::findings() const {
  Findings findings;
  addFaults(findings);
  addStampFindings(stamps_.summary(), findings);
  addSweep(findings);
  addRanges(findings);
  return findings;
}

void ScannerCheck::addFaults(Findings& findings) const {
  for (const auto& [fault, count] : unread_) {
    add(findings, Severity::kError, fmt::format("{} messages are no scans: {}", count, fault));
  }
  for (const auto& [field, text] : reader_.mended()) add(findings, Severity::kWarning, text);
  for (const auto& [what, count] : changes_) {
    add(findings, Severity::kWarning,
        fmt::format("{} times {} than in the scan before", count, what));
  }
}

void ScannerCheck::addSweep(Findings& findings) const {
  const double period = stamps_.summary().period;
  if (sweep_ == 0.0) {
    add(findings, Severity::kNote,
        "no time between beams: each scan is taken for a snapshot, or for a sweep that dead "
        "reckoning works out");
  } else if (period > 0.0 && sweep_ > kLongSweep * period) {
    add(findings, Severity::kWarning,
        fmt::format("by time_increment the sweep lasts {:.3g} s, with {:.3g} s from scan to scan",
                    sweep_, period));
  }
}

void ScannerCheck::addRanges(Findings& findings) const {
  const logs::RangeSummary summary = ranges_.summary();
  const std::string step =
      summary.step > 0.0 ? fmt::format("; in steps of {:.3g} m", summary.step) : "";
  add(findings, Severity::kNote,
      fmt::format("{:.1f} % of the readings valid, {:.1f} % nothing there, {:.1f} % too near, "
                  "{:.1f} % invalid{}",
                  100.0 * summary.valid, 100.0 * summary.nothing, 100.0 * summary.too_near,
                  100.0 * summary.invalid, step));
  if (summary.valid < kFewValid) {
    add(findings, Severity::kError,
        fmt::format("hardly a reading lies between range_min {:.3g} and range_max {:.3g} m",
                    last_.range_min, last_.range_max));
  }
  for (const double miss : misses_.values()) {
    add(findings, Severity::kWarning,
        fmt::format("beams without a return come as {:.3f} m, and are taken for nothing there; a "
                    "driver should report them as inf",
                    miss));
  }
  addBody(summary, findings);
}

void ScannerCheck::addBody(const logs::RangeSummary& summary, Findings& findings) const {
  for (const logs::BeamSector& sector : summary.constant) {
    const auto angle = [&](std::size_t beam) {
      return degrees(angleOf(static_cast<double>(beam)));
    };
    add(findings, Severity::kWarning,
        fmt::format("beams {} to {} ({:.1f} to {:.1f} degrees) say the same in every scan, within "
                    "{:.2f} m: the robot's own body",
                    sector.first, sector.last, angle(sector.first), angle(sector.last),
                    sector.farthest));
  }
}

void addStampFindings(const logs::StampSummary& summary, Findings& findings) {
  const auto say = [&](std::size_t count, Severity severity, const char* what) {
    if (count > 0) {
      add(findings, severity, fmt::format("{} of {} stamps {}", count, summary.messages, what));
    }
  };
  say(summary.without_stamp, Severity::kError, "are zero");
  say(summary.far, Severity::kError, "are more than a minute from their arrival");
  say(summary.back, Severity::kWarning, "go back");
  say(summary.repeated, Severity::kWarning, "are those of the message before");
  if (summary.in_bursts > 0.06) {
    add(findings, Severity::kWarning,
        fmt::format(
            "{:.0f} % of the steps between stamps are shorter than a third of the period of "
            "{:.4g} s: stamps of arrival, in bursts",
            100.0 * summary.in_bursts, summary.period));
  }
  if (summary.gaps > 0) {
    add(findings, Severity::kWarning,
        fmt::format("{} gaps, the longest of {:.3g} s, with a period of {:.3g} s", summary.gaps,
                    summary.longest_gap, summary.period));
  }
}

}  // namespace sightline::bridge
