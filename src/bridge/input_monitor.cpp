#include "sightline/bridge/input_monitor.h"

#include <ros/console.h>

namespace sightline::bridge {

InputMonitor::InputMonitor(std::string topic, diagnostic_updater::Updater& updater)
    : topic_(std::move(topic)) {
  updater.add("input " + topic_, this, &InputMonitor::report);
}

void InputMonitor::drop(const std::string& reason) {
  count(reason);
  ROS_WARN_THROTTLE(10.0, "%s: message dropped: %s (%zu so far)", topic_.c_str(), reason.c_str(),
                    dropped_);
}

void InputMonitor::skip(const std::string& reason) {
  count(reason);
  ROS_INFO_THROTTLE(10.0, "%s: message left out: %s (%zu so far)", topic_.c_str(), reason.c_str(),
                    dropped_);
}

void InputMonitor::count(const std::string& reason) {
  ++dropped_;
  last_reason_ = reason;
}

void InputMonitor::report(diagnostic_updater::DiagnosticStatusWrapper& status) {
  if (dropped_ > dropped_before_) {
    status.summary(diagnostic_msgs::DiagnosticStatus::WARN, "dropped: " + last_reason_);
  } else if (accepted_ == 0) {
    status.summary(diagnostic_msgs::DiagnosticStatus::WARN, "nothing received yet");
  } else {
    status.summary(diagnostic_msgs::DiagnosticStatus::OK, "receiving");
  }
  dropped_before_ = dropped_;
  status.add("used", accepted_);
  status.add("dropped", dropped_);
  status.add("last reason", last_reason_);
  if (!noise_) return;
  status.add("noise sigma [m]", noise_->sigma);
  status.add("noise sigma per metre", noise_->sigma_per_metre);
  status.add("step of the ranges [m]", noise_->step);
}

}  // namespace sightline::bridge
