#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sightline/driver/frame.h"
#include "sightline/motion/head_command.h"

/// The payloads of frames (docs/wire_format.md). write() appends one; read() takes one and says
/// whether its values make sense.
namespace sightline::driver {

struct Identify {
  static constexpr FrameKind kKind = FrameKind::kIdentify;
  void write(ByteWriter&) const {}
  bool read(ByteReader&) { return true; }
};

struct Start {
  static constexpr FrameKind kKind = FrameKind::kStart;
  void write(ByteWriter&) const {}
  bool read(ByteReader&) { return true; }
};

struct Stop {
  static constexpr FrameKind kKind = FrameKind::kStop;
  void write(ByteWriter&) const {}
  bool read(ByteReader&) { return true; }
};

/// Target of the head. Angles travel in whole microradians.
struct HeadTarget {
  static constexpr FrameKind kKind = FrameKind::kHeadTarget;
  motion::HeadCommand command;

  void write(ByteWriter& writer) const;
  bool read(ByteReader& reader);
};

struct Ping {
  static constexpr FrameKind kKind = FrameKind::kPing;
  std::uint32_t token = 0;  ///< comes back with the answer

  void write(ByteWriter& writer) const { writer.u32(token); }
  bool read(ByteReader& reader);
};

/// Identity of a device: the answer to Identify, and its message once it has started.
struct Identity {
  static constexpr FrameKind kKind = FrameKind::kIdentity;
  std::string model;   ///< at most 16 characters of ASCII
  std::string serial;  ///< likewise
  std::uint8_t firmware_major = 0;
  std::uint8_t firmware_minor = 0;
  std::uint16_t samples = 0;  ///< a scan
  std::uint32_t boot = 0;     ///< another number each time that the device starts

  void write(ByteWriter& writer) const;
  bool read(ByteReader& reader);
};

/// The model that Identity has to name.
constexpr const char* kModel = "SYNC-SCAN";

enum class CommandResult : std::uint8_t { kDone, kUnknown, kBeyondLimits };

struct Acknowledgement {
  static constexpr FrameKind kKind = FrameKind::kAcknowledgement;
  FrameKind command = FrameKind::kStart;
  CommandResult result = CommandResult::kDone;
  std::uint16_t sequence = 0;  ///< of the command's frame

  void write(ByteWriter& writer) const;
  bool read(ByteReader& reader);
};

struct Pong {
  static constexpr FrameKind kKind = FrameKind::kPong;
  std::uint32_t token = 0;
  std::uint32_t received = 0;  ///< device clock when the last byte of the ping had come [µs]

  void write(ByteWriter& writer) const;
  bool read(ByteReader& reader);
};

/// One scan as it was measured. Vectors hold one entry a sample.
struct ScanReport {
  static constexpr FrameKind kKind = FrameKind::kScan;
  static constexpr std::uint16_t kHeadMoves = 1;
  static constexpr std::uint16_t kSaturated =
      2;  ///< a current is at the end of what can be counted

  struct Counts {
    std::int32_t first = 0;  ///< 24 bits, signed
    std::int32_t second = 0;
  };

  std::uint32_t number = 0;                  ///< counts the scans of the device since it started
  std::uint32_t boot = 0;                    ///< as in Identity
  std::uint32_t first_sample = 0;            ///< device clock [µs], wraps
  std::uint32_t sample_period = 0;           ///< [ns], never 0
  std::uint16_t status = 0;                  ///< kHeadMoves, kSaturated
  std::uint32_t femtoamperes_per_count = 0;  ///< never 0
  std::vector<std::int16_t> head_angles;     ///< counter-clockwise from straight ahead [100 µrad]
  std::vector<Counts> currents;

  void write(ByteWriter& writer) const;
  bool read(ByteReader& reader);
};

constexpr double kAngleUnit = 1e-4;          ///< of ScanReport::head_angles [rad]
constexpr std::int32_t kMaxCount = 8388607;  ///< largest of 24 bits, signed

}  // namespace sightline::driver
