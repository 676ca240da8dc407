#pragma once

#include <map>
#include <string>

#include <sensor_msgs/LaserScan.h>

#include "sightline/bridge/finding.h"
#include "sightline/logs/range_check.h"
#include "sightline/logs/stamp_check.h"

namespace sightline::bridge {

/// Gathers what there is to say of a topic of scans.
class ScannerCheck {
 public:
  void take(const sensor_msgs::LaserScan& message, std::int64_t arrival);

  Findings findings() const;
  /// One line: rate, beams, field of view, limits.
  std::string description() const;
  /// Direction of a beam in the scanner's frame [rad].
  double angleOf(double beam) const { return last_.angle_min + beam * last_.angle_increment; }
  /// Frame of the last scan, as it is written there.
  const std::string& frame() const { return last_.header.frame_id; }
  const logs::StampCheck& stamps() const { return stamps_; }
  const logs::RangeCheck& ranges() const { return ranges_; }
  /// Time from the first beam to the last by the message's own word [s]; 0 where it says none.
  double sweep() const;

 private:
  void checkHeader(const sensor_msgs::LaserScan& message);
  void addStampFindings(Findings& findings) const;
  void addRangeFindings(Findings& findings) const;
  void addBody(const logs::RangeSummary& summary, Findings& findings) const;

  sensor_msgs::LaserScan last_;
  logs::StampCheck stamps_;
  logs::RangeCheck ranges_;
  std::map<std::string, std::size_t> faults_;  // of messages, by reason
};

/// Adds what is wrong with the stamps of a topic.
void addStampFindings(const logs::StampSummary& summary, Findings& findings);

}  // namespace sightline::bridge
