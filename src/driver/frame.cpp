#include "sightline/driver/frame.h"

#include <algorithm>

#include <boost/crc.hpp>

namespace sightline::driver {

namespace {

// Places in the header.
constexpr std::size_t kLengthAt = 6;
constexpr std::size_t kHeaderCheckAt = 12;

void put(std::vector<std::uint8_t>& bytes, std::size_t at, std::uint16_t value) {
  bytes[at] = static_cast<std::uint8_t>(value);
  bytes[at + 1] = static_cast<std::uint8_t>(value >> 8);
}

}  // namespace

std::uint16_t headerChecksum(ByteView bytes) {
  boost::crc_ccitt_false_t crc;
  crc.process_bytes(bytes.data, bytes.size);
  return static_cast<std::uint16_t>(crc.checksum());
}

std::uint32_t frameChecksum(ByteView bytes) {
  boost::crc_32_type crc;
  crc.process_bytes(bytes.data, bytes.size);
  return crc.checksum();
}

double lineSeconds(std::size_t bytes, int baud_rate) {
  return 10.0 * static_cast<double>(bytes) / baud_rate;
}

const std::vector<std::uint8_t>& FrameEncoder::encodeBytes(const FrameHeader& header,
                                                           ByteView payload) {
  begin(header);
  bytes_.insert(bytes_.end(), payload.data, payload.data + std::min(payload.size, kMaxPayload));
  finish();
  return bytes_;
}

void FrameEncoder::begin(const FrameHeader& header) {
  bytes_.clear();
  ByteWriter writer(bytes_);
  writer.u8(kSync[0]);
  writer.u8(kSync[1]);
  writer.u8(header.version);
  writer.u8(static_cast<std::uint8_t>(header.kind));
  writer.u16(header.sequence);
  writer.u16(0);  // length, see finish()
  writer.u32(header.clock);
  writer.u16(0);  // checksum, see finish()
}

void FrameEncoder::finish() {
  put(bytes_, kLengthAt, static_cast<std::uint16_t>(bytes_.size() - kHeaderSize));
  put(bytes_, kHeaderCheckAt, headerChecksum({bytes_.data() + 2, kHeaderCheckAt - 2}));
  ByteWriter(bytes_).u32(frameChecksum({bytes_.data() + 2, bytes_.size() - 2}));
}

}  // namespace sightline::driver
