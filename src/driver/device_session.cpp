#include "sightline/driver/device_session.h"

#include <cmath>

#include <boost/asio/buffer.hpp>
#include <boost/asio/post.hpp>

#include "sightline/driver/port_name.h"

namespace sightline::driver {

namespace {

constexpr std::chrono::milliseconds kTick{20};
constexpr std::chrono::milliseconds kRetryPeriod{100};  // with a port that is somebody else's, say

}  // namespace

void SessionConfig::visit(config::FieldVisitor& visitor) {
  visitor.text("port", port, "path of the serial port");
  visitor.integer("baud_rate", baud_rate, {"bit/s", {9600.0, 4e6}, "of the serial line"});
  visitor.group("clock", clock);
}

DeviceSession::DeviceSession(const SessionConfig& config, const ExpectedDevice& device,
                             const motion::HeadLimits& head, Conversation::OnScan on_scan)
    : config_(config),
      line_(context_),
      timer_(context_),
      conversation_({device, config.baud_rate, config.clock, head}, std::move(on_scan)) {
  boost::asio::post(context_, [this] { onTick(); });
  thread_ = std::thread([this] { context_.run(); });
}

DeviceSession::~DeviceSession() {
  boost::asio::post(context_, [this] {
    const auto& bytes = conversation_.stop(Moment::now());
    line_.write({bytes.data(), bytes.size()});
    context_.stop();
  });
  thread_.join();
}

void DeviceSession::command(const motion::HeadCommand& command) {
  boost::asio::post(context_, [this, command] {
    conversation_.command(command, Moment::now());
    send();
  });
}

SessionStatus DeviceSession::status() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return status_;
}

// An adapter that was plugged in again may come back as another port, and is known by its name.
Trouble DeviceSession::openPort() {
  Trouble found = line_.open(config_.port, config_.baud_rate);
  if (line_.isOpen()) {
    lasting_name_ = lastingName(config_.port);
  } else if (found.fault == Fault::kNoSuchPort && !lasting_name_.empty()) {
    found = line_.open(lasting_name_, config_.baud_rate);
  }
  return found;
}

// A port that cannot be read, though it opens, keeps its name until bytes come.
void DeviceSession::open() {
  const Trouble found = openPort();
  if (!line_.isOpen() || port_trouble_.fault != Fault::kPortFailed) port_trouble_ = found;
  if (!line_.isOpen()) {
    const bool may_come = found.fault == Fault::kNoSuchPort;
    next_try_ = std::chrono::steady_clock::now() + (may_come ? kTick : kRetryPeriod);
    return;
  }
  ++connections_;
  conversation_.open(Moment::now());
  read();
}

void DeviceSession::read() {
  line_.port().async_read_some(boost::asio::buffer(buffer_),
                               [this](const boost::system::error_code& error, std::size_t size) {
                                 if (error) {  // the cable was pulled: the next tick looks for it
                                   port_trouble_ = trouble(Fault::kPortFailed,
                                                           config_.port + ": " + error.message());
                                   next_try_ = std::chrono::steady_clock::now() + kRetryPeriod;
                                   line_.close();
                                   return updateStatus();
                                 }
                                 port_trouble_ = {};
                                 bytes_ += size;
                                 conversation_.receive({buffer_.data(), size}, Moment::now());
                                 read();
                               });
}

void DeviceSession::onTick() {
  if (!line_.isOpen() && std::chrono::steady_clock::now() >= next_try_) open();
  send();
  updateStatus();
  timer_.expires_after(kTick);
  timer_.async_wait([this](const boost::system::error_code&) { onTick(); });
}

void DeviceSession::send() {
  if (!line_.isOpen()) return;
  const auto& bytes = conversation_.send(Moment::now());
  line_.write({bytes.data(), bytes.size()});
}

void DeviceSession::updateStatus() {
  const std::lock_guard<std::mutex> lock(mutex_);
  status_.is_scanning = line_.isOpen() && conversation_.isScanning(Moment::now());
  const bool is_of_port = port_trouble_.fault != Fault::kNone;
  status_.trouble = is_of_port ? port_trouble_ : conversation_.currentTrouble();
  status_.device = conversation_.device();
  status_.connections = connections_;
  status_.counts = conversation_.counts();
  status_.line = conversation_.lineCounts();
  status_.commands = conversation_.commandCounts();
  status_.refusal = conversation_.refusal();
  status_.head_fault = conversation_.headFault();
  const DeviceClock& clock = conversation_.clock();
  status_.latency = clock.latency();
  status_.drift = clock.drift();
  status_.drift_is_at_limit = std::abs(clock.drift()) >= 0.999e-6 * config_.clock.max_drift;
  status_.is_faster_than_serial = clock.isFasterThanSerial();
  status_.clock = clock.counts();
  status_.bytes = bytes_;
}

}  // namespace sightline::driver
