#pragma once

#include <map>
#include <string>

#include <sensor_msgs/LaserScan.h>

#include "sightline/bridge/finding.h"
#include "sightline/bridge/scan_conversion.h"
#include "sightline/logs/range_check.h"
#include "sightline/logs/stamp_check.h"
#include "sightline/scan/miss_value.h"

namespace sightline::bridge {

/// Gathers what there is to say of a topic of scans, read as the estimators read them.
class ScannerCheck {
 public:
  void take(const sensor_msgs::LaserScan& message, std::int64_t arrival);

  Findings findings() const;
  /// One line: rate, beams, field of view, limits.
  std::string description() const;
  /// Direction of a beam in the scanner's frame [rad].
  double angleOf(double beam) const { return last_.angle_min + beam * last_.angle_increment; }
  /// Frame of the last scan.
  std::string frame() const;
  const logs::StampCheck& stamps() const { return stamps_; }
  const logs::RangeCheck& ranges() const { return ranges_; }
  /// Time from the first beam to the last by the message's own word [s]; 0 where it says none.
  double sweep() const { return sweep_; }

 private:
  void read(const sensor_msgs::LaserScan& message);
  void compare(const sensor_msgs::LaserScan& message);
  void addFaults(Findings& findings) const;
  void addSweep(Findings& findings) const;
  void addRanges(Findings& findings) const;
  void addBody(const logs::RangeSummary& summary, Findings& findings) const;

  ScanReader reader_;
  scan::MissValue misses_;
  logs::StampCheck stamps_;
  logs::RangeCheck ranges_;
  sensor_msgs::LaserScan last_;
  double sweep_ = 0.0;
  std::map<std::string, std::size_t> unread_;   // messages that are no scans, by reason
  std::map<std::string, std::size_t> changes_;  // of what stays as it is on other scanners
};

/// Adds what is wrong with the stamps of a topic.
void addStampFindings(const logs::StampSummary& summary, Findings& findings);

}  // namespace sightline::bridge
