#include "sightline/driver/device_check.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace sightline::driver {

namespace {

using Verdict = CheckResult::Verdict;

constexpr double kUnsteady = 5e-3;       // [s]: spread of delays that tells of something in between
constexpr double kWallTolerance = 0.03;  // share of the depth
constexpr double kTurnTolerance = 0.02;  // [rad]: three steps of the servo
constexpr double kFewSaturated = 0.01;   // share of the samples
constexpr double kClear = 2.0;           // times that the other sense explains it worse

Verdict rightIf(bool is_right) {
  return is_right ? Verdict::kRight : Verdict::kWrong;
}

// NaN of nothing.
double medianOf(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double lastAngle(const std::vector<TimedScan>& scans) {
  return scans.empty() ? std::numeric_limits<double>::quiet_NaN()
                       : scans.back().scan.head_angles.back();
}

// Mean square of the differences of log ranges, where beam i of one is beam i + shift of the other;
// NaN where they share too little.
double difference(const std::vector<double>& one, const std::vector<double>& other, int shift) {
  double sum = 0.0;
  int shared = 0;
  const int beams = static_cast<int>(one.size());
  for (int i = std::max(0, -shift); i < std::min(beams, beams - shift); ++i) {
    const double ratio = one[i] / other[i + shift];
    if (!(ratio > 0.0) || !std::isfinite(ratio)) continue;
    sum += std::pow(std::log(ratio), 2);
    ++shared;
  }
  return shared < beams / 4 ? std::numeric_limits<double>::quiet_NaN() : sum / shared;
}

}  // namespace

std::vector<CheckResult> DeviceCheck::ofSession(const SessionStatus& status, double seconds) const {
  std::vector<CheckResult> results;
  const auto& device = status.device;
  results.push_back({"identity",
                     device ? fmt::format("{} {}, firmware {}.{}, {} samples a scan", device->model,
                                          device->serial, device->firmware_major,
                                          device->firmware_minor, device->samples)
                            : "none",
                     rightIf(device.has_value())});
  const double expected = seconds / ranger_.calibration().parameters.scan.scanPeriod();
  const ConversationCounts& counts = status.counts;
  results.push_back(
      {"scans",
       fmt::format("{} in {:.1f} s, {:.0f} expected; {} lost, {} refused{}", counts.scans, seconds,
                   expected, counts.lost_scans, counts.refused_scans,
                   status.refusal.empty() ? "" : ": " + status.refusal),
       rightIf(counts.lost_scans + counts.refused_scans == 0 &&
               static_cast<double>(counts.scans) > 0.5 * expected)});
  const std::size_t broken = status.line.bad_headers + status.line.bad_frames;
  results.push_back(
      {"frames",
       fmt::format("{} broken of {} bytes; {}", broken, status.bytes,
                   status.is_faster_than_serial ? "faster than the baud rate: native USB"
                                                : "no faster than the baud rate"),
       rightIf(broken == 0)});
  results.push_back(
      {"clock",
       fmt::format("drifts by {:.0f} ppm, latency {:.1f} ms; set {} times, {} "
                   "impossible in headers, {} reboots",
                   1e6 * status.drift, 1e3 * status.latency, status.clock.resets,
                   status.clock.wrong_headers, counts.reboots),
       rightIf(status.clock.resets + status.clock.wrong_headers + counts.reboots == 0 &&
               !status.drift_is_at_limit)});
  return results;
}

CheckResult DeviceCheck::ofTiming(const std::vector<TimedScan>& scans) const {
  std::vector<double> delays;
  for (const TimedScan& scan : scans) delays.push_back(scan.delay);
  if (delays.size() < 5) return {"timing", "too few scans", Verdict::kUndetermined};
  std::sort(delays.begin(), delays.end());
  const double median = delays[delays.size() / 2];
  const double spread = delays[delays.size() * 9 / 10] - delays[delays.size() / 10];
  const auto& pattern = ranger_.calibration().parameters.scan;
  const double after = median - (pattern.beams - 1) / pattern.sample_rate;
  // An unsteady arrival may be this machine's fault as well.
  const Verdict verdict = after < 0.0          ? Verdict::kWrong
                          : spread < kUnsteady ? Verdict::kRight
                                               : Verdict::kUndetermined;
  return {
      "timing",
      fmt::format("scans arrive {:.1f} ms after their last sample, nine of ten within {:.1f} ms",
                  1e3 * after, 1e3 * spread),
      verdict};
}

CheckResult DeviceCheck::ofLight(const std::vector<TimedScan>& scans) const {
  std::vector<double> currents;
  std::size_t samples = 0;
  for (const TimedScan& scan : scans) {
    samples += scan.scan.currents.size();
    for (const auto& pair : scan.scan.currents) {
      if (std::isfinite(pair.total())) currents.push_back(pair.total());
    }
  }
  if (samples == 0) return {"light", "no samples", Verdict::kUndetermined};
  const double least = ranger_.calibration().parameters.scan.min_current;
  const auto lit = std::count_if(currents.begin(), currents.end(),
                                 [&](double current) { return current >= least; });
  const double saturated =
      1.0 - static_cast<double>(currents.size()) / static_cast<double>(samples);
  const double share = static_cast<double>(lit) / static_cast<double>(samples);
  return {
      "light",
      fmt::format("median {:.2f} nA; {:.0f} % of the samples have enough, {:.1f} % are at the end "
                  "of the count",
                  1e9 * medianOf(currents), 100.0 * share, 100.0 * saturated),
      rightIf(share > 0.1 && saturated < kFewSaturated)};
}

// NaN of a beam without ranges. Exchanged: as if the second current came first.
std::vector<double> DeviceCheck::medianRanges(const std::vector<TimedScan>& scans,
                                              bool exchanged) const {
  std::vector<double> ranges;
  for (std::size_t beam = 0; beam < ranger_.geometry()->beams(); ++beam) {
    std::vector<double> found;
    for (const TimedScan& scan : scans) {
      auto pair = scan.scan.currents[beam];
      if (exchanged) std::swap(pair.first, pair.second);
      const auto reading = ranger_.read(beam, pair);
      if (reading.kind == scan::ReturnKind::kValid) found.push_back(reading.range);
    }
    ranges.push_back(medianOf(std::move(found)));
  }
  return ranges;
}

// Mean over the middle third of the beams [m]; NaN where they have no ranges.
double DeviceCheck::depthAhead(const std::vector<TimedScan>& scans, bool exchanged) const {
  const auto ranges = medianRanges(scans, exchanged);
  std::vector<double> depths;
  for (std::size_t beam = ranges.size() / 3; beam < 2 * ranges.size() / 3; ++beam) {
    const double depth = ranges[beam] * ranger_.geometry()->cosines()[beam];
    if (std::isfinite(depth)) depths.push_back(depth);
  }
  return medianOf(std::move(depths));
}

CheckResult DeviceCheck::ofWall(const std::vector<TimedScan>& scans, double depth) const {
  const auto isNear = [&](double found) {
    return std::abs(found - depth) < kWallTolerance * depth;
  };
  const double found = depthAhead(scans, false);
  const double exchanged = depthAhead(scans, true);
  std::string text = fmt::format("the wall at {:.3f} m is at {:.3f} m", depth, found);
  if (!isNear(found) && isNear(exchanged)) {
    text += fmt::format("; with the two currents exchanged, at {:.3f} m: their order is wrong",
                        exchanged);
  }
  return {"currents", text, rightIf(isNear(found))};
}

CheckResult DeviceCheck::ofSweep(const std::vector<TimedScan>& before,
                                 const std::vector<TimedScan>& after, double turned) const {
  const double increment = ranger_.geometry()->angles()[1] - ranger_.geometry()->angles()[0];
  const int shift = static_cast<int>(std::lround(turned / increment));
  const auto one = medianRanges(after, false);
  const auto other = medianRanges(before, false);
  // What stands still comes from beams that are farther counter-clockwise.
  const double right = difference(one, other, shift);
  const double reversed = difference(one, other, -shift);
  const bool is_clear = right * kClear < reversed || reversed * kClear < right;
  if (!is_clear) {
    return {"sweep", "this scene does not tell its sense; show it something with edges",
            Verdict::kUndetermined};
  }
  const bool is_right = right < reversed;
  return {"sweep", is_right ? "counter-clockwise" : "clockwise: samples come in the wrong order",
          rightIf(is_right)};
}

std::vector<CheckResult> DeviceCheck::ofHead(const std::vector<TimedScan>& before,
                                             const std::vector<TimedScan>& after,
                                             double turn) const {
  if (before.empty() || after.empty()) {
    return {{"head", "no scans to tell", Verdict::kUndetermined}};
  }
  const double turned = lastAngle(after) - lastAngle(before);
  const bool is_right = std::abs(turned - turn) < kTurnTolerance;
  std::vector<CheckResult> results{
      {"head", fmt::format("told to turn by {:.3f} rad, it turned by {:.3f} rad", turn, turned),
       rightIf(is_right)}};
  if (is_right) results.push_back(ofSweep(before, after, turned));
  return results;
}

}  // namespace sightline::driver
