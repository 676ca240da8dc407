#include "nodes/line_controls.h"

#include "sightline/bridge/line_settings.h"

namespace sightline::nodes {

LineControls::LineControls(ros::NodeHandle private_node, const pipeline::LinesConfig& config,
                           pipeline::Estimators& estimators)
    : config_(config), reconfigure_(reconfigure_mutex_, ros::NodeHandle(private_node, "lines")) {
  reconfigure_.updateConfig(bridge::toReconfigure(config_.extractor));
  reconfigure_.setCallback([this, &estimators](LineExtractorConfig& settings, std::uint32_t) {
    bridge::applyReconfigure(settings, config_.extractor);
    estimators.configureLines(config_);
  });
}

MotionDiagnostics::MotionDiagnostics(const bridge::LiveFeed& feed,
                                     diagnostic_updater::Updater& updater)
    : feed_(feed) {
  updater.add("motion", this, &MotionDiagnostics::report);
}

void MotionDiagnostics::report(diagnostic_updater::DiagnosticStatusWrapper& status) {
  std::size_t without = 0;
  std::size_t located = 0;
  for (std::size_t i = 0; i < feed_.scanners(); ++i) {
    without += feed_.counts(i).without_motion;
    located += feed_.counts(i).located;
  }
  using diagnostic_msgs::DiagnosticStatus;
  const bool is_fine = without == without_before_;
  without_before_ = without;
  status.summary(is_fine ? DiagnosticStatus::OK : DiagnosticStatus::WARN,
                 is_fine ? "motion of the scanner is corrected" : "scans without known motion");
  status.add("corrected", located - without);
  status.add("uncorrected", without);
}

}  // namespace sightline::nodes
