#pragma once

#include <mutex>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <ros/ros.h>

namespace sightline::test {

/// Everything that comes on a topic.
template <class Message>
class Recorder {
 public:
  explicit Recorder(const std::string& topic)
      : subscriber_(ros::NodeHandle().subscribe(topic, 1000, &Recorder::onMessage, this)) {}

  std::size_t count() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return messages_.size();
  }

  std::uint32_t publishers() const { return subscriber_.getNumPublishers(); }

  std::vector<Message> all() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return messages_;
  }

  /// The messages so far, once there are so many; fails the test if they do not come.
  std::vector<Message> atLeast(std::size_t wanted) const {
    for (int i = 0; i < 6000 && ros::ok(); ++i) {
      if (count() >= wanted) return all();
      ros::WallDuration(0.01).sleep();
    }
    ADD_FAILURE() << "no " << wanted << " messages on " << subscriber_.getTopic();
    return {};
  }

  /// The first message from now on.
  Message next() const {
    const auto messages = atLeast(count() + 1);
    return messages.empty() ? Message() : messages.back();
  }

 private:
  void onMessage(const typename Message::ConstPtr& message) {
    const std::lock_guard<std::mutex> lock(mutex_);
    messages_.push_back(*message);
  }

  mutable std::mutex mutex_;
  std::vector<Message> messages_;
  ros::Subscriber subscriber_;
};

}  // namespace sightline::test
