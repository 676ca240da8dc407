#pragma once

#include <initializer_list>
#include <string>

#include <gtest/gtest.h>
#include <ros/ros.h>
#include <std_srvs/SetBool.h>

#include "nodes/connections.h"

namespace sightline::test {

/// Lets the paused player of replay.launch go on once the estimators hear these topics from it,
/// however long a busy machine takes to start them.
inline void resumePlayer(std::initializer_list<const char*> topics) {
  const std::string pause = "player/pause_playback";
  ASSERT_TRUE(ros::service::waitForService(pause, 60000));
  for (const char* topic : topics) waitForConnection("/player", topic, "/estimators");
  std_srvs::SetBool resume;
  resume.request.data = false;
  ASSERT_TRUE(ros::service::call(pause, resume) && resume.response.success);
}

}  // namespace sightline::test
