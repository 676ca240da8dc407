#include "sightline/bridge/input_monitor.h"

#include <ros/console.h>

namespace sightline::bridge {

namespace {

// Silence that is told of an input that has been coming.
constexpr std::chrono::seconds kSilence{5};

}  // namespace

InputMonitor::InputMonitor(std::string topic, diagnostic_updater::Updater& updater, Flow flow,
                           const std::string& type)
    : topic_(std::move(topic)), flow_(flow), missing_(topic_, type) {
  updater.add("input " + topic_, this, &InputMonitor::report);
}

void InputMonitor::accept() {
  ++accepted_;
  last_message_ = std::chrono::steady_clock::now();
}

void InputMonitor::drop(const std::string& reason) {
  count(reason);
  if (!drops_.isDue()) return;
  ROS_WARN("%s: message dropped: %s (%zu so far)", topic_.c_str(), reason.c_str(), dropped_);
}

void InputMonitor::skip(const std::string& reason) {
  count(reason);
  if (!drops_.isDue()) return;
  ROS_INFO("%s: message left out: %s (%zu so far)", topic_.c_str(), reason.c_str(), dropped_);
}

// A message that is of no use came all the same.
void InputMonitor::count(const std::string& reason) {
  last_message_ = std::chrono::steady_clock::now();
  ++dropped_;
  last_reason_ = reason;
}

void InputMonitor::note(const std::string& key, const std::string& text) {
  if (notes_.try_emplace(key, text).second) ROS_WARN("%s: %s", topic_.c_str(), text.c_str());
}

void InputMonitor::warn(const std::string& text) {
  ++warnings_[text];
  if (warned_.isDue()) ROS_WARN("%s: %s", topic_.c_str(), text.c_str());
}

MissingInput::State InputMonitor::state() const {
  using State = MissingInput::State;
  if (std::chrono::steady_clock::now() - last_message_ <= kSilence) return State::kComes;
  return accepted_ + dropped_ == 0 ? State::kNeverCame : State::kCeased;
}

std::string InputMonitor::awaited() const {
  if (accepted_ == 0 && dropped_ > 0) return topic_ + " is of no use:\n" + last_reason_;
  if (accepted_ == 0) return "nothing on " + topic_ + " yet";
  if (state() == MissingInput::State::kCeased) return "nothing on " + topic_ + " any more";
  return "";
}

void InputMonitor::report(diagnostic_updater::DiagnosticStatusWrapper& status) {
  using diagnostic_msgs::DiagnosticStatus;
  if (flow_ == Flow::kSteady) missing_.update(state());
  const bool is_silent = flow_ == Flow::kSteady && state() != MissingInput::State::kComes;
  if (dropped_ > dropped_before_) {
    status.summary(DiagnosticStatus::WARN, "dropped: " + last_reason_);
  } else if (accepted_ == 0) {
    const bool is_missed = flow_ != Flow::kPerhaps;
    status.summary(is_missed ? DiagnosticStatus::WARN : DiagnosticStatus::OK,
                   "nothing received yet");
  } else if (is_silent) {
    status.summary(DiagnosticStatus::WARN, "nothing received any more");
  } else {
    status.summary(DiagnosticStatus::OK, "receiving");
  }
  dropped_before_ = dropped_;
  status.add("used", accepted_);
  status.add("dropped", dropped_);
  status.add("last reason", last_reason_);
  for (const auto& [key, text] : notes_) status.add(key, text);
  for (const auto& [text, number] : warnings_) status.add(text, number);
  if (!noise_) return;
  status.add("noise sigma [m]", noise_->sigma);
  status.add("noise sigma per metre", noise_->sigma_per_metre);
  status.add("step of the ranges [m]", noise_->step);
}

}  // namespace sightline::bridge
