#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "sightline/driver/frame_parser.h"
#include "sightline/driver/messages.h"
#include "sightline/simulation/device_model.h"
#include "sightline/simulation/random_stream.h"

namespace sightline::simulation {

/// Identity of an emulated device.
struct FirmwareConfig {
  driver::Identity identity{driver::kModel, "SS-0001", 1, 0, 256, 0};  ///< but for the boot
  std::uint8_t version = driver::kProtocolVersion;
  int baud_rate = 460800;
  std::uint32_t sample_period = 400'000;  ///< [ns]
  double drift = 0.0;                     ///< of the clock [ppm]; positive: it is fast
  std::uint32_t first_clock = 0;          ///< what the clock shows when the device starts [µs]
};

constexpr std::uint32_t kFemtoamperesPerCount = 50;  ///< ±0.42 µA: beyond the nearest white wall

/// A scan on its way, with what is true of it.
struct SentScan {
  std::uint32_t number = 0;
  triangulation::RawScan scan;  ///< as the frame holds it: rounded; stamped with the true time [ns]
  triangulation::RawScan measured;  ///< before it was rounded, stamped likewise
};

/// A frame as it leaves the device.
struct SentFrame {
  std::vector<std::uint8_t> bytes;
  std::int64_t sent = 0;  ///< when its last byte has left [ns]
  std::optional<SentScan> scan;
};

/// The device's side of the wire format: obeys commands and sends the scans of a model. Knows no
/// line and no time of its own; times are in nanoseconds and never go back.
class EmulatedFirmware {
 public:
  /// The model has to live as long. Not started yet.
  EmulatedFirmware(const FirmwareConfig& config, DeviceModel& model, std::uint64_t seed);

  /// Starts anew: nothing is remembered. Says who it is.
  void boot(std::int64_t time);
  void setDrift(double ppm, std::int64_t time);
  void receive(driver::ByteView bytes, std::int64_t time);
  /// Goes on to `time`; scans are sent if the device was told to start.
  void advance(std::int64_t time);
  /// Goes on to `time` without a word.
  void sleep(std::int64_t time) {
    number_ += static_cast<std::uint32_t>(model_.advance(time).size());
  }
  /// Frames to be sent since the last call.
  std::vector<SentFrame> take();

 private:
  std::uint32_t clockAt(std::int64_t time) const;
  void answer(const driver::Frame& frame, std::int64_t time);
  void acknowledge(const driver::Frame& frame, driver::CommandResult result, std::int64_t time);
  void sendScan(const triangulation::RawScan& scan, std::int64_t time);
  template <class Message>
  void put(const Message& message, std::int64_t time);

  FirmwareConfig config_;
  DeviceModel& model_;
  RandomStream random_;
  driver::FrameParser parser_;
  driver::FrameEncoder encoder_;
  driver::ScanReport report_;
  std::vector<std::uint8_t> payload_;
  std::vector<SentFrame> outbox_;
  bool scanning_ = false;
  std::uint32_t number_ = 0;
  std::uint16_t sequence_ = 0;
  std::int64_t booted_ = 0;
  std::int64_t line_free_ = 0;
  // The clock showed so many microseconds at that time.
  std::int64_t clock_origin_ = 0;
  double clock_reading_ = 0.0;
};

}  // namespace sightline::simulation
