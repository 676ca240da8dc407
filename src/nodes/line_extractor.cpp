#include <memory>
#include <optional>

#include <diagnostic_updater/diagnostic_updater.h>
#include <dynamic_reconfigure/server.h>
#include <ros/ros.h>
#include <sensor_msgs/LaserScan.h>
#include <boost/make_shared.hpp>

#include "nodes/line_extractor_config.h"
#include "sightline/bridge/input_monitor.h"
#include "sightline/bridge/line_messages.h"
#include "sightline/bridge/line_settings.h"
#include "sightline/bridge/parameters.h"
#include "sightline/bridge/range_scan_conversion.h"
#include "sightline/bridge/scan_conversion.h"
#include "sightline/bridge/sweep_from_tf.h"
#include "sightline/lines/line_extractor.h"
#include "sightline/lines/plain_extractor.h"

namespace sightline::nodes {

namespace {

class LineExtractorNode {
 public:
  LineExtractorNode(ros::NodeHandle node, ros::NodeHandle private_node);

 private:
  void onScan(const sensor_msgs::LaserScanConstPtr& message);
  void onRangeScan(const RangeScanConstPtr& message);
  template <class AnyScan>
  void correct(AnyScan& scan);
  void extract(const scan::Scan& scan);
  void onReconfigure(const LineExtractorConfig& settings);
  void reportMotion(diagnostic_updater::DiagnosticStatusWrapper& status);

  LineExtractorNodeConfig config_;
  bridge::ScanReader reader_;
  bridge::RangeScanReader range_reader_;
  lines::LineExtractor extractor_;
  lines::PlainExtractor plain_extractor_;
  bridge::LineMarkers markers_;
  diagnostic_updater::Updater updater_;
  bridge::InputMonitor monitor_;
  std::optional<bridge::SweepFromTf> sweep_;
  std::size_t corrected_ = 0;
  std::size_t uncorrected_ = 0;
  std::size_t uncorrected_before_ = 0;  // at the last report

  boost::recursive_mutex reconfigure_mutex_;
  dynamic_reconfigure::Server<LineExtractorConfig> reconfigure_;
  ros::Publisher lines_publisher_;
  ros::Publisher marker_publisher_;
  ros::Subscriber subscriber_;
  ros::WallTimer diagnostics_timer_;
};

const char* topicOf(LineExtractorInput input) {
  return input == LineExtractorInput::kScan ? "scan" : "range_scan";
}

LineExtractorNode::LineExtractorNode(ros::NodeHandle node, ros::NodeHandle private_node)
    : config_(bridge::readParameters<LineExtractorNodeConfig>(private_node)),
      reader_(config_.noise),
      extractor_(config_.lines),
      plain_extractor_(config_.lines),
      markers_(config_.markers),
      updater_(node, private_node),
      monitor_(node.resolveName(topicOf(config_.input)), updater_),
      reconfigure_(reconfigure_mutex_, ros::NodeHandle(private_node, "lines")) {
  updater_.setHardwareID("none");
  if (!config_.fixed_frame.empty()) {
    sweep_.emplace(config_.fixed_frame);
    updater_.add("motion", this, &LineExtractorNode::reportMotion);
  }
  reconfigure_.updateConfig(bridge::toReconfigure(config_.lines));
  reconfigure_.setCallback(
      [this](LineExtractorConfig& settings, std::uint32_t) { onReconfigure(settings); });
  lines_publisher_ = node.advertise<LineSegmentArray>("lines", 10);
  marker_publisher_ = node.advertise<visualization_msgs::MarkerArray>("line_markers", 10);
  subscriber_ = config_.input == LineExtractorInput::kScan
                    ? node.subscribe("scan", 100, &LineExtractorNode::onScan, this)
                    : node.subscribe("range_scan", 100, &LineExtractorNode::onRangeScan, this);
  diagnostics_timer_ = node.createWallTimer(
      ros::WallDuration(0.5), [this](const ros::WallTimerEvent&) { updater_.update(); });
}

void LineExtractorNode::onReconfigure(const LineExtractorConfig& settings) {
  bridge::applyReconfigure(settings, config_.lines);
  extractor_ = lines::LineExtractor(config_.lines);
  plain_extractor_ = lines::PlainExtractor(config_.lines);
}

void LineExtractorNode::onScan(const sensor_msgs::LaserScanConstPtr& message) {
  try {
    scan::Scan scan = reader_.read(*message);
    correct(scan);
    extract(scan);
    monitor_.accept();
  } catch (const scan::InvalidScan& fault) {
    monitor_.drop(fault.what());
  }
}

void LineExtractorNode::onRangeScan(const RangeScanConstPtr& message) {
  try {
    motion::RangeScan range_scan = range_reader_.read(*message);
    correct(range_scan);
    extract(range_scan.scan);
    monitor_.accept();
  } catch (const scan::InvalidScan& fault) {
    monitor_.drop(fault.what());
  }
}

template <class AnyScan>
void LineExtractorNode::correct(AnyScan& scan) {
  if (sweep_) ++(sweep_->addMotion(scan) ? corrected_ : uncorrected_);
}

void LineExtractorNode::extract(const scan::Scan& scan) {
  const auto& segments = config_.method == LineMethod::kFull ? extractor_.extract(scan)
                                                             : plain_extractor_.extract(scan);
  const auto message =
      boost::make_shared<LineSegmentArray>(bridge::toMessage(segments, extractor_.arcs(), scan));
  lines_publisher_.publish(message);
  if (marker_publisher_.getNumSubscribers() > 0) {
    marker_publisher_.publish(markers_.draw(segments, extractor_.arcs(), message->header));
  }
}

void LineExtractorNode::reportMotion(diagnostic_updater::DiagnosticStatusWrapper& status) {
  const bool fine = uncorrected_ == uncorrected_before_;
  uncorrected_before_ = uncorrected_;
  status.summary(
      fine ? diagnostic_msgs::DiagnosticStatus::OK : diagnostic_msgs::DiagnosticStatus::WARN,
      fine ? "motion of the scanner is corrected" : "scans without known motion");
  status.add("fixed frame", config_.fixed_frame);
  status.add("corrected", corrected_);
  status.add("uncorrected", uncorrected_);
}

}  // namespace

std::shared_ptr<void> makeLineExtractor(ros::NodeHandle node, ros::NodeHandle private_node) {
  return std::make_shared<LineExtractorNode>(std::move(node), std::move(private_node));
}

}  // namespace sightline::nodes
