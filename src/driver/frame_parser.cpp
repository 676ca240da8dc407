#include "sightline/driver/frame_parser.h"

#include <algorithm>
#include <cstring>

namespace sightline::driver {

namespace {

constexpr std::size_t kBufferSize = 4 * kMaxFrame;
// Bytes between the synchronisation and the header's checksum.
constexpr std::size_t kCheckedHeader = kHeaderSize - 4;

std::uint16_t u16At(const std::uint8_t* bytes) {
  return static_cast<std::uint16_t>(bytes[0] | bytes[1] << 8);
}

std::size_t payloadSize(const std::uint8_t* header) {
  return u16At(header + 6);
}

}  // namespace

FrameParser::FrameParser() : buffer_(kBufferSize) {}

std::size_t FrameParser::append(ByteView bytes) {
  if (begin_ > 0) {
    std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
    end_ -= begin_;
    begin_ = 0;
  }
  const std::size_t taken = std::min(bytes.size, buffer_.size() - end_);
  std::copy_n(bytes.data, taken, buffer_.data() + end_);
  end_ += taken;
  return taken;
}

std::optional<Frame> FrameParser::next() {
  while (findSync()) {
    if (end_ - begin_ < kHeaderSize) return std::nullopt;
    if (!headerIsSound()) {
      ++counts_.bad_headers;
      skip(1);
      continue;
    }
    const std::size_t payload = payloadSize(buffer_.data() + begin_);
    const std::size_t size = kHeaderSize + payload + kTrailerSize;
    if (end_ - begin_ < size) return std::nullopt;
    ByteReader trailer({buffer_.data() + begin_ + kHeaderSize + payload, kTrailerSize});
    if (trailer.u32() == frameChecksum({buffer_.data() + begin_ + 2, kHeaderSize + payload - 2})) {
      ++counts_.frames;
      begin_ += size;
      return frameAt(begin_ - size, payload);
    }
    ++counts_.bad_frames;
    skip(1);
  }
  return std::nullopt;
}

std::size_t FrameParser::awaited() const {
  if (waiting() < kHeaderSize) return kHeaderSize;
  return kHeaderSize + payloadSize(buffer_.data() + begin_) + kTrailerSize;
}

// Moves on to what may be the beginning of a frame.
bool FrameParser::findSync() {
  while (begin_ < end_) {
    const auto* from = buffer_.data() + begin_;
    const auto* found =
        static_cast<const std::uint8_t*>(std::memchr(from, kSync[0], end_ - begin_));
    skip(found ? static_cast<std::size_t>(found - from) : end_ - begin_);
    if (begin_ == end_) return false;
    if (begin_ + 1 == end_ || buffer_[begin_ + 1] == kSync[1]) return true;
    skip(1);
  }
  return false;
}

bool FrameParser::headerIsSound() const {
  const std::uint8_t* header = buffer_.data() + begin_;
  return payloadSize(header) <= kMaxPayload &&
         u16At(header + 2 + kCheckedHeader) == headerChecksum({header + 2, kCheckedHeader});
}

void FrameParser::skip(std::size_t bytes) {
  begin_ += bytes;
  counts_.skipped_bytes += bytes;
}

Frame FrameParser::frameAt(std::size_t begin, std::size_t payload_size) const {
  ByteReader reader({buffer_.data() + begin + 2, kCheckedHeader});
  Frame frame;
  frame.header.version = reader.u8();
  frame.header.kind = static_cast<FrameKind>(reader.u8());
  frame.header.sequence = reader.u16();
  reader.u16();  // length
  frame.header.clock = reader.u32();
  frame.payload = {buffer_.data() + begin + kHeaderSize, payload_size};
  return frame;
}

}  // namespace sightline::driver
