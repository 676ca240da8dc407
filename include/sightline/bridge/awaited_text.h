#pragma once

#include <functional>
#include <string>

#include <ros/node_handle.h>
#include <ros/steady_timer.h>

namespace sightline::bridge {

/// Writes into rviz what a node waits for, on the topic `awaited`, so that a picture is not empty
/// before the first scan. Looks once a second of real time; the text goes when nothing is awaited.
class AwaitedText {
 public:
  /// Text of what is awaited; empty: nothing.
  using Awaited = std::function<std::string()>;

  /// The text stands above the origin of `frame`.
  AwaitedText(ros::NodeHandle node, const std::string& frame, Awaited awaited);
  // Its timer refers to it.
  AwaitedText(const AwaitedText&) = delete;
  AwaitedText& operator=(const AwaitedText&) = delete;

 private:
  void update();

  std::string frame_;
  Awaited awaited_;
  ros::Publisher publisher_;
  bool is_shown_ = false;
  ros::SteadyTimer timer_;
};

}  // namespace sightline::bridge
