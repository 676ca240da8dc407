#include "nodes/program.h"

#include <cstdio>
#include <exception>
#include <string>

#include <ros/ros.h>

namespace sightline::nodes {

namespace {

void printUsage(FILE* to, const char* name) {
  std::fprintf(to,
               "usage: rosrun sightline %s [_PARAMETER:=VALUE]... [TOPIC:=TOPIC]...\n"
               "A node; it needs a master (roscore, or roslaunch). Its parameters:\n"
               "  rosrun sightline describe_parameters %s\n",
               name, name);
}

// What is left of the command line without what ROS itself takes.
ros::V_string ownWords(int argc, char** argv) {
  ros::V_string words;
  ros::removeROSArgs(argc, argv, words);
  if (!words.empty()) words.erase(words.begin());
  return words;
}

int answerWords(const ros::V_string& words, const char* name) {
  const bool asks = words.front() == "--help" || words.front() == "-h";
  if (!asks) std::fprintf(stderr, "%s: unknown word '%s'\n", name, words.front().c_str());
  printUsage(asks ? stdout : stderr, name);
  return asks ? 0 : 2;
}

}  // namespace

int runNode(int argc, char** argv, const char* name, MakeNode make) {
  const ros::V_string words = ownWords(argc, argv);
  if (!words.empty()) return answerWords(words, name);
  ros::init(argc, argv, name);
  const ros::NodeHandle
      keeps_log_open;  // ROS goes down with its last handle, before the fault is told
  try {
    const auto node = make(ros::NodeHandle(), ros::NodeHandle("~"));
    ros::spin();
  } catch (const std::exception& error) {
    ROS_FATAL("%s", error.what());
    return 1;
  }
  return 0;
}

}  // namespace sightline::nodes
