#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sightline/driver/device_clock.h"
#include "sightline/driver/expected_device.h"
#include "sightline/driver/frame_parser.h"
#include "sightline/driver/head_command_outbox.h"
#include "sightline/driver/head_watch.h"
#include "sightline/driver/messages.h"
#include "sightline/driver/trouble.h"
#include "sightline/triangulation/ranger.h"

namespace sightline::driver {

/// Device to be talked to, and the line to it.
struct ConversationConfig {
  ExpectedDevice device;
  int baud_rate = 460800;
  ClockConfig clock;
  motion::HeadLimits head;
};

/// The same moment on two clocks of the host [ns]: one that never jumps, and that of the stamps.
struct Moment {
  std::int64_t steady = 0;
  std::int64_t system = 0;

  static Moment now();
};

struct ConversationCounts {
  std::size_t scans = 0;            ///< handed over
  std::size_t lost_scans = 0;       ///< of a device that counted them
  std::size_t refused_scans = 0;    ///< whole frames of an unknown device, or that make no sense
  std::size_t saturated_scans = 0;  ///< with more samples at an end of the count than a glint has
  std::size_t reboots = 0;
};

/// The host's side of the wire format: asks who is there, has it scan, keeps its clock, and asks
/// again whenever the scans cease. Knows no port and no time of its own: bytes and moments are
/// brought, and what is to be sent is taken away.
class Conversation {
 public:
  using OnScan = std::function<void(const triangulation::RawScan&)>;

  /// Scans are stamped with the host's time of the first sample; each is good until `on_scan`
  /// returns.
  Conversation(ConversationConfig config, OnScan on_scan);

  /// Starts on a line that has just been opened: the device at its end has to identify itself.
  void open(const Moment& now);
  void receive(ByteView bytes, const Moment& now);
  /// Bytes that are due to be sent; call it every hundredth of a second or so. Good until the next
  /// call.
  const std::vector<std::uint8_t>& send(const Moment& now);
  /// Bytes that end the conversation.
  const std::vector<std::uint8_t>& stop(const Moment& now);
  /// Given up unless the device acknowledges within a second.
  void command(const motion::HeadCommand& command, const Moment& now);

  /// Since the last scan; also where the device cannot be used.
  const Trouble& currentTrouble() const { return trouble_; }
  const std::optional<Identity>& device() const { return device_; }
  /// Whether the device is known and its scans come.
  bool isScanning(const Moment& now) const;
  const DeviceClock& clock() const { return clock_; }
  const ConversationCounts& counts() const { return counts_; }
  const HeadCommandOutbox::Counts& commandCounts() const { return commands_.counts(); }
  /// Reason why the last refused scan was refused; empty before there was one.
  const std::string& refusal() const { return refusal_; }
  /// As HeadWatch says it.
  const std::string& headFault() const { return head_.fault(); }
  const FrameParser::Counts& lineCounts() const { return parser_.counts(); }

 private:
  void take(const Frame& frame, const Moment& now);
  void takeFrames(const Moment& now);
  void giveUpOldFrame(const Moment& now);
  void refuseVersion(int version, const Moment& now);
  bool isOfDevice(const Frame& scan);
  void refuse(std::string reason);
  std::string faultOf(const ScanReport& report) const;
  void takeIdentity(const Identity& identity);
  void takePong(const Frame& frame, const Pong& pong, const Moment& now);
  void takeScan(const Frame& frame, const Moment& now);
  void deliver(std::int64_t stamp, const Moment& now);
  void countLost();
  std::int64_t silence() const;
  std::size_t broken() const;
  void judgeSilence(const Moment& now);
  std::int64_t askingPeriod() const;
  void sendCommand(const Moment& now);
  template <class Message>
  void put(const Message& message, const Moment& now);

  ConversationConfig config_;
  OnScan on_scan_;
  FrameParser parser_;
  FrameEncoder encoder_;
  DeviceClock clock_;
  HeadCommandOutbox commands_;
  HeadWatch head_;
  ConversationCounts counts_;
  std::string refusal_;
  Trouble trouble_;
  std::optional<Identity> device_;       // at this line, and the right one
  std::optional<Identity> known_;        // the last right one, also from before the line was opened
  std::optional<std::uint32_t> number_;  // of the last scan
  ScanReport report_;
  triangulation::RawScan scan_;
  std::vector<std::uint8_t> outgoing_;
  std::uint16_t sequence_ = 0;
  std::int64_t begun_ = 0;       // when the bytes that wait in the parser began to
  std::int64_t last_byte_ = 0;   // or the opening of the line, like the next two
  std::int64_t last_frame_ = 0;  // a whole one
  std::int64_t last_scan_ = 0;
  std::size_t broken_before_ = 0;  // by then
  std::int64_t last_refusal_ = 0;
  std::int64_t scan_pause_ = 0;  // between the last two scans that followed each other
  std::int64_t last_asked_ = 0;
  int times_asked_ = 0;  // since the last scan
  std::int64_t last_ping_ = 0;
  bool just_identified_ = false;  // a device has just identified itself
};

}  // namespace sightline::driver
