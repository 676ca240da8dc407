// Any bytes, cut anywhere, read as the wire format: as they are, and with the checksums of whatever
// looks like a frame put right, so that payloads are reached. A message that is understood is
// written back to the same bytes, and the host's side of the conversation takes it all.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "sightline/driver/conversation.h"
#include "sightline/driver/frame_parser.h"
#include "sightline/driver/messages.h"

namespace {

using namespace sightline::driver;

void mendHeader(std::uint8_t* frame) {
  const std::uint16_t check = headerChecksum({frame + 2, kHeaderSize - 4});
  frame[kHeaderSize - 2] = static_cast<std::uint8_t>(check);
  frame[kHeaderSize - 1] = static_cast<std::uint8_t>(check >> 8);
}

// Returns the size of the frame, or 0 where none fits into the bytes left.
std::size_t mendFrame(std::uint8_t* frame, std::size_t left) {
  if (left < kHeaderSize + kTrailerSize || frame[0] != kSync[0] || frame[1] != kSync[1]) return 0;
  const std::size_t room = left - kHeaderSize - kTrailerSize;
  const std::size_t payload = frame[6] | static_cast<std::size_t>(frame[7]) << 8;
  if (payload > std::min(room, kMaxPayload)) return 0;
  mendHeader(frame);
  std::vector<std::uint8_t> check;
  ByteWriter(check).u32(frameChecksum({frame + 2, kHeaderSize + payload - 2}));
  std::copy(check.begin(), check.end(), frame + kHeaderSize + payload);
  return kHeaderSize + payload + kTrailerSize;
}

std::vector<std::uint8_t> mended(std::vector<std::uint8_t> bytes) {
  for (std::size_t at = 0; at < bytes.size();) {
    at += std::max<std::size_t>(1, mendFrame(bytes.data() + at, bytes.size() - at));
  }
  return bytes;
}

template <class Message>
void checkRoundTrip(const Frame& frame) {
  Message message;
  if (!decode(frame, message)) return;
  FrameEncoder encoder;
  const auto& again = encoder.encode(frame.header, message);
  const ByteView& payload = frame.payload;
  if (again.size() != kHeaderSize + payload.size + kTrailerSize) std::abort();
  if (!std::equal(payload.data, payload.data + payload.size, again.begin() + kHeaderSize)) {
    std::abort();
  }
}

#ifdef SIGHTLINE_PLANTED_BUG
// Believes that a device knows no other results. Only frames with sound checksums come here.
void nameResult(const Frame& answer) {
  static const char* const kNames[] = {"done", "unknown", "beyond limits"};
  if (answer.header.kind != FrameKind::kAcknowledgement || answer.payload.size < 2) return;
  [[maybe_unused]] const char* const volatile name = kNames[answer.payload.data[1]];
}
#endif

void checkMessages(const Frame& frame) {
  // A copy without a byte to spare, so that reading beyond its end is noticed.
  const std::vector<std::uint8_t> payload(frame.payload.data,
                                          frame.payload.data + frame.payload.size);
  const Frame exact{frame.header, {payload.data(), payload.size()}};
  checkRoundTrip<Identify>(exact);
  checkRoundTrip<Start>(exact);
  checkRoundTrip<Stop>(exact);
  checkRoundTrip<HeadTarget>(exact);
  checkRoundTrip<Ping>(exact);
  checkRoundTrip<Identity>(exact);
  checkRoundTrip<Acknowledgement>(exact);
  checkRoundTrip<Pong>(exact);
  checkRoundTrip<ScanReport>(exact);
#ifdef SIGHTLINE_PLANTED_BUG
  nameResult(exact);
#endif
}

// The number of frames, fed in pieces of such a size.
std::size_t parse(const std::vector<std::uint8_t>& bytes, std::size_t piece) {
  FrameParser parser;
  for (std::size_t taken = 0; taken < bytes.size();) {
    const std::size_t size = std::min(piece, bytes.size() - taken);
    const std::size_t accepted = parser.append({bytes.data() + taken, size});
    if (accepted == 0) std::abort();
    taken += accepted;
    while (const auto frame = parser.next()) checkMessages(*frame);
  }
  return parser.counts().frames;
}

// A device of few samples, so that inputs may be short. Scans that are handed over make sense.
class Talk {
 public:
  void hear(const std::vector<std::uint8_t>& bytes, std::size_t piece) {
    conversation_.open(now_);
    for (std::size_t taken = 0; taken < bytes.size(); taken += piece) {
      conversation_.receive({bytes.data() + taken, std::min(piece, bytes.size() - taken)}, now_);
      pass(20'000'000);
    }
    conversation_.command({}, now_);
    for (int i = 0; i < 20; ++i) pass(100'000'000);
    conversation_.stop(now_);
  }

 private:
  static constexpr std::size_t kSamples = 4;

  void pass(std::int64_t nanoseconds) {
    now_.steady += nanoseconds;
    now_.system += nanoseconds;
    answer(conversation_.send(now_));
    conversation_.isScanning(now_);
  }
  // All that the host sends can be read.
  void answer(const std::vector<std::uint8_t>& bytes) {
    device_.append({bytes.data(), bytes.size()});
    std::size_t understood = 0;
    while (const auto frame = device_.next()) {
      understood += kHeaderSize + frame->payload.size + kTrailerSize;
    }
    if (understood != bytes.size()) std::abort();
  }
  static void check(const sightline::triangulation::RawScan& scan) {
    if (scan.currents.size() != kSamples || scan.head_angles.size() != kSamples) std::abort();
  }

  FrameParser device_;
  Moment now_{1'000'000'000'000, 1'700'000'000'000'000'000};
  Conversation conversation_{{{"SS-0001", kSamples, 0.0}, 460800, {}, {}}, check};
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::size_t piece = 1U + data[0];
  const std::vector<std::uint8_t> bytes(data + 1, data + size);
  for (const auto& stream : {bytes, mended(bytes)}) {
    if (parse(stream, piece) != parse(stream, stream.size() + 1)) std::abort();
    Talk().hear(stream, piece);
  }
  return 0;
}
