// The driver against emulated devices, on pseudo terminals and in real time.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <future>
#include <numeric>
#include <random>
#include <thread>

#include <diagnostic_msgs/DiagnosticArray.h>

#include "bench/allocations.h"
#include "bench/driver/channel.h"
#include "bench/driver/foreign.h"
#include "bench/driver/head.h"
#include "bench/figures.h"
#include "driver/sample_messages.h"
#include "sightline/driver/frame_parser.h"
#include "simulation/ramp_device.h"
#include "temporary_folder.h"

namespace sightline::bench {
namespace {

constexpr double kSeconds = 60.0;  // of every run in real time
constexpr double kScanRate = 2500.0 / 256.0;

void sleepFor(double seconds) {
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
}

std::vector<std::uint8_t> recordedStream(std::uint32_t scans) {
  std::vector<std::uint8_t> stream;
  driver::FrameEncoder encoder;
  for (std::uint32_t i = 0; i < scans; ++i) {
    const auto& frame = encoder.encode({}, test::scanReport(i));
    stream.insert(stream.end(), frame.begin(), frame.end());
  }
  return stream;
}

// Parses as fast as it goes, scans decoded.
void measureParser() {
  constexpr std::uint32_t kScans = 10000;
  const auto stream = recordedStream(kScans);
  driver::FrameParser parser;
  driver::ScanReport report;
  std::size_t understood = 0;
  std::size_t allocated = 0;
  const std::int64_t began = steadyNow();
  for (std::size_t taken = 0; taken < stream.size();) {
    taken +=
        parser.append({stream.data() + taken, std::min<std::size_t>(512, stream.size() - taken)});
    while (const auto frame = parser.next()) understood += decode(*frame, report) ? 1U : 0U;
    if (understood == 1) allocated = allocations;  // since then its vectors have their size
  }
  const double seconds = 1e-9 * static_cast<double>(steadyNow() - began);
  const std::size_t allocations_after = allocations;
  if (understood != kScans) std::printf("# driver: %zu of %u scans parsed\n", understood, kScans);
  print("driver.parse_mb_per_s", 1e-6 * static_cast<double>(stream.size()) / seconds, "MB/s");
  print("driver.parse_allocations", static_cast<double>(allocations_after - allocated),
        "allocations");
  const double share = driver::lineSeconds(stream.size() / kScans, 460800) * kScanRate;
  print("driver.line_share_percent", 100.0 * share, "%");
}

std::unique_ptr<Channel> makeChannel(const std::string& name, const test::TemporaryFolder& folder,
                                     double drift = 0.0) {
  auto channel =
      std::make_unique<Channel>(name, folder.path(""), std::make_unique<test::RampDevice>(), drift);
  channel->waitForScans();
  return channel;
}

// Sends the device away again and again; the longest time from its return to its first scan [s].
class Disturbances {
 public:
  explicit Disturbances(Channel& channel) : channel_(channel) {}

  void run() {
    for (int i = 0; i < 20; ++i) {
      disturb(&simulation::EmulatedDevice::disconnect, 0.4, disconnection_);
      disturb(&simulation::EmulatedDevice::reboot, 0.4, reboot_);
      if (i % 4 == 0) disturb(&simulation::EmulatedDevice::stall, 1.2, stall_);
    }
  }
  void printFigures() const {
    print("driver.reconnect_max_s", std::max({disconnection_, reboot_, stall_}), "s");
    std::printf("# driver.reconnect: after disconnections %.3f s, reboots %.3f s, stalls %.3f s\n",
                disconnection_, reboot_, stall_);
  }

 private:
  void disturb(void (simulation::EmulatedDevice::*leave)(double), double seconds, double& longest) {
    sleepFor(std::uniform_real_distribution<>(0.2, 0.4)(random_));
    (channel_.device().*leave)(seconds);
    while (channel_.device().backSince() == 0) sleepFor(0.001);
    const std::int64_t back = channel_.device().backSince();
    longest = std::max(longest, 1e-9 * static_cast<double>(channel_.arrivalAfter(back) - back));
  }

  Channel& channel_;
  std::mt19937_64 random_{20261122};
  double disconnection_ = 0.0;
  double reboot_ = 0.0;
  double stall_ = 0.0;
};

// Last report of a driver's diagnostics on its device.
class LastStatus {
 public:
  explicit LastStatus(std::string node) : name_(std::move(node) + ": device") {}
  std::string text() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return text_;
  }

