#pragma once

#include <array>
#include <chrono>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include <boost/asio/io_context.hpp>
#include <boost/asio/steady_timer.hpp>

#include "sightline/config/fields.h"
#include "sightline/driver/conversation.h"
#include "sightline/driver/serial_line.h"

namespace sightline::driver {

struct SessionConfig {
  std::string port = "/dev/ttyUSB0";
  int baud_rate = 460800;  ///< [bit/s]
  ClockConfig clock;

  void visit(config::FieldVisitor& visitor);
};

/// State of a session.
struct SessionStatus {
  Trouble trouble;
  bool is_scanning = false;
  std::optional<Identity> device;
  std::size_t connections = 0;  ///< openings of the port
  ConversationCounts counts;
  FrameParser::Counts line;
  HeadCommandOutbox::Counts commands;
  std::string refusal;     ///< of the last scan that was refused
  std::string head_fault;  ///< as HeadWatch says it; empty while the head follows
  double latency = 0.0;    ///< [s]
  double drift = 0.0;      ///< of the device clock: host seconds a device second, less one
  bool drift_is_at_limit = false;
  bool is_faster_than_serial = false;
  DeviceClock::Counts clock;
  std::size_t bytes = 0;  ///< received
};

/// A device at a serial port, from now until the end of the object: opens the port whenever there
/// is one, and keeps the conversation going. It runs in a thread of its own.
class DeviceSession {
 public:
  /// `on_scan` is called by the session's thread; a scan is good until it returns.
  DeviceSession(const SessionConfig& config, const ExpectedDevice& device,
                const motion::HeadLimits& head, Conversation::OnScan on_scan);
  /// Tells the device to stop.
  ~DeviceSession();
  DeviceSession(const DeviceSession&) = delete;
  DeviceSession& operator=(const DeviceSession&) = delete;

  void command(const motion::HeadCommand& command);
  SessionStatus status() const;

 private:
  Trouble openPort();
  void open();
  void read();
  void onTick();
  void send();
  void updateStatus();

  SessionConfig config_;
  boost::asio::io_context context_;
  SerialLine line_;
  boost::asio::steady_timer timer_;
  Conversation conversation_;
  std::array<std::uint8_t, 4096> buffer_{};
  Trouble port_trouble_;
  std::string lasting_name_;  // of the port that was open last, where udev has one
  std::chrono::steady_clock::time_point next_try_;  // to open the port
  std::size_t connections_ = 0;
  std::size_t bytes_ = 0;

  mutable std::mutex mutex_;
  SessionStatus status_;  // the other threads' copy
  std::thread thread_;
};

}  // namespace sightline::driver
