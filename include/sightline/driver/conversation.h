#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sightline/driver/clock_estimator.h"
#include "sightline/driver/frame_parser.h"
#include "sightline/driver/messages.h"
#include "sightline/driver/trouble.h"
#include "sightline/triangulation/ranger.h"

namespace sightline::driver {

/// Device to be talked to, and the line to it.
struct ConversationConfig {
  std::string serial;       ///< the device's number, as in its calibration
  std::size_t samples = 0;  ///< a scan, likewise
  int baud_rate = 460800;
  ClockConfig clock;
};

/// The same moment on two clocks of the host [ns]: one that never jumps, and that of the stamps.
struct Moment {
  std::int64_t steady = 0;
  std::int64_t system = 0;

  static Moment now();
};

struct ConversationCounts {
  std::size_t scans = 0;          ///< handed over
  std::size_t lost_scans = 0;     ///< of a device that counted them
  std::size_t refused_scans = 0;  ///< whole frames of an unknown device, or that make no sense
  std::size_t saturated_scans = 0;
  std::size_t reboots = 0;
  std::size_t refused_commands = 0;  ///< by the device
  std::size_t lost_commands = 0;     ///< neither acknowledged in time nor replaced before
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
  const ClockEstimator& clock() const { return clock_; }
  const ConversationCounts& counts() const { return counts_; }
  const FrameParser::Counts& lineCounts() const { return parser_.counts(); }

 private:
  struct PendingCommand {
    HeadTarget target;
    std::int64_t given = 0;
    std::int64_t sent = 0;
    std::uint16_t sequence = 0;
  };

  void take(const Frame& frame, const Moment& now);
  void takeFrames(const Moment& now);
  void giveUpOldFrame(const Moment& now);
  void refuseVersion(int version, const Moment& now);
  bool isOfDevice(const Frame& scan);
  void takeIdentity(const Identity& identity);
  Trouble faultOf(const Identity& identity) const;
  void takeAcknowledgement(const Acknowledgement& answer);
  void takePong(const Pong& pong, const Moment& now);
  void takeScan(const Moment& now);
  void countLost();
  void observeArrival(const Frame& frame, const Moment& now);
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
  ClockEstimator clock_;
  ConversationCounts counts_;
  Trouble trouble_;
  std::optional<Identity> device_;       // at this line, and the right one
  std::optional<Identity> known_;        // the last right one, also from before the line was opened
  std::optional<std::uint32_t> number_;  // of the last scan
  std::optional<PendingCommand> command_;
  ScanReport report_;
  triangulation::RawScan scan_;
  std::vector<std::uint8_t> outgoing_;
  std::uint16_t sequence_ = 0;
  std::int64_t begun_ = 0;       // when the bytes that wait in the parser began to
  std::int64_t last_byte_ = 0;   // or the opening of the line, like the next two
  std::int64_t last_frame_ = 0;  // a whole one
  std::int64_t last_scan_ = 0;
  std::size_t broken_before_ = 0;  // by then
  std::int64_t last_asked_ = 0;
  std::int64_t last_ping_ = 0;
  bool just_identified_ = false;  // a device has just identified itself
};

}  // namespace sightline::driver
