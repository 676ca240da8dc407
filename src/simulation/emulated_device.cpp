#include "sightline/simulation/emulated_device.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <ctime>
#include <utility>

#include <poll.h>
#include <unistd.h>

namespace sightline::simulation {

namespace {

constexpr std::int64_t kLongestWait = 2'000'000;  // [ns]: a scan is sent no later than that

template <class Clock>
std::int64_t readClock() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now().time_since_epoch())
      .count();
}

}  // namespace

EmulatedDevice::EmulatedDevice(const std::string& path, const FirmwareConfig& config,
                               std::unique_ptr<driver::DeviceModel> model, std::uint64_t seed,
                               OnScan on_scan)
    : path_(path),
      baud_rate_(config.baud_rate),
      model_(std::move(model)),
      firmware_(config, *model_, seed),
      cable_(seed),
      on_scan_(std::move(on_scan)),
      terminal_(std::make_unique<PseudoTerminal>(path)),
      steady_origin_(readClock<std::chrono::steady_clock>()),
      system_origin_(readClock<std::chrono::system_clock>()) {
  firmware_.boot(0);
  thread_ = std::thread([this] { run(); });
}

EmulatedDevice::~EmulatedDevice() {
  ends_ = true;
  thread_.join();
}

void EmulatedDevice::post(Task task) {
  const std::lock_guard<std::mutex> lock(mutex_);
  tasks_.push_back(std::move(task));
}

void EmulatedDevice::setCable(const CableFaults& faults) {
  post([this, faults](std::int64_t) { cable_.setFaults(faults); });
}

void EmulatedDevice::setDrift(double ppm) {
  post([this, ppm](std::int64_t time) { firmware_.setDrift(ppm, time); });
}

void EmulatedDevice::stall(double seconds) {
  leave(Absence::kStall, seconds);
}

void EmulatedDevice::reboot(double seconds) {
  leave(Absence::kReboot, seconds);
}

void EmulatedDevice::disconnect(double seconds) {
  leave(Absence::kDisconnection, seconds);
}

void EmulatedDevice::leave(Absence absence, double seconds) {
  back_since_ = 0;
  post([=](std::int64_t time) {
    absence_ = absence;
    absent_until_ = time + std::llround(1e9 * seconds);
    deliveries_.clear();
    arrivals_.clear();
    if (absence == Absence::kDisconnection) terminal_.reset();
  });
}

std::int64_t EmulatedDevice::now() const {
  return readClock<std::chrono::steady_clock>() - steady_origin_;
}

void EmulatedDevice::run() {
  while (!ends_) {
    const std::int64_t time = now();
    runTasks(time);
    if (absence_ != Absence::kNone && time >= absent_until_) comeBack(time);
    work(time);
    deliver(time);
    wait(time);
  }
}

void EmulatedDevice::runTasks(std::int64_t now) {
  std::vector<Task> tasks;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    tasks.swap(tasks_);
  }
  for (const Task& task : tasks) task(now);
}

void EmulatedDevice::comeBack(std::int64_t now) {
  if (absence_ == Absence::kDisconnection) terminal_ = std::make_unique<PseudoTerminal>(path_);
  if (absence_ == Absence::kReboot) firmware_.boot(now);
  absence_ = Absence::kNone;
  back_since_ = now + steady_origin_;
}

void EmulatedDevice::work(std::int64_t now) {
  if (absence_ == Absence::kStall || absence_ == Absence::kReboot) return firmware_.sleep(now);
  listen(now);
  hear(now);
  firmware_.advance(now);
  ship();
}

void EmulatedDevice::listen(std::int64_t now) {
  if (!terminal_) return;
  std::array<std::uint8_t, 4096> buffer{};
  const ssize_t size = read(terminal_->handle(), buffer.data(), buffer.size());
  if (size <= 0) return;
  Arrival arrival{{buffer.begin(), buffer.begin() + size}, now + cable_.delay()};
  arrival.due += std::llround(1e9 * driver::lineSeconds(arrival.bytes.size(), baud_rate_));
  cable_.pass(arrival.bytes);
  if (!arrivals_.empty()) arrival.due = std::max(arrival.due, arrivals_.back().due);
  arrivals_.push_back(std::move(arrival));
}

void EmulatedDevice::hear(std::int64_t now) {
  for (; !arrivals_.empty() && arrivals_.front().due <= now; arrivals_.pop_front()) {
    const auto& bytes = arrivals_.front().bytes;
    firmware_.receive({bytes.data(), bytes.size()}, now);
  }
}

// Adapters hand over what comes in pieces; here a frame is one, once its last byte has come. None
// overtakes another.
void EmulatedDevice::ship() {
  for (SentFrame& frame : firmware_.take()) {
    Delivery delivery{std::move(frame), 0, false};
    delivery.is_whole = cable_.pass(delivery.frame.bytes);
    delivery.due = delivery.frame.sent + cable_.delay();
    if (!deliveries_.empty()) delivery.due = std::max(delivery.due, deliveries_.back().due);
    deliveries_.push_back(std::move(delivery));
  }
}

void EmulatedDevice::deliver(std::int64_t now) {
  for (; !deliveries_.empty() && deliveries_.front().due <= now; deliveries_.pop_front()) {
    Delivery& delivery = deliveries_.front();
    const auto& bytes = delivery.frame.bytes;
    const ssize_t written =
        terminal_ ? write(terminal_->handle(), bytes.data(), bytes.size()) : ssize_t{0};
    if (written > 0) bytes_sent_ += static_cast<std::size_t>(written);
    report(delivery, written == static_cast<ssize_t>(bytes.size()));
  }
}

void EmulatedDevice::report(Delivery& delivery, bool is_written) const {
  if (!on_scan_ || !delivery.frame.scan) return;
  DeliveredScan scan{std::move(*delivery.frame.scan), delivery.is_whole && is_written};
  scan.sent.scan.stamp += system_origin_;
  on_scan_(scan);
}

void EmulatedDevice::wait(std::int64_t now) const {
  std::int64_t until = now + kLongestWait;
  if (!deliveries_.empty()) until = std::min(until, deliveries_.front().due);
  if (!arrivals_.empty()) until = std::min(until, arrivals_.front().due);
  const std::int64_t left = std::max<std::int64_t>(0, until - this->now());
  const timespec timeout{0, static_cast<long>(left)};
  const bool listens = terminal_ && (absence_ == Absence::kNone);
  pollfd master{listens ? terminal_->handle() : -1, POLLIN, 0};
  ppoll(&master, 1, &timeout, nullptr);
}

}  // namespace sightline::simulation
