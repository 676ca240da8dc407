#include "sightline/bridge/scanner_check.h"

#include <cmath>

#include <fmt/format.h>

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

// Number of beams that angles and increment speak of.
double beamsOf(const sensor_msgs::LaserScan& message) {
  return (message.angle_max - message.angle_min) / message.angle_increment + 1.0;
}

}  // namespace

void ScannerCheck::take(const sensor_msgs::LaserScan& message, std::int64_t arrival) {
  stamps_.add(nanoseconds(message.header.stamp), arrival);
  ranges_.add(message.ranges, message.range_min, message.range_max);
  checkHeader(message);
  last_ = message;
}

void ScannerCheck::checkHeader(const sensor_msgs::LaserScan& message) {
  const auto beams = static_cast<double>(message.ranges.size());
  if (message.ranges.empty()) return void(++faults_["no ranges"]);
  if (!std::isfinite(message.angle_increment) || message.angle_increment == 0.0F) {
    return void(++faults_["an increment of angles that is zero or no number"]);
  }
  if (std::abs(beamsOf(message) - beams) > 1.5) ++faults_["angles for another number of beams"];
  if (!(message.range_min < message.range_max)) ++faults_["range_min not below range_max"];
  if (!message.intensities.empty() && message.intensities.size() != message.ranges.size()) {
    ++faults_["another number of intensities than of ranges"];
  }
  if (!last_.ranges.empty() && last_.ranges.size() != message.ranges.size()) {
    ++faults_["another number of beams than the scan before"];
  }
  if (!last_.ranges.empty() && last_.header.frame_id != message.header.frame_id) {
    ++faults_["another frame than the scan before"];
  }
}

double ScannerCheck::sweep() const {
  const double steps = last_.ranges.empty() ? 0.0 : static_cast<double>(last_.ranges.size() - 1);
  return std::abs(static_cast<double>(last_.time_increment)) * steps;
}

std::string ScannerCheck::description() const {
  const logs::StampSummary stamps = stamps_.summary();
  return fmt::format(
      "{} scans, {:.2f} Hz, {} beams from {:.1f} to {:.1f} degrees, {:.3g} to {:.3g} m, "
      "frame {}",
      stamps.messages, stamps.period > 0.0 ? 1.0 / stamps.period : 0.0, last_.ranges.size(),
      degrees(last_.angle_min), degrees(last_.angle_max), last_.range_min, last_.range_max,
      frame());
}

Findings ScannerCheck::findings() const {
  Findings findings;
  for (const auto& [fault, count] : faults_) {
    add(findings, Severity::kError,
        fmt::format("{} of {} scans: {}", count, ranges_.summary().scans, fault));
  }
  bridge::addStampFindings(stamps_.summary(), findings);
  addStampFindings(findings);
  addRangeFindings(findings);
  return findings;
}

void ScannerCheck::addStampFindings(Findings& findings) const {
  const double period = stamps_.summary().period;
  if (sweep() == 0.0) {
    add(findings, Severity::kNote,
        "no time between beams: each scan is taken for a snapshot, or for a sweep that dead "
        "reckoning works out");
  } else if (period > 0.0 && sweep() > kLongSweep * period) {
    add(findings, Severity::kWarning,
        fmt::format("the sweep would last {:.3g} s by time_increment, with {:.3g} s from scan to "
                    "scan: the increment is in another unit than seconds",
                    sweep(), period));
  }
}

void ScannerCheck::addRangeFindings(Findings& findings) const {
  const logs::RangeSummary summary = ranges_.summary();
  add(findings, Severity::kNote,
      fmt::format("{:.1f} % of the readings valid, {:.1f} % nothing there, {:.1f} % too near, "
                  "{:.1f} % zero, {:.1f} % no number{}",
                  100.0 * summary.valid, 100.0 * summary.nothing, 100.0 * summary.too_near,
                  100.0 * summary.zero, 100.0 * summary.not_a_number,
                  summary.resolution > 0.0 ? fmt::format("; in steps of {:g} m", summary.resolution)
                                           : std::string()));
  if (summary.valid < kFewValid) {
    add(findings, Severity::kError,
        fmt::format("hardly a reading lies between range_min {:.3g} and range_max {:.3g} m",
                    last_.range_min, last_.range_max));
  }
  if (summary.misses_as_ranges && summary.largest <= last_.range_max) {
    add(findings, Severity::kWarning,
        fmt::format("{:.1f} % of the readings are {:.3f} m, the largest there is: beams without a "
                    "return come as ranges; a driver should report them as inf",
                    100.0 * summary.at_largest, summary.largest));
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
