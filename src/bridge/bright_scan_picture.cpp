#include "sightline/bridge/bright_scan_picture.h"

#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/LaserScan.h>

#include "sightline/bridge/scan_conversion.h"
#include "sightline/config/error.h"
#include "sightline/plot/figure.h"

namespace sightline::bridge {

namespace {

constexpr double kFarthest = 10.0;  // m, that is drawn

void keepBrighter(const scan::Scan& scan, const targets::BearingDetector& detector,
                  std::optional<scan::Scan>& best, std::size_t& most) {
  if (scan.intensities().empty()) return;
  const std::size_t found = detector.detect(scan).bearings.size();
  if (best && found <= most) return;
  best = scan;
  most = found;
}

plot::Panel planePanel(const scan::Scan& scan) {
  plot::Series points{"", plot::Style::kColouredPoints, {}};
  for (std::size_t i = 0; i < scan.beams(); ++i) {
    if (!scan.isValid(i) || scan.ranges()[i] > kFarthest) continue;
    points.points.push_back({scan.point(i).x(), scan.point(i).y(), scan.intensities()[i]});
  }
  return {"Scan (figure 4a)", "x [m]", "y [m]", "intensity", 0.0, {points}};
}

plot::Panel intensityPanel(const scan::Scan& scan, const targets::BearingDetectorConfig& config) {
  plot::Series returns{"returns", plot::Style::kPoints, {}};
  for (std::size_t i = 0; i < scan.beams(); ++i) {
    if (!scan.isValid(i)) continue;
    returns.points.push_back({scan.geometry()->angles()[i], scan.intensities()[i]});
  }
  const double first = scan.geometry()->angles().front();
  const double last = scan.geometry()->angles().back();
  const plot::Series threshold{
      "threshold", plot::Style::kLine, {{first, config.threshold}, {last, config.threshold}}};
  plot::Series bearings{"measurement set", plot::Style::kPoints, {}};
  for (const double bearing : targets::BearingDetector(config).detect(scan).bearings) {
    bearings.points.push_back({bearing, 0.0});
  }
  return {"Intensities (figure 4b)",     "bearing [rad]", "intensity", "", 0.0,
          {returns, threshold, bearings}};
}

}  // namespace

std::optional<scan::Scan> brightestScan(const std::vector<std::string>& paths,
                                        const std::string& topic,
                                        const targets::BearingDetector& detector) {
  std::optional<scan::Scan> best;
  std::size_t most = 0;
  for (const std::string& path : paths) {
    try {
      const rosbag::Bag bag(path);
      ScanReader reader;
      for (const auto& item : rosbag::View(bag, rosbag::TopicQuery(topic))) {
        const auto message = item.instantiate<sensor_msgs::LaserScan>();
        if (message) keepBrighter(reader.read(*message), detector, best, most);
      }
    } catch (const rosbag::BagException& fault) {
      throw config::Error(path, 0, "", fault.what());
    } catch (const scan::InvalidScan& fault) {
      throw config::Error(path, 0, topic, fault.what());
    }
  }
  return best;
}

void drawBrightScan(const scan::Scan& scan, const targets::BearingDetectorConfig& config,
                    const std::string& path) {
  plot::Figure figure;
  figure.height = 1400;
  figure.panels = {planePanel(scan), intensityPanel(scan, config)};
  plot::writePng(figure, path);
}

}  // namespace sightline::bridge
