// Odometry and scans of a recording, held against each other.
#include <cmath>

#include <fmt/format.h>

#include "sightline/bridge/bad_message.h"
#include "sightline/bridge/feed_input.h"
#include "sightline/bridge/recording_check.h"
#include "sightline/bridge/tf_transforms.h"
#include "sightline/bridge/time.h"
#include "sightline/pipeline/scan_odometry.h"
#include "sightline/pipeline/turn_sense.h"

namespace sightline::bridge {

namespace {

constexpr double kLateness = 0.02;    // offset worth a word [s]
constexpr double kSigmas = 3.0;       // of an offset that is no chance
constexpr double kScaleError = 0.03;  // worth a word
constexpr double kManyFlagged = 0.1;  // share of the steps

constexpr std::int64_t kWidestGap = 500'000'000;  // of the odometry [ns]

void addTurn(const logs::Trajectory& wheels, const pipeline::LocatedScan& located,
             pipeline::TurnSense& sense) {
  const auto pose = geometry::poseAt(wheels.begin(), wheels.end(), located.scan.stamp, kWidestGap);
  if (!pose) return sense.skip();
  sense.add(located.scan, *pose, located.T_base_sensor.value_or(geometry::Pose2()));
}

pipeline::FeedConfig feedOfScansAlone() {
  pipeline::FeedConfig config;
  config.odometry_source = pipeline::OdometrySource::kNone;
  config.use_imu = false;
  return config;
}

}  // namespace

pipeline::Frames RecordingCheck::names() const {
  pipeline::Frames names;
  names.base = frames_.base();
  names.odom = frames_.odom();
  return names;
}

std::map<std::string, std::size_t> RecordingCheck::pass(
    const std::deque<sensor_msgs::LaserScan>& scans,
    const std::function<void(const pipeline::LocatedScan&)>& take) const {
  const TfTransforms transforms(frames_.transforms());
  pipeline::ScanFeed feed(feedOfScansAlone(), names(), {true, false}, transforms);
  FeedInput input(feed, transforms, frames_.base());
  const std::size_t scanner = input.addScanner();
  for (const sensor_msgs::LaserScan& scan : scans) {
    try {
      input.take(scanner, scan, nanoseconds(scan.header.stamp));
    } catch (const BadMessage&) {
      continue;  // counted by the feed
    }
    while (const auto result = feed.flush()) {
      if (result->located) take(*result->located);
    }
  }
  return feed.counts(scanner).dropped;
}

RecordingCheck::Motion RecordingCheck::motionOfScans() const {
  Motion motion;
  if (kept_.empty()) return motion;
  pipeline::ScanOdometry reckoner({});
  std::optional<std::int64_t> before;
  pipeline::TurnSense sense;
  const logs::Trajectory* wheels = odometry();
  pass(kept_.begin()->second, [&](const pipeline::LocatedScan& located) {
    if (wheels) addTurn(*wheels, located, sense);
    const auto update = reckoner.update(located);
    if (!update) return;
    ++motion.scans;
    motion.flagged += update->isFlagged();
    if (before && !update->isFlagged()) {
      motion.steps.push_back({*before, update->stamp, update->step.mean});
    }
    before = update->stamp;
    motion.path.push_back({update->stamp, update->pose.mean});
  });
  motion.turns_opposite = sense.isOpposite();
  return motion;
}

Section RecordingCheck::motionSection(const Motion& motion) const {
  Section section{"Motion", {}, {}};
  if (motion.scans < 2) {
    section.facts.emplace_back("too few scans");
    return section;
  }
  section.facts.push_back(fmt::format(
      "{} scans matched one after the other; {:.1f} % of the steps in doubt", motion.scans,
      100.0 * static_cast<double>(motion.flagged) / static_cast<double>(motion.scans)));
  if (static_cast<double>(motion.flagged) > kManyFlagged * static_cast<double>(motion.scans)) {
    section.findings.push_back(
        {Severity::kWarning, "odometry from scans alone will not hold here: give it wheels"});
  }
  const logs::Trajectory* wheels = odometry();
  if (!wheels) {
    section.facts.emplace_back("no odometry to hold against them");
    return section;
  }
  if (motion.turns_opposite) {
    section.findings.push_back(
        {Severity::kError, std::string("of the first scanner: ") + kTurnsOpposite});
    return section;
  }
  const auto comparison = logs::compareSteps(motion.steps, *wheels);
  addOffset(comparison, section.findings);
  if (comparison.scale) {
    const double off = *comparison.scale - 1.0;
    section.findings.push_back(
        {std::abs(off) > kScaleError ? Severity::kWarning : Severity::kNote,
         fmt::format("the scans tell of {:.1f} % {} distance than the odometry",
                     100.0 * std::abs(off), off < 0.0 ? "less" : "more")});
  }
  return section;
}

void RecordingCheck::addOffset(const logs::StepComparison& comparison, Findings& findings) const {
  if (!comparison.offset) {
    findings.push_back({Severity::kNote, "too little turning to tell the scans' delay"});
    return;
  }
  const double offset = *comparison.offset;
  const bool is_off = std::abs(offset) > kLateness + kSigmas * comparison.offset_sigma;
  const double sweep = scanners_.begin()->second.sweep();
  const bool at_end = is_off && sweep > kLateness && std::abs(offset - sweep) < 0.3 * sweep;
  findings.push_back(
      {is_off ? Severity::kWarning : Severity::kNote,
       fmt::format("the scans' stamps are {:.0f} ms (sigma {:.0f}) {} the odometry's{}{}",
                   1e3 * std::abs(offset), 1e3 * comparison.offset_sigma,
                   offset < 0.0 ? "ahead of" : "behind",
                   at_end ? ": they are those of the end of the sweep" : "",
                   is_off ? fmt::format("; `time_offset: {:.3f}`", -offset) : std::string())});
}

}  // namespace sightline::bridge
