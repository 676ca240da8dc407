#pragma once

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <ros/callback_queue.h>
#include <ros/master.h>
#include <ros/ros.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

namespace sightline::bench {

/// A process of our own, ended with the object.
class Process {
 public:
  explicit Process(std::vector<std::string> words) {
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    std::fflush(stdout);
    pid_ = fork();
    if (pid_ != 0) return;
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    dup2(STDERR_FILENO, STDOUT_FILENO);  // standard output is for figures
    execvp(arguments[0], arguments.data());
    _exit(127);
  }
  ~Process() {
    kill(pid_, SIGINT);
    waitpid(pid_, nullptr, 0);
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  /// User and system time so far [s].
  double cpuSeconds() const {
    std::ifstream stat("/proc/" + std::to_string(pid_) + "/stat");
    std::string line;
    std::getline(stat, line);
    std::istringstream fields(line.substr(line.rfind(')') + 2));
    std::string skipped;
    for (int i = 3; i < 14; ++i) fields >> skipped;
    double user = 0.0;
    double system = 0.0;
    fields >> user >> system;
    return (user + system) / static_cast<double>(sysconf(_SC_CLK_TCK));
  }

  /// Most memory that it has had at a time [MB].
  double peakMegabytes() const {
    std::ifstream status("/proc/" + std::to_string(pid_) + "/status");
    for (std::string line; std::getline(status, line);) {
      if (line.rfind("VmHWM:", 0) == 0) return std::stod(line.substr(6)) / 1024.0;
    }
    return 0.0;
  }

 private:
  pid_t pid_ = -1;
};

/// Load of a process [% of a core] over a time [s].
inline double loadOf(const Process& process, double seconds) {
  const double before = process.cpuSeconds();
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
  return 100.0 * (process.cpuSeconds() - before) / seconds;
}

inline int freePort() {
  const int handle = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t length = sizeof(address);
  bind(handle, reinterpret_cast<sockaddr*>(&address), length);
  getsockname(handle, reinterpret_cast<sockaddr*>(&address), &length);
  close(handle);
  return ntohs(address.sin_port);
}

/// A master of our own; while it lives, this process is a ROS node of it.
class Master {
 public:
  Master() : port_(std::to_string(freePort())), process_({"rosmaster", "--core", "-p", port_}) {
    setenv("ROS_MASTER_URI", ("http://127.0.0.1:" + port_).c_str(), 1);
    setenv("ROS_IP", "127.0.0.1", 1);
    ros::init(ros::VP_string(), "bench", ros::init_options::NoSigintHandler);
    while (!ros::master::check()) std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  ~Master() { ros::shutdown(); }

 private:
  std::string port_;
  Process process_;
};

/// Load of a node that answers messages.
struct NodeLoad {
  std::vector<double> latencies_ms;  ///< from publishing a message to having its answer
  double cpu_percent = 0.0;          ///< of a core
};

/// Sends a node messages at a steady rate, stamped as steadily, whatever this process is late by.
/// The answer has to repeat the stamp.
template <class Message, class Answer>
NodeLoad measureNode(const std::vector<std::string>& command, const std::string& in,
                     const std::string& out, const std::vector<Message>& messages, double rate,
                     double seconds) {
  using Clock = std::chrono::steady_clock;
  const Master master;
  const Process node(command);
  ros::NodeHandle handle;
  ros::Publisher publisher = handle.advertise<Message>(in, 10);
  NodeLoad load;
  std::map<ros::Time, Clock::time_point> sent;
  const boost::function<void(const boost::shared_ptr<const Answer>&)> receive =
      [&](const boost::shared_ptr<const Answer>& answer) {
        const auto found = sent.find(answer->header.stamp);
        if (found == sent.end()) return;
        const std::chrono::duration<double, std::milli> latency = Clock::now() - found->second;
        load.latencies_ms.push_back(latency.count());
      };
  ros::Subscriber subscriber =
      handle.subscribe<Answer>(out, 10, receive, {}, ros::TransportHints().tcpNoDelay());
  const auto patience = Clock::now() + std::chrono::seconds(20);
  while (publisher.getNumSubscribers() == 0 || subscriber.getNumPublishers() == 0) {
    if (Clock::now() > patience) throw std::runtime_error(command.front() + " does not answer");
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    ros::spinOnce();
  }
  const double cpu_before = node.cpuSeconds();
  const auto began = Clock::now();
  const ros::Time first = ros::Time::now();
  const auto count = static_cast<std::size_t>(rate * seconds);
  for (std::size_t i = 0; i < count; ++i) {
    const auto due = began + std::chrono::duration_cast<Clock::duration>(
                                 std::chrono::duration<double>(static_cast<double>(i) / rate));
    while (Clock::now() < due) {
      ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.0005));
    }
    Message message = messages[i % messages.size()];
    message.header.stamp = first + ros::Duration(static_cast<double>(i) / rate);
    sent[message.header.stamp] = Clock::now();
    publisher.publish(message);
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  ros::spinOnce();
  const std::chrono::duration<double> took = Clock::now() - began;
  load.cpu_percent = 100.0 * (node.cpuSeconds() - cpu_before) / took.count();
  return load;
}

}  // namespace sightline::bench
