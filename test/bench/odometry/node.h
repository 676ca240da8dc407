#pragma once

#include <arpa/inet.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <map>
#include <mutex>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <sensor_msgs/LaserScan.h>

#include "sightline/bridge/scan_conversion.h"
#include "sightline/bridge/time.h"
#include "sightline/simulation/simulation.h"

/// Figures of the running node, fed with the scans of a simulated robot of 361 beams at 10 Hz.
///
/// odometry.node.cpu_percent: its share of one core. odometry.node.latency_p50_ms, p99: from the
/// moment that a scan is published to that in which its odometry has arrived.
namespace sightline::bench {

/// A program that ends with this object.
class Process {
 public:
  explicit Process(std::vector<std::string> words) : pid_(fork()) {
    if (pid_ != 0) return;
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    dup2(STDERR_FILENO, STDOUT_FILENO);  // standard output is for figures
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    execvp(arguments[0], arguments.data());
    _exit(127);
  }
  ~Process() {
    if (pid_ <= 0) return;
    kill(pid_, SIGINT);
    waitpid(pid_, nullptr, 0);
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  /// Time on a processor so far [s].
  double cpuSeconds() const {
    std::ifstream file(fmt::format("/proc/{}/stat", pid_));
    std::string text((std::istreambuf_iterator<char>(file)), {});
    std::istringstream fields(text.substr(std::min(text.size(), text.rfind(')') + 2)));
    std::string skipped;
    for (int i = 0; i < 11; ++i) fields >> skipped;
    double user = 0.0;
    double system = 0.0;
    fields >> user >> system;
    return (user + system) / static_cast<double>(sysconf(_SC_CLK_TCK));
  }

 private:
  pid_t pid_;
};

inline int freePort() {
  const int handle = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  const bool is_bound = bind(handle, reinterpret_cast<sockaddr*>(&address), size) == 0 &&
                        getsockname(handle, reinterpret_cast<sockaddr*>(&address), &size) == 0;
  close(handle);
  if (!is_bound) throw std::runtime_error("no free port");
  return ntohs(address.sin_port);
}

/// What a robot on a round tour of the demo's floor sees.
inline std::vector<scan::Scan> tourOfTheFloor(std::size_t scans) {
  const std::string source = SIGHTLINE_SOURCE_DIR;
  simulation::Simulation simulation(world::World::readFile(source + "/config/worlds/floor.yaml"),
                                    {}, geometry::Pose2(-2.2, 4.6, 0.2), 1);
  simulation::ScannerProfile profile;
  profile.beams = 361;
  profile.angle_min = geometry::radians(-90.0);
  profile.angle_max = geometry::radians(90.0);
  profile.rate = 10.0;
  simulation::Mounting mounting;
  mounting.z = 0.4;
  simulation.addScanner(profile, mounting);
  simulation.follow(simulation::Path::readFile(source + "/config/paths/floor_tour.yaml"));
  std::vector<scan::Scan> tour;
  while (tour.size() < scans) {
    for (auto& sweep : simulation.step()) tour.push_back(std::move(sweep.scan));
  }
  return tour;
}

/// Publishes scans and times the answers.
class LatencyMeter {
 public:
  LatencyMeter()
      : publisher_(node_.advertise<sensor_msgs::LaserScan>("scan", 10)),
        subscriber_(node_.subscribe("laser_odom", 100, &LatencyMeter::onOdometry, this,
                                    ros::TransportHints().tcpNoDelay())) {}

  bool isConnected() const {
    return publisher_.getNumSubscribers() > 0 && subscriber_.getNumPublishers() > 0;
  }

  void publish(scan::Scan scan) {
    scan.stamp = bridge::nanoseconds(ros::Time::now());
    scan.frame = "laser";
    const auto message = bridge::toMessage(scan);
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      sent_[scan.stamp] = Clock::now();
    }
    publisher_.publish(message);
  }

  /// [ms], of the answers since the last call.
  std::vector<double> takeLatencies() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return std::exchange(latencies_, {});
  }

 private:
  using Clock = std::chrono::steady_clock;

  void onOdometry(const nav_msgs::Odometry& message) {
    const auto now = Clock::now();
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto sent = sent_.find(bridge::nanoseconds(message.header.stamp));
    if (sent == sent_.end()) return;
    latencies_.push_back(std::chrono::duration<double, std::milli>(now - sent->second).count());
  }

  ros::NodeHandle node_;
  ros::Publisher publisher_;
  ros::Subscriber subscriber_;
  std::mutex mutex_;
  std::map<std::int64_t, Clock::time_point> sent_;
  std::vector<double> latencies_;
};

inline void waitFor(const std::function<bool()>& condition, const std::string& what) {
  for (int i = 0; i < 300; ++i) {
    if (condition()) return;
    usleep(100'000);
  }
  throw std::runtime_error("waited in vain for " + what);
}

inline void play(const std::vector<scan::Scan>& scans, std::size_t from, std::size_t to,
                 LatencyMeter& meter) {
  constexpr useconds_t kPeriod = 100'000;  // µs
  for (std::size_t i = from; i < to; ++i) {
    meter.publish(scans[i]);
    usleep(kPeriod);
  }
}

inline void measureNode() {
  constexpr std::size_t kFirst = 50;  // scans until the node has settled
  constexpr std::size_t kScans = 350;
  const auto scans = tourOfTheFloor(kScans);
  const std::string port = std::to_string(freePort());
  setenv("ROS_MASTER_URI", ("http://127.0.0.1:" + port).c_str(), 1);
  setenv("ROS_IP", "127.0.0.1", 1);
  const Process master({"roscore", "-p", port});
  ros::init(ros::M_string{}, "bench_odometry", ros::init_options::NoSigintHandler);
  waitFor([] { return ros::master::check(); }, "the master");
  const Process node({SIGHTLINE_PROGRAMS "/laser_odometry", "_mounting_timeout:=0"});
  LatencyMeter meter;
  ros::AsyncSpinner spinner(1);
  spinner.start();
  waitFor([&] { return meter.isConnected(); }, "the node");
  play(scans, 0, kFirst, meter);
  meter.takeLatencies();
  const double cpu = node.cpuSeconds();
  const auto begin = std::chrono::steady_clock::now();
  play(scans, kFirst, kScans, meter);
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
  const double used = node.cpuSeconds() - cpu;
  auto latencies = meter.takeLatencies();
  if (latencies.empty()) throw std::runtime_error("the node answered nothing");
  std::sort(latencies.begin(), latencies.end());
  const auto quantile = [&](double share) {
    return latencies[static_cast<std::size_t>(share * static_cast<double>(latencies.size() - 1))];
  };
  fmt::print("odometry.node.cpu_percent {:.2f} %\n", 100.0 * used / spent.count());
  fmt::print("odometry.node.latency_p50_ms {:.2f} ms\n", quantile(0.5));
  fmt::print("odometry.node.latency_p99_ms {:.2f} ms\n", quantile(0.99));
  fmt::print("odometry.node.answered_percent {:.1f} %\n",
             100.0 * static_cast<double>(latencies.size()) / static_cast<double>(kScans - kFirst));
  ros::shutdown();
}

}  // namespace sightline::bench