 private:
  void onDiagnostics(const diagnostic_msgs::DiagnosticArrayConstPtr& array) {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (const auto& status : array->status) {
      if (status.name == name_) text_ = status.message;
    }
  }
  std::string name_;
  mutable std::mutex mutex_;
  std::string text_;
  ros::Subscriber subscriber_ =
      ros::NodeHandle().subscribe("/diagnostics", 100, &LastStatus::onDiagnostics, this);
};

void describe(const char* name, const Channel::Verdict& verdict) {
  std::printf(
      "# driver.%s: %zu scans arrived whole, %zu broken; bad published %zu, good lost %zu\n", name,
      verdict.whole, verdict.broken, verdict.bad_published, verdict.good_lost);
}

double rms(const std::vector<double>& values) {
  const double sum = std::inner_product(values.begin(), values.end(), values.begin(), 0.0);
  return std::sqrt(sum / static_cast<double>(values.size()));
}

simulation::CableFaults faults(double corrupted, double bursts, double delay, double jitter) {
  simulation::CableFaults result;
  result.corrupted = corrupted;
  result.bursts = bursts;
  result.delay = delay;
  result.jitter = jitter;
  return result;
}

// A channel with its delays from the first byte on, as a cable has them.
std::unique_ptr<Channel> makeLateChannel(const test::TemporaryFolder& folder) {
  auto channel = std::make_unique<Channel>("late", folder.path(""),
                                           std::make_unique<test::RampDevice>(), 100.0);
  channel->device().setCable(faults(0.0, 0.0, 0.002, 0.005));
  channel->waitForScans();
  return channel;
}

// All at once: each has a port and a process of its own.
void measureCables() {
  const test::TemporaryFolder folder;
  const auto clean = makeChannel("clean", folder);
  const auto late = makeLateChannel(folder);
  const auto corrupted = makeChannel("corrupted", folder);
  const auto bursts = makeChannel("bursts", folder);
  const auto ruined = makeChannel("ruined", folder);
  const auto unsteady = makeChannel("unsteady", folder);
  const LastStatus ruined_status("ruined/sync_scan_driver");
  corrupted->device().setCable(faults(1e-5, 0.0, 0.0, 0.0));
  bursts->device().setCable(faults(0.0, 0.05, 0.0, 0.0));
  ruined->device().setCable(faults(0.01, 0.0, 0.0, 0.0));
  Disturbances disturbances(*unsteady);
  auto disturber = std::async(std::launch::async, [&] { disturbances.run(); });
  const double cpu_before = clean->driver().cpuSeconds();
  sleepFor(kSeconds);
  const double cpu = clean->driver().cpuSeconds() - cpu_before;
  disturber.get();

  const auto all = clean->judge();  // what did not arrive whole, the driver did not fetch in time
  print("driver.lost_scans", static_cast<double>(all.good_lost + all.broken), "scans");
  print("driver.cpu_percent", 100.0 * cpu / kSeconds, "%");
  print("driver.stamp_rms_ms", 1e3 * rms(late->judge().stamp_errors), "ms");
  const auto few = corrupted->judge();
  const auto many = bursts->judge();
  const auto most = ruined->judge();
  describe("corrupted", few);
  describe("bursts", many);
  describe("ruined", most);
  std::printf("# driver.ruined: diagnostics say '%s'\n", ruined_status.text().c_str());
  print("driver.bad_scans_published",
        static_cast<double>(few.bad_published + many.bad_published + most.bad_published), "scans");
  print("driver.good_scans_lost", static_cast<double>(few.good_lost + many.good_lost), "scans");
  disturbances.printFigures();
}

void measureHead() {
  const test::TemporaryFolder folder;
  HeadSteps(folder.path("")).run();
}

void measureForeignDevice() {
  const test::TemporaryFolder folder;
  ForeignDevice(folder.path("")).run();
}

int run() {
  measureParser();
  const Master master;
  ros::AsyncSpinner spinner(2);
  spinner.start();
  std::fprintf(stderr, "driver: six cables for %.0f s\n", kSeconds);
  measureCables();
  std::fprintf(stderr, "driver: steps of the head\n");
  measureHead();
  std::fprintf(stderr, "driver: a device written from the document alone\n");
  measureForeignDevice();
  return 0;
}

}  // namespace
}  // namespace sightline::bench

int main() {
  try {
    return sightline::bench::run();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "driver: %s\n", error.what());
    return 1;
  }
}
