// Whether a device keeps to docs/wire_format.md: a page of results for those who write its
// firmware.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <mutex>
#include <thread>
#include <utility>

#include <fmt/format.h>

#include "program/program.h"
#include "sightline/driver/device_check.h"
#include "sightline/triangulation/sensor_profile.h"

namespace {

using namespace sightline;
using driver::CheckResult;
using driver::TimedScan;

struct Job {
  std::string port;
  std::optional<std::string> calibration;
  std::uint64_t baud_rate = 460800;
  double seconds = 10.0;
  double wall = 0.0;
  bool head = false;
};

constexpr double kTurn = 0.15;  // [rad]: a tenth of a right angle, with much of the view shared

void waitFor(double seconds) {
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
}

// Scans as they come, from the thread of the session.
class Collector {
 public:
  void take(const triangulation::RawScan& scan) {
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    const auto arrival = std::chrono::duration_cast<std::chrono::nanoseconds>(now).count();
    const std::lock_guard<std::mutex> lock(mutex_);
    scans_.push_back({scan, 1e-9 * static_cast<double>(arrival - scan.stamp)});
  }
  std::vector<TimedScan> during(double seconds) {
    clear();
    waitFor(seconds);
    return clear();
  }

 private:
  std::vector<TimedScan> clear() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return std::exchange(scans_, {});
  }

  std::mutex mutex_;
  std::vector<TimedScan> scans_;
};

triangulation::Calibration calibrationOf(const Job& job) {
  if (job.calibration) return triangulation::Calibration::readFile(*job.calibration);
  return triangulation::SensorProfile{}.calibrated();
}

bool startsWithin(const driver::DeviceSession& session, double seconds) {
  for (double waited = 0.0; waited < seconds; waited += 0.05) {
    if (session.status().is_scanning) return true;
    waitFor(0.05);
  }
  return false;
}

// Turns it away from the nearer limit, and back.
std::vector<CheckResult> checkHead(const driver::DeviceCheck& check, driver::DeviceSession& session,
                                   Collector& collector) {
  using Mode = motion::HeadCommand::Mode;
  const auto sendTo = [&](double position) {
    session.command({Mode::kPosition, position, 0.0});
    waitFor(1.0);
  };
  sendTo(0.0);
  const auto before = collector.during(1.0);
  sendTo(kTurn);
  const auto after = collector.during(1.0);
  sendTo(0.0);
  return check.ofHead(before, after, kTurn);
}

// False where something is wrong.
bool print(const std::vector<CheckResult>& results) {
  using Verdict = CheckResult::Verdict;
  bool all_right = true;
  for (const CheckResult& result : results) {
    const char* verdict = result.verdict == Verdict::kRight   ? "right"
                          : result.verdict == Verdict::kWrong ? "WRONG"
                                                              : "open ";
    fmt::print("{}  {:<9} {}\n", verdict, result.subject, result.found);
    all_right = all_right && result.verdict != Verdict::kWrong;
  }
  return all_right;
}

int check(const Job& job) {
  if (!(job.seconds >= 1.0)) throw tools::UsageError("--seconds has to be at least 1");
  const auto calibration = calibrationOf(job);
  const auto& sensor = calibration.parameters;
  driver::SessionConfig config;
  config.port = job.port;
  config.baud_rate = static_cast<int>(job.baud_rate);
  config::validate(config, "command line");
  Collector collector;
  driver::DeviceSession session(
      config,
      {sensor.serial, static_cast<std::size_t>(sensor.scan.beams), 1.0 / sensor.scan.sample_rate},
      {}, [&](const triangulation::RawScan& scan) { collector.take(scan); });
  if (!startsWithin(session, 5.0)) {
    const auto status = session.status();
    fmt::print("WRONG  device    {}\n",
               status.trouble.text.empty() ? "connecting for 5 s" : status.trouble.text);
    return 1;
  }
  const auto began = std::chrono::steady_clock::now();
  fmt::print(stderr, "listening for {:.0f} s\n", job.seconds);
  const driver::DeviceCheck check(calibration);
  auto scans = collector.during(job.seconds);
  // The first scans come before the pings have told the latency.
  const std::size_t first = std::min<std::size_t>(5, scans.size());
  scans.erase(scans.begin(), scans.begin() + static_cast<std::ptrdiff_t>(first));
  std::vector<CheckResult> results{check.ofTiming(scans), check.ofLight(scans)};
  if (job.wall > 0.0) results.push_back(check.ofWall(scans, job.wall));
  if (job.head) {
    const auto found = checkHead(check, session, collector);
    results.insert(results.end(), found.begin(), found.end());
  }
  const std::chrono::duration<double> listened = std::chrono::steady_clock::now() - began;
  const auto of_session = check.ofSession(session.status(), listened.count());
  results.insert(results.begin(), of_session.begin(), of_session.end());
  return print(results) ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  Job job;
  tools::Program program("check_device",
                         "Checks that a device at a serial port keeps to docs/wire_format.md. Ends "
                         "with 0 only if nothing is wrong.");
  program.positional("PORT", job.port, "path of the serial port");
  program.option("--calibration", job.calibration, "FILE.yaml",
                 "of the device, by calibrate_sensor; by default as "
                 "config/sensors/synchronised_scan.yaml");
  program.option("--baud-rate", job.baud_rate, "BITS/S", "of the line; default 460800");
  program.option("--seconds", job.seconds, "S", "of listening; default 10");
  program.option(
      "--wall", job.wall, "METRES",
      "depth of a flat wall across the line of sight, from the scan's origin: tells order "
      "and unit of the currents");
  program.flag("--head", job.head,
               "turns the head to the left and back: tells its sense and that of the sweep");
  return program.run(argc, argv, [&] { return check(job); });
}
