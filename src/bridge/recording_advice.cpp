// What to type after a recording was looked at, and the picture of it.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "sightline/bridge/recording_check.h"
#include "sightline/geometry/angle.h"

namespace sightline::bridge {

namespace {

constexpr std::size_t kMostPoints = 4000;  // of a panel

// The series that has something to draw; a panel without one is left out.
void addPanel(plot::Figure& figure, plot::Panel panel) {
  const auto is_empty = [](const plot::Series& series) { return series.points.empty(); };
  panel.series.erase(std::remove_if(panel.series.begin(), panel.series.end(), is_empty),
                     panel.series.end());
  if (!panel.series.empty()) figure.panels.push_back(std::move(panel));
}

plot::Series pathOf(const std::string& title, const logs::Trajectory& trajectory) {
  plot::Series series{title, plot::Style::kLine, {}};
  if (trajectory.empty()) return series;
  const geometry::Pose2 T_start = trajectory.front().pose.inverse();
  const std::size_t step = 1 + trajectory.size() / kMostPoints;
  for (std::size_t i = 0; i < trajectory.size(); i += step) {
    const geometry::Pose2 pose = T_start * trajectory[i].pose;
    series.points.push_back({pose.x(), pose.y()});
  }
  return series;
}

plot::Series stepsOf(const std::string& title, const logs::StampCheck& stamps) {
  plot::Series series{title, plot::Style::kPoints, {}};
  const std::vector<double> steps = stamps.steps();
  const std::size_t step = 1 + steps.size() / kMostPoints;
  for (std::size_t i = 0; i < steps.size(); i += step) {
    series.points.push_back({static_cast<double>(i), 1e3 * steps[i]});
  }
  return series;
}

// Share of the readings in each centimetre.
plot::Series rangesOf(const std::string& title, const logs::RangeCheck& ranges) {
  std::map<std::int64_t, std::size_t> centimetres;
  std::size_t all = 0;
  for (const auto& [millimetre, count] : ranges.histogram()) {
    centimetres[millimetre / 10] += count;
    all += count;
  }
  plot::Series series{title, plot::Style::kLine, {}};
  for (const auto& [centimetre, count] : centimetres) {
    series.points.push_back({0.01 * static_cast<double>(centimetre),
                             100.0 * static_cast<double>(count) / static_cast<double>(all)});
  }
  return series;
}

plot::Series pointsOf(const sensor_msgs::LaserScan& scan) {
  plot::Series series{"", plot::Style::kPoints, {}};
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    const double range = scan.ranges[i];
    const double angle = scan.angle_min + static_cast<double>(i) * scan.angle_increment;
    if (!(range <= scan.range_max)) continue;
    series.points.push_back({range * std::cos(angle), range * std::sin(angle)});
  }
  return series;
}

}  // namespace

bool RecordingCheck::isMounted(const ScannerCheck& scanner) const {
  const auto& stamps = scanner.stamps().stamps();
  return frames_.mounting(scanner.frame(), stamps[stamps.size() / 2]).has_value();
}

std::string RecordingCheck::bodyOf(const ScannerCheck& scanner) const {
  const auto& stamps = scanner.stamps().stamps();
  const auto mounting = frames_.mounting(scanner.frame(), stamps[stamps.size() / 2]);
  std::vector<std::string> angles;
  for (const logs::BeamSector& sector : scanner.ranges().summary().constant) {
    // A scanner upside down turns the other way.
    const double sense = mounting && mounting->upside_down ? -1.0 : 1.0;
    const double yaw = mounting ? mounting->T_base_sensor.theta() : 0.0;
    double from = yaw + sense * scanner.angleOf(static_cast<double>(sector.first) - 0.5);
    double to = yaw + sense * scanner.angleOf(static_cast<double>(sector.last) + 0.5);
    if (from > to) std::swap(from, to);
    angles.push_back(
        fmt::format("{:.3f}, {:.3f}", geometry::wrapAngle(from), geometry::wrapAngle(to)));
  }
  if (angles.empty()) return "";
  return fmt::format("  {}: [{}]\n", scanner.frame(), fmt::join(angles, ", "));
}

std::string RecordingCheck::settings() const {
  std::vector<std::string> topics;
  std::string mountings;
  std::string bodies;
  for (const auto& [topic, scanner] : scanners_) {
    topics.push_back(topic);
    bodies += bodyOf(scanner);
    if (!isMounted(scanner)) {
      mountings += fmt::format("  {}: [0.0, 0.0, 0.0]\n", scanner.frame());
    }
  }
  std::string text = fmt::format("scans: [{}]\nframes: {{map: map, odom: {}, base: {}}}\n",
                                 fmt::join(topics, ", "), frames_.odom(), frames_.base());
  if (!mountings.empty()) {
    text += "mountings:  # x, y [m], yaw [rad] on the base: to be measured\n" + mountings;
  }
  if (!bodies.empty()) {
    text += "body:  # where scanners see the robot itself, on the base [rad]\n" + bodies;
  }
  if (frames_.odometry().poses().empty() && !wheels_.empty()) {
    text += fmt::format("odometry_topic: {}\n", wheels_.begin()->first);
  }
  if (!imus_.empty()) text += fmt::format("imu_topic: {}\n", imus_.begin()->first);
  return text + "odometry: {}\n# rooms: {map: rooms.yaml, initial_pose: [0.0, 0.0, 0.0]}\n";
}

std::vector<std::string> RecordingCheck::nextSteps(const std::vector<std::string>& source) const {
  if (scanners_.empty()) return {"nothing: there are no scans"};
  const bool has_wheels = odometry() != nullptr;
  std::vector<std::string> lines{
      "lines: yes", "odometry from scans: yes",
      has_wheels ? "rooms: yes, with a rooms file"
                 : "rooms: no, there is no odometry; that from scans has to be recorded first"};
  if (source.empty()) return lines;
  const std::string bags = fmt::format("{}", fmt::join(source, " "));
  lines.push_back("rosrun sightline check_bag " + bags + " --write-config settings.yaml");
  lines.push_back("rosrun sightline offline --config settings.yaml " + bags + " --out out");
  lines.push_back("roslaunch sightline replay.launch bag:=" + source.front() +
                  " config:=settings.yaml");
  return lines;
}

plot::Figure RecordingCheck::figure(const Motion& motion) const {
  plot::Panel steps{"Time between scans", "scan", "ms", "", 0.0, {}};
  plot::Panel ranges{"Ranges", "m", "% of the readings", "", 0.0, {}};
  for (const auto& [topic, scanner] : scanners_) {
    steps.series.push_back(stepsOf(topic, scanner.stamps()));
    ranges.series.push_back(rangesOf(topic, scanner.ranges()));
  }
  plot::Panel path{"Path from the first pose", "x [m]", "y [m]", "", 0.0, {}};
  if (const logs::Trajectory* wheels = odometry()) {
    path.series.push_back(pathOf("odometry", *wheels));
  }
  path.series.push_back(pathOf("scans alone", motion.path));
  plot::Panel view{"First scan in the scanner's frame", "x [m]", "y [m]", "", 0.0, {}};
  if (!kept_.empty()) view.series.push_back(pointsOf(kept_.begin()->second.front()));
  plot::Figure figure;
  figure.columns = 2;
  for (plot::Panel* panel : {&steps, &ranges, &path, &view}) addPanel(figure, std::move(*panel));
  return figure;
}

}  // namespace sightline::bridge
