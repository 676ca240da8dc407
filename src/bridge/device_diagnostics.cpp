#include "sightline/bridge/device_diagnostics.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <ros/console.h>

namespace sightline::bridge {

namespace {

using diagnostic_msgs::DiagnosticStatus;

std::size_t brokenParts(const driver::SessionStatus& status) {
  return status.line.bad_headers + status.line.bad_frames;
}

void addDevice(const driver::SessionStatus& now,
               diagnostic_updater::DiagnosticStatusWrapper& status) {
  status.add("Vendor Name", "Sightline");
  if (!now.device) return;
  status.add("Product Name", now.device->model);
  status.add("Device ID", now.device->serial);
  status.add("Firmware Version",
             fmt::format("{}.{}", now.device->firmware_major, now.device->firmware_minor));
}

void addCounts(const driver::SessionStatus& now,
               diagnostic_updater::DiagnosticStatusWrapper& status) {
  status.add("Bytes received", now.bytes);
  status.add("Scans", now.counts.scans);
  status.add("Scans lost", now.counts.lost_scans);
  status.add("Scans refused", now.counts.refused_scans);
  status.add("Scans saturated", now.counts.saturated_scans);
  status.add("Broken headers", now.line.bad_headers);
  status.add("Broken frames", now.line.bad_frames);
  status.add("Bytes skipped", now.line.skipped_bytes);
  status.add("Connections", now.connections);
  status.add("Reboots of the device", now.counts.reboots);
  status.add("Head commands refused by the device", now.commands.refused);
  status.add("Head commands lost", now.commands.lost);
}

void addClock(const driver::SessionStatus& now,
              diagnostic_updater::DiagnosticStatusWrapper& status) {
  status.add("Computed Latency", now.latency);
  status.add("Clock drift [ppm]", 1e6 * now.drift);
  status.add("Clock resets", now.clock.resets);
  status.add("Impossible clocks in headers", now.clock.wrong_headers);
  status.add("Scans stamped by their arrival", now.clock.bridged);
  status.add("Line",
             now.is_faster_than_serial ? "faster than the baud rate: native USB" : "serial");
}

// What grew since the last report, in words.
struct Growth {
  std::size_t now;
  std::size_t before;
  const char* text;
};

std::vector<std::string> grown(const std::vector<Growth>& counts) {
  std::vector<std::string> texts;
  for (const Growth& count : counts) {
    if (count.now > count.before) texts.emplace_back(count.text);
  }
  return texts;
}

std::vector<std::string> newTroubles(const driver::SessionStatus& now,
                                     const driver::SessionStatus& before) {
  return grown({
      {brokenParts(now), brokenParts(before), "bytes arrive broken"},
      {now.counts.lost_scans, before.counts.lost_scans, "scans were lost"},
      {now.counts.saturated_scans, before.counts.saturated_scans,
       "too much light: samples at the end of the count are no ranges"},
      {now.counts.reboots, before.counts.reboots, "the device started anew"},
      {now.clock.resets, before.clock.resets, "the clock of the device was set"},
      {now.clock.wrong_headers, before.clock.wrong_headers,
       "clocks in headers are impossible; samples tell the time"},
      {now.clock.bridged, before.clock.bridged, "scans are stamped by their arrival"},
      {now.commands.refused, before.commands.refused, "the device refused a head command"},
      {now.commands.lost, before.commands.lost, "a head command was never acknowledged"},
  });
}

}  // namespace

DeviceDiagnostics::DeviceDiagnostics(const driver::SessionConfig& config,
                                     const driver::DeviceSession& session,
                                     const driver::ScanQueue& queue, double scan_rate,
                                     diagnostic_updater::Updater& updater)
    : config_(config),
      session_(session),
      queue_(queue),
      scan_rate_(scan_rate),
      frequency_({&scan_rate_, &scan_rate_, 0.1, 5}, "scan frequency") {
  updater.add("device", this, &DeviceDiagnostics::report);
  updater.add(frequency_);
}

void DeviceDiagnostics::report(diagnostic_updater::DiagnosticStatusWrapper& status) {
  const driver::SessionStatus now = session_.status();
  log(now);
  summarise(now, status);
  status.add("Serial Port", config_.port);
  status.add("Serial Baud", config_.baud_rate);
  status.add("Protocol Version", static_cast<int>(driver::kProtocolVersion));
  addDevice(now, status);
  addClock(now, status);
  addCounts(now, status);
  status.add("Scans not worked on in time", queue_.overruns());
  before_ = now;
  overruns_before_ = queue_.overruns();
}

std::vector<std::string> DeviceDiagnostics::warnings(const driver::SessionStatus& now) const {
  std::vector<std::string> texts = newTroubles(now, before_);
  if (now.counts.refused_scans > before_.counts.refused_scans) {
    texts.push_back("scans refused: " + now.refusal);
  }
  if (!now.head_fault.empty()) texts.push_back("the head " + now.head_fault);
  if (now.drift_is_at_limit) texts.emplace_back("the clock of the device drifts beyond max_drift");
  if (queue_.overruns() > overruns_before_) {
    texts.emplace_back("scans come faster than they are worked on");
  }
  return texts;
}

void DeviceDiagnostics::summarise(const driver::SessionStatus& now,
                                  diagnostic_updater::DiagnosticStatusWrapper& status) {
  if (now.trouble.fault != driver::Fault::kNone) {
    return status.summary(DiagnosticStatus::ERROR, now.trouble.text);
  }
  if (!now.is_scanning) return status.summary(DiagnosticStatus::WARN, "connecting");
  const auto texts = warnings(now);
  const auto level = texts.empty() ? DiagnosticStatus::OK : DiagnosticStatus::WARN;
  status.summary(level,
                 fmt::format("scanning{}{}", texts.empty() ? "" : "; ", fmt::join(texts, "; ")));
  for (const std::string& text : texts) {
    if (said_[text.substr(0, text.find(':'))].isDue())
      ROS_WARN("%s: %s", config_.port.c_str(), text.c_str());
  }
}

void DeviceDiagnostics::log(const driver::SessionStatus& now) {
  if (now.trouble.fault != before_.trouble.fault && !now.trouble.text.empty()) {
    ROS_ERROR("%s", now.trouble.text.c_str());
  }
  if (now.is_scanning && !before_.is_scanning) {
    ROS_INFO("%s: scanning with %s", config_.port.c_str(),
             now.device ? now.device->serial.c_str() : "?");
  }
  if (now.is_faster_than_serial && !before_.is_faster_than_serial) {
    ROS_INFO(
        "%s: bytes come faster than the baud rate allows: native USB, whose scans arrive at "
        "once",
        config_.port.c_str());
  }
}

}  // namespace sightline::bridge
