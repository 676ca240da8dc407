#include <memory>
#include <optional>

#include <ros/ros.h>

#include "nodes/line_controls.h"
#include "nodes/line_extractor_config.h"
#include "sightline/bridge/feature_output.h"
#include "sightline/bridge/line_output.h"
#include "sightline/bridge/live_feed.h"
#include "sightline/bridge/node_diagnostics.h"
#include "sightline/bridge/parameters.h"

namespace sightline::nodes {

namespace {

pipeline::EstimatorsConfig estimatorsOf(const LineExtractorNodeConfig& config) {
  pipeline::EstimatorsConfig result;
  result.input = config.topics.input;
  result.frames = config.topics.frames;
  result.lines = config.lines;
  result.features = config.features;
  return result;
}

LineExtractorNodeConfig readLineExtractorConfig(const ros::NodeHandle& private_node) {
  auto config = bridge::readParameters<LineExtractorNodeConfig>(private_node);
  if (!config.fixed_frame.empty()) config.topics.frames.odom = config.fixed_frame;
  config.topics.frames = config.topics.frames.withoutSlashes();
  return config;
}

// Needs nothing without a fixed frame, so that no scan waits.
pipeline::FeedNeeds needsOf(const LineExtractorNodeConfig& config) {
  const bool moves = !config.fixed_frame.empty();
  const bool is_masked = !config.topics.input.feed.body.empty();
  return {moves || is_masked || config.topics.input.leans, moves};
}

class LineExtractorNode {
 public:
  LineExtractorNode(ros::NodeHandle node, ros::NodeHandle private_node)
      : config_(readLineExtractorConfig(private_node)),
        estimators_(estimatorsOf(config_), {true, false, false, !config_.fixed_frame.empty()}),
        diagnostics_(node, private_node),
        output_(node),
        lines_(output_, config_.topics.input, config_.markers),
        controls_(private_node, config_.lines, estimators_),
        feed_(node, config_.topics.input, config_.topics.frames, needsOf(config_),
              diagnostics_.updater(),
              [this](pipeline::LocatedScan located) { take(std::move(located)); }) {
    if (config_.fixed_frame.empty()) return;
    motion_.emplace(feed_, diagnostics_.updater());
    features_.emplace(output_, config_.topics.frames);
  }

 private:
  void take(pipeline::LocatedScan located) {
    const auto estimates = estimators_.take(std::move(located));
    lines_.write(estimates);
    if (features_) features_->write(estimates);
  }

  LineExtractorNodeConfig config_;
  pipeline::Estimators estimators_;
  bridge::NodeDiagnostics diagnostics_;
  bridge::Output output_;
  bridge::LineOutput lines_;
  std::optional<bridge::FeatureOutput> features_;
  LineControls controls_;
  bridge::LiveFeed feed_;
  std::optional<MotionDiagnostics> motion_;
};

}  // namespace

std::shared_ptr<void> makeLineExtractor(ros::NodeHandle node, ros::NodeHandle private_node) {
  return std::make_shared<LineExtractorNode>(std::move(node), std::move(private_node));
}

}  // namespace sightline::nodes
