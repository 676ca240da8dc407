// A synchronised-scan sensor that is not there, at a serial port that is none.
#include <array>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <poll.h>
#include <ros/init.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include "program/program.h"
#include "sightline/geometry/isometry.h"
#include "sightline/simulation/active_sensor_device.h"
#include "sightline/simulation/device_faults.h"
#include "sightline/simulation/scanner.h"

namespace {

using namespace sightline;

constexpr int kTroublePeriod = 200;  // [ms]: of looking whether the port could come back

struct Job {
  std::string port;
  std::string world;
  std::optional<std::string> profile;
  std::optional<std::string> urdf;
  std::optional<std::string> faults;
  std::array<double, 3> pose{0.0, 0.0, 0.0};
  std::uint64_t seed = 1;
};

// Standard input so far, line by line.
class Input {
 public:
  /// False at the end.
  bool read() {
    std::array<char, 4096> piece{};
    const ssize_t size = ::read(STDIN_FILENO, piece.data(), piece.size());
    if (size <= 0) return false;
    text_.append(piece.data(), static_cast<std::size_t>(size));
    return true;
  }
  std::optional<std::string> line() {
    const std::size_t end = text_.find('\n');
    if (end == std::string::npos) return std::nullopt;
    std::string line = text_.substr(0, end);
    text_.erase(0, end + 1);
    return line;
  }

 private:
  std::string text_;
};

void applyLines(Input& input, simulation::DeviceFaults& faults) {
  while (const auto line = input.line()) {
    try {
      faults.apply(*line, "standard input");
    } catch (const config::Error& error) {
      std::fprintf(stderr, "%s\n", error.what());
    }
  }
}

// Blocks the signals that end the program in all of its threads; they are read from the handle.
int catchSignals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  sigaddset(&signals, SIGHUP);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  return signalfd(-1, &signals, SFD_CLOEXEC);
}

// Says once why the port is gone although it should be there.
class TroubleReport {
 public:
  void update(const std::string& trouble) {
    if (trouble != said_ && !trouble.empty()) std::fprintf(stderr, "%s\n", trouble.c_str());
    said_ = trouble;
  }

 private:
  std::string said_;
};

// Obeys until a signal comes; standard input may end before.
void obey(simulation::EmulatedDevice& device, simulation::DeviceFaults& faults, int signals) {
  Input input;
  TroubleReport report;
  std::array<pollfd, 2> sources{pollfd{signals, POLLIN, 0}, pollfd{STDIN_FILENO, POLLIN, 0}};
  while (poll(sources.data(), sources.size(), kTroublePeriod) >= 0 && sources[0].revents == 0) {
    report.update(device.trouble());
    if (sources[1].revents == 0) continue;
    if (!input.read()) sources[1].fd = -1;
    applyLines(input, faults);
  }
}

int emulate(const Job& job, int signals) {
  simulation::ActiveSensorProfile profile;
  if (job.profile) profile = simulation::ActiveSensorProfile::readFile(*job.profile);
  if (job.urdf) profile.takeHead(driver::HeadJoint::readFile(*job.urdf, {}), *job.urdf);
  const geometry::Pose2 pose(job.pose[0], job.pose[1], job.pose[2]);
  simulation::EmulatedDevice device(
      job.port, simulation::firmwareOf(profile),
      std::make_unique<simulation::ActiveSensorDevice>(profile, world::World::readFile(job.world),
                                                       geometry::inSpace(pose), job.seed),
      job.seed);
  simulation::DeviceFaults faults(device);
  if (job.faults) faults.apply(*job.faults, "--faults");
  obey(device, faults, signals);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const int signals = catchSignals();
  Job job;
  tools::Program program(
      "sensor_emulator",
      "Speaks as a synchronised-scan sensor at a pseudo terminal, in real time. Faults are words "
      "on "
      "standard input, one a line: corrupted, dropped, bursts SHARE; delay, jitter SECONDS; drift "
      "PPM; stall, reboot, disconnect SECONDS.");
  program.positional("PORT", job.port, "path of the port to be");
  program.requiredOption("--world", job.world, "FILE.yaml", "what it sees");
  program.option("--pose", job.pose, "X Y YAW", "of its mount in the world [m, m, rad]");
  program.option("--profile", job.profile, "FILE.yaml",
                 "what it is; by default as config/sensors/synchronised_scan.yaml");
  program.option("--urdf", job.urdf, "FILE.urdf", "robot description with the limits of its head");
  program.option("--faults", job.faults, "WORDS", "faults from the start on, parted by semicolons");
  program.option("--seed", job.seed, "N", "of all noise and faults");
  // A launch file adds words of its own.
  ros::V_string words;
  ros::removeROSArgs(argc, argv, words);
  std::vector<const char*> arguments;
  for (const std::string& word : words) arguments.push_back(word.c_str());
  return program.run(static_cast<int>(arguments.size()), arguments.data(),
                     [&] { return emulate(job, signals); });
}
