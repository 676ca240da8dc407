#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/LaserScan.h>

#include "score.h"
#include "sightline/bridge/scan_conversion.h"
#include "sightline/lines/line_extractor.h"
#include "sightline/logs/carmen_log.h"

namespace sightline::bench {

/// Scans of a topic of a bag.
inline std::vector<scan::Scan> readScans(const std::string& bag_path, const std::string& topic) {
  std::vector<scan::Scan> scans;
  bridge::ScanReader reader;
  rosbag::Bag bag(bag_path, rosbag::bagmode::Read);
  rosbag::View view(bag, rosbag::TopicQuery(topic));
  for (const rosbag::MessageInstance& instance : view) {
    if (const auto message = instance.instantiate<sensor_msgs::LaserScan>()) {
      scans.push_back(reader.read(*message));
    }
  }
  return scans;
}

/// Front laser scans of a CARMEN log.
inline std::vector<scan::Scan> readLog(const std::string& path) {
  std::vector<scan::Scan> scans;
  std::shared_ptr<const scan::ScanGeometry> geometry;
  for (const logs::CarmenLaser& laser : logs::readCarmenLog(path).scans) {
    const std::size_t beams = laser.ranges.size();
    if (!geometry || geometry->beams() != beams) {
      geometry = scan::ScanGeometry::uniform(laser.angle_min, laser.angle_increment, beams, 0.0,
                                             0.02, laser.range_max.value_or(50.0));
    }
    scans.emplace_back(geometry, laser.stamp,
                       std::vector<double>(laser.ranges.begin(), laser.ranges.end()));
  }
  return scans;
}

/// Part of a recording, the truth of which nobody knows, that the extractor explains.
class Explained {
 public:
  void add(const scan::Scan& scan, const std::vector<geometry::LineSegment>& segments,
           const std::vector<geometry::Arc>& arcs) {
    ++scans_;
    segments_ += segments.size();
    arcs_ += arcs.size();
    for (const auto& segment : segments) {
      shortest_ = std::min(shortest_, segment.ends.length());
      if (!isSupported(scan, segment)) ++unsupported_;
    }
    for (std::size_t i = 0; i < scan.beams(); ++i) {
      if (!scan.isValid(i)) continue;
      ++beams_;
      const double distance = distanceFrom(scan.point(i), segments, arcs);
      if (distance > kNear) continue;
      ++explained_;
      squares_ += distance * distance;
      if (distanceFrom(scan.point(i), segments, {}) <= kNear) ++on_segments_;
    }
  }

  void printFigures(const std::string& name) const {
    const auto scans = static_cast<double>(scans_);
    const auto explained = static_cast<double>(explained_);
    print(name + "explained", 100.0 * explained / static_cast<double>(beams_), "%");
    print(name + "explained_by_segments",
          100.0 * static_cast<double>(on_segments_) / static_cast<double>(beams_), "%");
    print(name + "unsupported",
          100.0 * static_cast<double>(unsupported_) / static_cast<double>(segments_), "%");
    print(name + "residual_rms_mm", 1e3 * std::sqrt(squares_ / explained), "mm");
    print(name + "segments", static_cast<double>(segments_) / scans, "1");
    print(name + "arcs", static_cast<double>(arcs_) / scans, "1");
    print(name + "shortest_segment_m", shortest_, "m");
  }

 private:
  static constexpr double kNear = 0.05;  // m

  /// At least half of the returns between its ends are near it.
  static bool isSupported(const scan::Scan& scan, const geometry::LineSegment& segment) {
    const std::size_t count = scan.beams();
    const std::size_t last =
        segment.last_beam + (segment.last_beam < segment.first_beam ? count : 0);
    std::size_t returns = 0;
    std::size_t near = 0;
    for (std::size_t i = segment.first_beam; i <= last; ++i) {
      if (!scan.isValid(i % count)) continue;
      ++returns;
      if (segment.ends.distance(scan.point(i % count)) <= kNear) ++near;
    }
    return 2 * near >= returns;
  }

  static double distanceFrom(const Eigen::Vector2d& point,
                             const std::vector<geometry::LineSegment>& segments,
                             const std::vector<geometry::Arc>& arcs) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const auto& segment : segments) {
      nearest = std::min(nearest, segment.ends.distance(point));
    }
    for (const auto& arc : arcs) {
      nearest = std::min(nearest, std::abs((point - arc.centre).norm() - arc.radius));
    }
    return nearest;
  }

  std::size_t scans_ = 0, segments_ = 0, arcs_ = 0, beams_ = 0, explained_ = 0;
  std::size_t on_segments_ = 0, unsupported_ = 0;
  double squares_ = 0.0;
  double shortest_ = std::numeric_limits<double>::infinity();
};

}  // namespace sightline::bench
