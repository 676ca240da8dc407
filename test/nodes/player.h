#pragma once

#include <string>

#include <gtest/gtest.h>
#include <ros/ros.h>
#include <std_srvs/SetBool.h>

namespace sightline::test {

/// Lets the paused player of replay.launch go on once the estimators have offered a service of
/// theirs and are connected to it, however long a busy machine takes to start them.
inline void resumePlayer(const std::string& service) {
  const std::string pause = "player/pause_playback";
  ASSERT_TRUE(ros::service::waitForService(service, 60000));
  ASSERT_TRUE(ros::service::waitForService(pause, 60000));
  ros::WallDuration(2.0).sleep();
  std_srvs::SetBool resume;
  resume.request.data = false;
  ASSERT_TRUE(ros::service::call(pause, resume) && resume.response.success);
}

}  // namespace sightline::test
