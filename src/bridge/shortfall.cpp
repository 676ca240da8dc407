#include "sightline/bridge/shortfall.h"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

namespace sightline::bridge {

namespace {

struct Remedy {
  const char* reason;  // or a part of it
  const char* remedy;
};

constexpr std::array<Remedy, 16> kRemedies{{
    {"its plane is not level",
     "correct the mounting on tf: the z axis of the scan's frame has to point up, or down; an "
     "optical frame of a camera does not"},
    {"no transform from",
     "record /tf_static, give the first of several split bags as well, or set "
     "mountings: {FRAME: [x, y, yaw]} and frames: {base: FRAME}"},
    {"no odometry from",
     "record /tf or a topic of odometry, and set frames: {odom: FRAME, base: FRAME} or "
     "odometry_topic: TOPIC; without wheels: --nodes odometry"},
    {"before the odometry began", "start the odometry before the scanner"},
    {"a stamp of zero", "let the driver of the scanner stamp its messages"},
    {"out of range", "mend the stamps of the scanner's driver"},
    {"of the ones before it",
     "mend the stamps of the scanner's driver, or the clock of its machine"},
    {"ends before it", "let scanner and odometry be stamped by one clock, or set time_offset"},
    {"the stamp of the scan before it", "let the driver of the scanner stamp each scan anew"},
    {"older than the", "let one driver alone publish on the topic of the scans"},
    {"no intensities", "set another kind of noise, such as noise: {kind: estimated}"},
    {"no beams", "mend the driver of the scanner: its messages are empty"},
    {"increment", "mend angle_increment in the driver of the scanner"},
    {"more than a turn", "mend angle_increment in the driver of the scanner"},
    {"range limits", "mend range_min and range_max in the driver of the scanner"},
    {"no pose yet", "set rooms: {initial_pose: [x, y, yaw]}"},
}};

std::string remedyFor(const std::string& reason) {
  for (const Remedy& known : kRemedies) {
    if (reason.find(known.reason) != std::string::npos) return known.remedy;
  }
  return "";
}

}  // namespace

bool fallsShort(const EstimatorCount& count, std::size_t scans) {
  return 2 * count.with_pose < scans || scans == 0;
}

std::vector<std::string> explainShortfall(const EstimatorCount& count, std::size_t scans,
                                          const ScansByReason& dropped) {
  std::vector<std::pair<std::string, std::size_t>> reasons(dropped.begin(), dropped.end());
  reasons.insert(reasons.end(), count.without_pose.begin(), count.without_pose.end());
  std::stable_sort(reasons.begin(), reasons.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  std::vector<std::string> lines{
      fmt::format("{}: used only {} of {} scans, as", count.estimator, count.with_pose, scans)};
  for (const auto& [reason, number] : reasons) {
    const std::string remedy = remedyFor(reason);
    lines.push_back(fmt::format("  {} scans: {}{}{}", number, reason,
                                remedy.empty() ? "" : "; what to do: ", remedy));
  }
  return lines;
}

}  // namespace sightline::bridge
