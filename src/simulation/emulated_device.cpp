#include "sightline/simulation/emulated_device.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <ctime>
#include <utility>

#include <poll.h>
#include <unistd.h>

#include "sightline/config/error.h"

namespace sightline::simulation {

namespace {

constexpr std::int64_t kLongestWait = 2'000'000;    // [ns]: a scan is sent no later than that
constexpr std::int64_t kRetryPeriod = 100'000'000;  // [ns]: of making a port that cannot be made

template <class Clock>
std::int64_t readClock() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now().time_since_epoch())
      .count();
}

std::int64_t nanoseconds(double seconds) {
  return std::llround(1e9 * seconds);
}

}  // namespace

EmulatedDevice::EmulatedDevice(const std::string& path, const FirmwareConfig& config,
                               std::unique_ptr<DeviceModel> model, std::uint64_t seed,
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
  leave([=](std::int64_t time) { fallSilent(time, time + nanoseconds(seconds)); });
}

void EmulatedDevice::reboot(double seconds) {
  leave([=](std::int64_t time) {
    fallSilent(time, time + nanoseconds(seconds));
    forgetDeliveries();
    boots_ = true;
  });
}

void EmulatedDevice::disconnect(double seconds) {
  leave([=](std::int64_t time) { unplug(time, time + nanoseconds(seconds)); });
}

void EmulatedDevice::leave(Task task) {
  const std::lock_guard<std::mutex> lock(mutex_);
  back_since_ = 0;
  tasks_.push_back([=](std::int64_t time) {
    is_away_ = true;
    if (!is_silent_) cut(time);
    arrivals_.clear();
    task(time);
  });
}

std::string EmulatedDevice::trouble() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return trouble_;
}

std::int64_t EmulatedDevice::now() const {
  return readClock<std::chrono::steady_clock>() - steady_origin_;
}

void EmulatedDevice::run() {
  while (!ends_) {
    const std::int64_t time = now();
    runTasks(time);
    if (is_away_) comeBack(time);
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

// Bytes on their way wait as long as the device does.
void EmulatedDevice::fallSilent(std::int64_t now, std::int64_t until) {
  const std::int64_t from = is_silent_ ? silent_until_ : now;
  is_silent_ = true;
  if (until <= from) return;
  silent_until_ = until;
  for (Delivery& delivery : deliveries_) delivery.due += until - from;
}

void EmulatedDevice::unplug(std::int64_t now, std::int64_t until) {
  unplugged_until_ = std::max(until, terminal_ ? now : unplugged_until_);
  forgetDeliveries();
  terminal_.reset();
}

void EmulatedDevice::comeBack(std::int64_t now) {
  if (is_silent_ && now >= silent_until_) {
    is_silent_ = false;
    if (std::exchange(boots_, false)) firmware_.boot(now);
  }
  if (!terminal_ && now >= unplugged_until_) plugIn(now);
  if (is_silent_ || !terminal_) return;
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!tasks_.empty()) return;  // it may have been told to leave again
  is_away_ = false;
  back_since_ = now + steady_origin_;
}

void EmulatedDevice::plugIn(std::int64_t now) {
  std::string trouble;
  try {
    terminal_ = std::make_unique<PseudoTerminal>(path_);
  } catch (const config::Error& error) {
    trouble = error.what();
    terminal_.reset();
    is_away_ = true;
    unplugged_until_ = now + kRetryPeriod;
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  trouble_ = trouble;
}

void EmulatedDevice::work(std::int64_t now) {
  listen(now);
  if (is_silent_) return firmware_.sleep(now);
  hear(now);
  firmware_.advance(now);
  ship();
}

// Bytes that come while the device is silent are lost; they would be obeyed late otherwise.
void EmulatedDevice::listen(std::int64_t now) {
  if (!terminal_) return;
  std::array<std::uint8_t, 4096> buffer{};
  const ssize_t size = read(terminal_->handle(), buffer.data(), buffer.size());
  if (size < 0 && errno == EIO) return plugIn(now);  // for whoever comes next
  if (size <= 0 || is_silent_) return;
  Arrival arrival{{buffer.begin(), buffer.begin() + size}, now + cable_.delay()};
  arrival.due += nanoseconds(driver::lineSeconds(arrival.bytes.size(), baud_rate_));
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
  if (is_silent_) return;
  for (; !deliveries_.empty() && deliveries_.front().due <= now; deliveries_.pop_front()) {
    Delivery& delivery = deliveries_.front();
    const auto& bytes = delivery.frame.bytes;
    if (!send(bytes.data(), bytes.size())) delivery.is_whole = false;
    report(delivery);
  }
}

// Delivers what has come up to now, also of the frame that is still coming; its rest stays.
void EmulatedDevice::cut(std::int64_t now) {
  deliver(now);
  if (deliveries_.empty()) return;
  Delivery& delivery = deliveries_.front();
  auto& bytes = delivery.frame.bytes;
  const double left = 1e-9 * static_cast<double>(delivery.due - now) /
                      driver::lineSeconds(std::max<std::size_t>(1, bytes.size()), baud_rate_);
  const double share = 1.0 - std::min(1.0, left);
  const auto come = static_cast<std::ptrdiff_t>(share * static_cast<double>(bytes.size()));
  if (!send(bytes.data(), static_cast<std::size_t>(come))) delivery.is_whole = false;
  bytes.erase(bytes.begin(), bytes.begin() + come);
}

void EmulatedDevice::forgetDeliveries() {
  for (Delivery& delivery : deliveries_) {
    delivery.is_whole = false;
    report(delivery);
  }
  deliveries_.clear();
}

// Whether there was room for all of it.
bool EmulatedDevice::send(const std::uint8_t* bytes, std::size_t size) {
  if (size == 0) return true;
  const ssize_t written = terminal_ ? write(terminal_->handle(), bytes, size) : ssize_t{0};
  return written == static_cast<ssize_t>(size);
}

void EmulatedDevice::report(Delivery& delivery) const {
  if (!on_scan_ || !delivery.frame.scan) return;
  DeliveredScan scan{std::move(*delivery.frame.scan), delivery.is_whole};
  scan.sent.scan.stamp += system_origin_;
  scan.sent.measured.stamp += system_origin_;
  on_scan_(scan);
}

void EmulatedDevice::wait(std::int64_t now) const {
  std::int64_t until = now + kLongestWait;
  if (!deliveries_.empty()) until = std::min(until, deliveries_.front().due);
  if (!arrivals_.empty()) until = std::min(until, arrivals_.front().due);
  const std::int64_t left = std::max<std::int64_t>(0, until - this->now());
  const timespec timeout{0, static_cast<long>(left)};
  pollfd master{terminal_ ? terminal_->handle() : -1, POLLIN, 0};
  ppoll(&master, 1, &timeout, nullptr);
}

}  // namespace sightline::simulation
