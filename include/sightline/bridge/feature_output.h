#pragma once

#include <string>
#include <vector>

#include "sightline/bridge/feature_messages.h"
#include "sightline/bridge/output.h"
#include "sightline/pipeline/estimators.h"

namespace sightline::bridge {

/// Features over scans on `features`, in the frame of the odometry, and their markers.
class FeatureOutput {
 public:
  FeatureOutput(Output& output, const pipeline::Frames& frames);

  void write(const pipeline::Estimates& estimates);
  /// Summary of all that has been written, a line of text each.
  std::vector<std::string> summary() const;

 private:
  std::string frame_;
  Port<FeatureArray> features_;
  Port<visualization_msgs::MarkerArray> markers_;
  FeatureMarkers drawing_;
  bool draws_;
  std::size_t scans_ = 0;
  std::size_t in_view_ = 0;
  std::size_t fixed_ = 0;
};

}  // namespace sightline::bridge
