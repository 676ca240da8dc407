#include "sightline/bridge/recording_check.h"

#include <fmt/format.h>

#include "sightline/bridge/pose_conversion.h"
#include "sightline/bridge/scan_conversion.h"
#include "sightline/bridge/time.h"
#include "sightline/geometry/angle.h"

namespace sightline::bridge {

namespace {

using geometry::degrees;

constexpr std::size_t kKept = 3000;   // scans whose motion is looked at
constexpr std::size_t kSamples = 50;  // stamps at which transforms are asked for

void addPoses(const OdometrySummary& poses, Section& section) {
  section.facts.push_back(fmt::format("{} poses, {:.1f} m driven, {:.0f} degrees turned",
                                      poses.poses, poses.distance, degrees(poses.turned)));
  if (poses.jumps == 0) return;
  section.findings.push_back(
      {Severity::kWarning,
       fmt::format("{} jumps that no carrier makes, the first at {:.3f} s", poses.jumps,
                   1e-9 * static_cast<double>(*poses.first_jump))});
}

}  // namespace

void RecordingCheck::count(const std::string& topic, const std::string& type) {
  Topic& counted = topics_[topic];
  counted.type = type;
  ++counted.messages;
}

void RecordingCheck::take(const std::string& topic, const sensor_msgs::LaserScan& message,
                          std::int64_t arrival) {
  scanners_[topic].take(message, arrival);
  if (auto& kept = kept_[topic]; kept.size() < kKept) kept.push_back(message);
}

void RecordingCheck::take(const std::string& topic, const sensor_msgs::MultiEchoLaserScan& message,
                          std::int64_t arrival) {
  take(topic, firstEchoes(message), arrival);
}

void RecordingCheck::take(const std::string& topic, const nav_msgs::Odometry& message,
                          std::int64_t arrival) {
  Wheels& wheels = wheels_[topic];
  const std::int64_t stamp = nanoseconds(message.header.stamp);
  wheels.stamps.add(stamp, arrival);
  const auto& position = message.pose.pose.position;
  const std::string fault =
      faultOfPose({position.x, position.y, position.z}, message.pose.pose.orientation);
  if (fault.empty()) {
    wheels.poses.add(stamp, toPose2(message.pose.pose));
  } else {
    ++wheels.refused[fault];
  }
  wheels.odom = withoutSlash(message.header.frame_id);
  wheels.base = withoutSlash(message.child_frame_id);
}

void RecordingCheck::take(const std::string& topic, const sensor_msgs::Imu& message,
                          std::int64_t arrival) {
  imus_[topic].add(nanoseconds(message.header.stamp), arrival);
}

void RecordingCheck::take(const std::string& topic, const tf2_msgs::TFMessage& message) {
  frames_.take(message, withoutSlash(topic) == "tf_static");
}

Section RecordingCheck::topicsSection() const {
  Section section{"Topics", {}, {}};
  for (const auto& [name, topic] : topics_) {
    section.facts.push_back(fmt::format("{:<28} {:<32} {:>7}", name, topic.type, topic.messages));
  }
  if (scanners_.empty()) {
    section.findings.push_back(
        {Severity::kError, "no scans: nothing of type sensor_msgs/LaserScan, MultiEchoLaserScan"});
  }
  return section;
}

Section RecordingCheck::scannerSection(const std::string& topic,
                                       const ScannerCheck& scanner) const {
  Section section{"Scans on " + topic, {scanner.description()}, scanner.findings()};
  addMounting(scanner, section.findings);
  for (const auto& [reason, count] : pass(kept_.at(topic), [](const pipeline::LocatedScan&) {})) {
    section.findings.push_back(
        {Severity::kError,
         fmt::format("{} of {} scans are left out: {}", count, kept_.at(topic).size(), reason)});
  }
  return section;
}

void RecordingCheck::addMounting(const ScannerCheck& scanner, Findings& findings) const {
  const auto& stamps = scanner.stamps().stamps();
  const std::size_t step = std::max<std::size_t>(1, stamps.size() / kSamples);
  std::size_t asked = 0;
  std::size_t reached = 0;
  std::optional<Mounting> mounting;
  for (std::size_t i = 0; i < stamps.size(); i += step) {
    ++asked;
    const auto at = frames_.mounting(scanner.frame(), stamps[i]);
    reached += at.has_value();
    if (at) mounting = at;
  }
  if (!mounting) {
    findings.push_back({Severity::kWarning,
                        fmt::format("no transform from {} to {}: give `mountings` in the settings, "
                                    "or the scanner is taken for the base",
                                    frames_.base(), scanner.frame())});
    return;
  }
  const geometry::Pose2& pose = mounting->T_base_sensor;
  findings.push_back(
      {Severity::kNote,
       fmt::format("mounted at x {:.3f} m, y {:.3f} m, turned by {:.1f} degrees{}", pose.x(),
                   pose.y(), degrees(pose.theta()), mounting->upside_down ? ", upside down" : "")});
  if (reached < asked) {
    findings.push_back(
        {Severity::kWarning,
         fmt::format("transforms to {} are missing at {:.0f} % of the stamps", scanner.frame(),
                     100.0 * static_cast<double>(asked - reached) / static_cast<double>(asked))});
  }
}

Section RecordingCheck::framesSection() const {
  Section section{"Frames", frames_.tree(), frames_.findings()};
  if (section.facts.empty()) section.facts.emplace_back("no transforms");
  if (!frames_.odometry().poses().empty()) addPoses(frames_.odometry().summary(), section);
  return section;
}

Section RecordingCheck::wheelsSection(const std::string& topic, const Wheels& wheels) const {
  const double period = wheels.stamps.summary().period;
  Section section{"Odometry on " + topic,
                  {fmt::format("{:.1f} Hz, {} to {}", period > 0.0 ? 1.0 / period : 0.0,
                               wheels.odom, wheels.base)},
                  {}};
  addStampFindings(wheels.stamps.summary(), section.findings);
  addPoses(wheels.poses.summary(), section);
  for (const auto& [reason, count] : wheels.refused) {
    section.findings.push_back(
        {Severity::kError, fmt::format("{} poses are left out: {}", count, reason)});
  }
  return section;
}

const logs::Trajectory* RecordingCheck::odometry() const {
  if (frames_.odometry().poses().size() > 1) return &frames_.odometry().poses();
  for (const auto& [topic, wheels] : wheels_) {
    if (wheels.poses.poses().size() > 1) return &wheels.poses.poses();
  }
  return nullptr;
}

RecordingReport RecordingCheck::report(const std::vector<std::string>& source) const {
  RecordingReport report;
  report.sections.push_back(topicsSection());
  for (const auto& [topic, scanner] : scanners_) {
    report.sections.push_back(scannerSection(topic, scanner));
  }
  report.sections.push_back(framesSection());
  for (const auto& [topic, wheels] : wheels_) {
    report.sections.push_back(wheelsSection(topic, wheels));
  }
  const Motion motion = motionOfScans();
  report.sections.push_back(motionSection(motion));
  report.next = nextSteps(source);
  report.settings = settings();
  report.figure = figure(motion);
  return report;
}

}  // namespace sightline::bridge
