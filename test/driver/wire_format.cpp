// Frames and messages: what is written is read again, whatever happens to the bytes around it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "driver/sample_messages.h"
#include "property.h"
#include "sightline/driver/frame_parser.h"
#include "sightline/driver/messages.h"

namespace sightline::driver {
namespace {

using Bytes = std::vector<std::uint8_t>;

template <class Message>
Bytes frameOf(const Message& message, std::uint16_t sequence = 7) {
  FrameHeader header;
  header.sequence = sequence;
  header.clock = 0xFEDCBA98U;
  FrameEncoder encoder;
  return encoder.encode(header, message);
}

void append(Bytes& to, const Bytes& more) {
  to.insert(to.end(), more.begin(), more.end());
}

// The sequence numbers of the frames in a stream that comes in pieces.
std::vector<int> sequencesIn(const Bytes& bytes, std::size_t piece, FrameParser& parser) {
  std::vector<int> sequences;
  for (std::size_t taken = 0; taken < bytes.size();) {
    taken += parser.append({bytes.data() + taken, std::min(piece, bytes.size() - taken)});
    while (const auto frame = parser.next()) sequences.push_back(frame->header.sequence);
  }
  return sequences;
}

template <class Message>
Message sentAndRead(const Message& message) {
  const Bytes bytes = frameOf(message);
  FrameParser parser;
  EXPECT_EQ(parser.append({bytes.data(), bytes.size()}), bytes.size());
  const auto frame = parser.next();
  Message read;
  if (!frame) {
    ADD_FAILURE() << "no frame";
    return read;
  }
  EXPECT_TRUE(decode(*frame, read));
  EXPECT_EQ(frame->header.sequence, 7);
  EXPECT_EQ(frame->header.clock, 0xFEDCBA98U);
  EXPECT_FALSE(parser.next());
  return read;
}

TEST(WireFormat, FramesLookAsDocumented) {
  EXPECT_THAT(frameOf(Ping{0x04030201U}),
              testing::ElementsAreArray({0x53, 0x4C, 0x01, 0x05, 0x07, 0x00, 0x04, 0x00,
                                         0x98, 0xBA, 0xDC, 0xFE, 0xF0, 0x1C, 0x01, 0x02,
                                         0x03, 0x04, 0x72, 0x12, 0xA0, 0x5A}));
}

TEST(WireFormat, ChecksumsAreTheStandardOnes) {
  const std::string digits = "123456789";
  const ByteView bytes{reinterpret_cast<const std::uint8_t*>(digits.data()), digits.size()};
  EXPECT_EQ(headerChecksum(bytes), 0x29B1U);
  EXPECT_EQ(frameChecksum(bytes), 0xCBF43926U);
}

TEST(WireFormat, MessagesComeBackAsTheyWereSent) {
  EXPECT_EQ(sentAndRead(Ping{123456789}).token, 123456789U);
  using Mode = motion::HeadCommand::Mode;
  const auto target = sentAndRead(HeadTarget{{Mode::kPosition, -1.570796, 3.5}}).command;
  EXPECT_EQ(target.mode, Mode::kPosition);
  EXPECT_NEAR(target.position, -1.570796, 1e-12);
  EXPECT_NEAR(target.rate, 3.5, 1e-12);
  const auto identity = sentAndRead(Identity{kModel, "0042", 2, 13, 256, 0xCAFE});
  EXPECT_EQ(identity.model, kModel);
  EXPECT_EQ(identity.serial, "0042");
  EXPECT_EQ(identity.firmware_minor, 13);
  EXPECT_EQ(identity.samples, 256);
  EXPECT_EQ(identity.boot, 0xCAFEU);
  const auto answer =
      sentAndRead(Acknowledgement{FrameKind::kHeadTarget, CommandResult::kBeyondLimits, 99});
  EXPECT_EQ(answer.command, FrameKind::kHeadTarget);
  EXPECT_EQ(answer.result, CommandResult::kBeyondLimits);
  EXPECT_EQ(answer.sequence, 99);
  EXPECT_EQ(sentAndRead(Pong{5, 77}).received, 77U);
}

TEST(WireFormat, ScansComeBackAsTheyWereSent) {
  const ScanReport sent = test::scanReport(3);
  const ScanReport read = sentAndRead(sent);
  EXPECT_EQ(read.number, sent.number);
  EXPECT_EQ(read.boot, sent.boot);
  EXPECT_EQ(read.first_sample, sent.first_sample);
  EXPECT_EQ(read.sample_period, sent.sample_period);
  EXPECT_EQ(read.status, sent.status);
  EXPECT_EQ(read.femtoamperes_per_count, sent.femtoamperes_per_count);
  EXPECT_EQ(read.head_angles, sent.head_angles);
  ASSERT_EQ(read.currents.size(), sent.currents.size());
  for (std::size_t i = 0; i < sent.currents.size(); ++i) {
    EXPECT_EQ(read.currents[i].first, sent.currents[i].first);
    EXPECT_EQ(read.currents[i].second, sent.currents[i].second);
  }
}

TEST(WireFormat, LineHasRoomForAllScans) {
  const double share = lineSeconds(frameOf(test::scanReport(0)).size(), 460800) * 2500.0 / 256.0;
  EXPECT_LT(share, 0.5);
}

// A frame by hand: checksums in order, payload as given.
template <class Message>
bool isUnderstood(Bytes payload) {
  FrameHeader header;
  header.kind = Message::kKind;
  FrameEncoder encoder;
  const Bytes bytes = encoder.encodeBytes(header, {payload.data(), payload.size()});
  FrameParser parser;
  parser.append({bytes.data(), bytes.size()});
  const auto frame = parser.next();
  Message message;
  return frame && decode(*frame, message);
}

TEST(WireFormat, PayloadsThatMakeNoSenseAreRefused) {
  EXPECT_TRUE(isUnderstood<Ping>(Bytes(4)));
  EXPECT_FALSE(isUnderstood<Ping>(Bytes(3))) << "too short";
  EXPECT_FALSE(isUnderstood<Ping>(Bytes(5))) << "too long";
  EXPECT_FALSE(isUnderstood<HeadTarget>(Bytes(9, 3))) << "no such mode";
  EXPECT_FALSE(isUnderstood<Identity>(Bytes(40, 7))) << "not a text";
  EXPECT_FALSE(isUnderstood<ScanReport>(Bytes(24))) << "no samples";
  EXPECT_FALSE(isUnderstood<ScanReport>(Bytes(24, 1))) << "fewer samples than it says";
  ScanReport no_scale = test::scanReport(1);
  no_scale.femtoamperes_per_count = 0;
  ScanReport no_time = test::scanReport(1);
  no_time.sample_period = 0;
  for (const auto& report : {no_scale, no_time}) {
    Bytes payload;
    ByteWriter writer(payload);
    report.write(writer);
    EXPECT_FALSE(isUnderstood<ScanReport>(payload));
  }
}

TEST(FrameParser, FramesOfOtherVersionsAreFoundButNotUnderstood) {
  FrameHeader header;
  header.version = 9;
  header.kind = FrameKind::kPing;
  const Bytes payload(4);
  FrameEncoder encoder;
  const Bytes bytes = encoder.encodeBytes(header, {payload.data(), payload.size()});
  FrameParser parser;
  parser.append({bytes.data(), bytes.size()});
  const auto frame = parser.next();
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->header.version, 9);
  Ping ping;
  EXPECT_FALSE(decode(*frame, ping));
}

TEST(FrameParser, BrokenFrameTakesNoneOfItsNeighboursWithIt) {
  const Bytes whole = frameOf(test::scanReport(1), 1);
  for (std::size_t broken = 0; broken < whole.size(); ++broken) {
    Bytes stream = whole;
    stream[broken] ^= 0x10;
    append(stream, frameOf(Ping{1}, 2));
    append(stream, frameOf(test::scanReport(2), 3));
    // Bytes that a length which was read wrongly waits for come in the end.
    append(stream, Bytes(kMaxFrame));
    FrameParser parser;
    ASSERT_EQ(sequencesIn(stream, 512, parser), (std::vector<int>{2, 3})) << broken;
    ASSERT_EQ(parser.counts().frames, 2U);
  }
}

TEST(FrameParser, CountsWhatItSkips) {
  Bytes stream{1, 2, 3};
  append(stream, frameOf(Ping{1}, 1));
  Bytes bad_header = frameOf(Ping{2}, 2);
  bad_header[5] ^= 1;
  append(stream, bad_header);
  Bytes bad_frame = frameOf(Ping{3}, 3);
  bad_frame[15] ^= 1;
  append(stream, bad_frame);
  FrameParser parser;
  EXPECT_EQ(sequencesIn(stream, 1, parser), std::vector<int>{1});
  EXPECT_EQ(parser.counts().bad_headers, 1U);
  EXPECT_EQ(parser.counts().bad_frames, 1U);
  EXPECT_EQ(parser.counts().skipped_bytes, 3 + bad_header.size() + bad_frame.size());
}

TEST(FrameParser, ForgetsAFrameBegun) {
  const Bytes whole = frameOf(Ping{1}, 1);
  FrameParser parser;
  parser.append({whole.data(), whole.size() - 1});
  EXPECT_FALSE(parser.next());
  parser.clear();
  EXPECT_EQ(sequencesIn(whole, 64, parser), std::vector<int>{1});
}

RC_GTEST_PROP(FrameParserProperty, FindsEveryWholeFrameInAnyGarbage, ()) {
  Bytes stream;
  std::vector<int> expected;
  const int frames = *rc::gen::inRange(1, 8);
  for (int i = 0; i < frames; ++i) {
    append(stream, *rc::gen::resize(40, rc::gen::arbitrary<Bytes>()));
    Bytes frame = *rc::gen::arbitrary<bool>()
                      ? frameOf(Ping{}, static_cast<std::uint16_t>(i))
                      : frameOf(test::scanReport(1), static_cast<std::uint16_t>(i));
    if (*rc::gen::arbitrary<bool>()) {
      frame.resize(*rc::gen::inRange<std::size_t>(0, frame.size()));  // the rest was dropped
    } else {
      expected.push_back(i);
    }
    append(stream, frame);
  }
  append(stream, Bytes(kMaxFrame));
  FrameParser parser;
  RC_ASSERT(sequencesIn(stream, *rc::gen::inRange<std::size_t>(1, 3000), parser) == expected);
}

}  // namespace
}  // namespace sightline::driver
