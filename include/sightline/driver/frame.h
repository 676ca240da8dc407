#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "sightline/driver/bytes.h"

/// Frames of the wire format (docs/wire_format.md): what every version of it has in common.
namespace sightline::driver {

constexpr std::uint8_t kProtocolVersion = 1;

enum class FrameKind : std::uint8_t {
  // to the device
  kIdentify = 0x01,
  kStart = 0x02,
  kStop = 0x03,
  kHeadTarget = 0x04,
  kPing = 0x05,
  // from the device
  kIdentity = 0x81,
  kAcknowledgement = 0x82,
  kPong = 0x83,
  kScan = 0x84,
};

struct FrameHeader {
  std::uint8_t version = kProtocolVersion;
  FrameKind kind = FrameKind::kIdentify;
  std::uint16_t sequence = 0;  ///< counts the frames of a sender, so that answers can name one
  std::uint32_t clock = 0;  ///< the sender's, when the first byte goes onto the line [µs], wraps
};

/// A frame whose checksums are right. The payload lies in the buffer of its maker.
struct Frame {
  FrameHeader header;
  ByteView payload;
};

constexpr std::uint8_t kSync[2] = {0x53, 0x4C};
constexpr std::size_t kHeaderSize = 14;  ///< with the synchronisation and the header's checksum
constexpr std::size_t kTrailerSize = 4;  ///< the checksum of the frame
constexpr std::size_t kMaxPayload = 4096;
constexpr std::size_t kMaxFrame = kHeaderSize + kMaxPayload + kTrailerSize;

/// CRC-16/CCITT-FALSE and CRC-32 (IEEE 802.3).
std::uint16_t headerChecksum(ByteView bytes);
std::uint32_t frameChecksum(ByteView bytes);

/// Seconds that so many bytes take on the line: a start bit, eight bits and a stop bit each.
double lineSeconds(std::size_t bytes, int baud_rate);

/// Puts payloads into frames. The bytes of a frame are good until the next one.
class FrameEncoder {
 public:
  /// A message is a struct of messages.h; the header's kind and version are the message's.
  template <class Message>
  const std::vector<std::uint8_t>& encode(FrameHeader header, const Message& message) {
    header.version = kProtocolVersion;
    header.kind = Message::kKind;
    begin(header);
    ByteWriter writer(bytes_);
    message.write(writer);
    finish();
    return bytes_;
  }

  /// Any payload, at most kMaxPayload bytes of it, under any header.
  const std::vector<std::uint8_t>& encodeBytes(const FrameHeader& header, ByteView payload);

 private:
  void begin(const FrameHeader& header);
  void finish();

  std::vector<std::uint8_t> bytes_;
};

/// Whether the frame holds such a message, whole and nothing more; then `message` is overwritten.
/// After false it holds anything.
template <class Message>
bool decode(const Frame& frame, Message& message) {
  if (frame.header.version != kProtocolVersion || frame.header.kind != Message::kKind) return false;
  ByteReader reader(frame.payload);
  return message.read(reader) && reader.ok() && reader.left() == 0;
}

}  // namespace sightline::driver
