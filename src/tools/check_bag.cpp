// Tells in one page what is in recordings and what is wrong with it.
#include <cstdio>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include <rosbag/bag.h>
#include <rosbag/view.h>

#include "program/program.h"
#include "sightline/bridge/recording_check.h"
#include "sightline/bridge/time.h"
#include "sightline/config/error.h"
#include "sightline/pipeline/estimators_config.h"

namespace {

using namespace sightline;

struct Job {
  std::vector<std::string> in;
  std::optional<std::string> config;
  std::optional<std::string> write_config;
  std::optional<std::string> plot;
};

template <class Message>
bool offer(const rosbag::MessageInstance& instance, bridge::RecordingCheck& check) {
  const auto message = instance.instantiate<Message>();
  if (message) check.take(instance.getTopic(), *message, bridge::nanoseconds(instance.getTime()));
  return message != nullptr;
}

void take(const rosbag::MessageInstance& instance, bridge::RecordingCheck& check) {
  check.count(instance.getTopic(), instance.getDataType());
  if (const auto transforms = instance.instantiate<tf2_msgs::TFMessage>()) {
    return check.take(instance.getTopic(), *transforms);
  }
  offer<sensor_msgs::LaserScan>(instance, check) ||
      offer<sensor_msgs::MultiEchoLaserScan>(instance, check) ||
      offer<nav_msgs::Odometry>(instance, check) || offer<sensor_msgs::Imu>(instance, check);
}

void read(const std::string& path, bridge::RecordingCheck& check) {
  try {
    const rosbag::Bag bag(path);
    rosbag::View view(bag);
    for (const rosbag::MessageInstance& instance : view) take(instance, check);
  } catch (const ros::Exception& fault) {
    throw config::Error(path, 0, "", fault.what());
  }
}

void write(const std::string& path, const std::string& text) {
  std::ofstream file(path);
  if (!(file << text).flush()) throw config::Error(path, 0, "", "cannot be written");
}

pipeline::Frames framesOf(const Job& job) {
  return job.config ? pipeline::EstimatorsConfig::readFile(*job.config).frames : pipeline::Frames{};
}

int runCheck(const Job& job) {
  bridge::RecordingCheck check(framesOf(job));
  for (const std::string& path : job.in) read(path, check);
  const bridge::RecordingReport report = check.report(job.in);
  std::fputs(report.text().c_str(), stdout);
  if (job.write_config) write(*job.write_config, report.settings);
  if (job.plot && !report.figure.panels.empty()) plot::writePng(report.figure, *job.plot);
  return report.exitStatus();
}

}  // namespace

int main(int argc, char** argv) {
  Job job;
  tools::Program program("check_bag",
                         "Tells in one page what is in recordings and what is wrong with it. Ends "
                         "with status 0 where all is well, 3 with errors, 4 with warnings.");
  program.positionals("BAG", job.in, "the bags to read, as one");
  program.option("--config", job.config, "FILE.yaml", "settings whose frames are looked for");
  program.option("--write-config", job.write_config, "FILE.yaml",
                 "writes settings for `offline` and `replay.launch`");
  program.option("--plot", job.plot, "FILE.png", "draws stamps, ranges, paths and the first scan");
  return program.run(argc, argv, [&] { return runCheck(job); });
}
