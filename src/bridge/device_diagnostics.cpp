#include "sightline/bridge/device_diagnostics.h"

#include <fmt/format.h>
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
  status.add("Head commands refused by the device", now.counts.refused_commands);
  status.add("Head commands lost", now.counts.lost_commands);
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
  status.add("Computed Latency", now.latency);
  status.add("Clock drift [ppm]", 1e6 * now.drift);
  status.add("Clock resets", now.clock_resets);
  addCounts(now, status);
  status.add("Scans not worked on in time", queue_.overruns());
  before_ = now;
  overruns_before_ = queue_.overruns();
}

void DeviceDiagnostics::summarise(const driver::SessionStatus& now,
                                  diagnostic_updater::DiagnosticStatusWrapper& status) {
  if (now.trouble.fault != driver::Fault::kNone) {
    status.summary(DiagnosticStatus::ERROR, now.trouble.text);
  } else if (!now.is_scanning) {
    status.summary(DiagnosticStatus::WARN, "connecting");
  } else if (brokenParts(now) > brokenParts(before_)) {
    status.summary(DiagnosticStatus::WARN, "scanning; bytes arrive broken");
  } else if (queue_.overruns() > overruns_before_) {
    status.summary(DiagnosticStatus::WARN, "scanning; scans come faster than they are worked on");
  } else if (now.counts.lost_scans > before_.counts.lost_scans) {
    status.summary(DiagnosticStatus::WARN, "scanning; scans were lost");
  } else {
    status.summary(DiagnosticStatus::OK, "scanning");
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
}

}  // namespace sightline::bridge
