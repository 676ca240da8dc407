#include "sightline/driver/conversation.h"

#include <chrono>
#include <utility>

#include <fmt/format.h>

#include "sightline/driver/scan_report_conversion.h"

namespace sightline::driver {

namespace {

constexpr std::int64_t kMillisecond = 1'000'000;         // [ns]
constexpr std::int64_t kSilence = 250 * kMillisecond;    // two scans have not come
constexpr std::int64_t kPatience = 1000 * kMillisecond;  // before silence is a fault
constexpr std::int64_t kAskingPeriod = 40 * kMillisecond;
constexpr std::int64_t kUnknownDevicePeriod =
    250 * kMillisecond;  // of asking a device that is not the right one
constexpr std::int64_t kFramePatience = 50 * kMillisecond;  // beyond what its bytes take
constexpr std::int64_t kPingPeriod = 250 * kMillisecond;
constexpr std::int64_t kCommandPeriod = 100 * kMillisecond;
constexpr std::int64_t kCommandPatience = 1000 * kMillisecond;

std::uint32_t microseconds(std::int64_t time) {
  return static_cast<std::uint32_t>(time / 1000);
}

std::int64_t lineTime(std::size_t bytes, int baud_rate) {
  return static_cast<std::int64_t>(1e9 * lineSeconds(bytes, baud_rate));
}

}  // namespace

Moment Moment::now() {
  using std::chrono::duration_cast;
  using std::chrono::nanoseconds;
  using std::chrono::steady_clock;
  constexpr std::chrono::microseconds kTogether{20};  // that the clocks are to be read within
  for (int tries = 0;; ++tries) {
    const auto before = steady_clock::now();
    const auto system = std::chrono::system_clock::now();
    const auto between = steady_clock::now() - before;
    if (between > kTogether && tries < 5) continue;  // something else ran meanwhile
    return {duration_cast<nanoseconds>((before + between / 2).time_since_epoch()).count(),
            duration_cast<nanoseconds>(system.time_since_epoch()).count()};
  }
}

Conversation::Conversation(ConversationConfig config, OnScan on_scan)
    : config_(std::move(config)), on_scan_(std::move(on_scan)), clock_(config_.clock) {}

void Conversation::open(const Moment& now) {
  parser_.clear();
  device_.reset();
  trouble_ = {};
  last_scan_ = last_byte_ = last_frame_ = now.steady;
  broken_before_ = broken();
  last_asked_ = now.steady - kAskingPeriod;
}

void Conversation::receive(ByteView bytes, const Moment& now) {
  last_byte_ = now.steady;
  for (std::size_t taken = 0; taken < bytes.size;) {
    if (parser_.waiting() == 0) begun_ = now.steady;
    taken += parser_.append({bytes.data + taken, bytes.size - taken});
    takeFrames(now);
  }
}

void Conversation::takeFrames(const Moment& now) {
  while (const auto frame = parser_.next()) {
    begun_ = last_frame_ = now.steady;
    take(*frame, now);
  }
}

// A device that was switched off in the midst of a frame leaves a beginning that would swallow what
// comes after it.
void Conversation::giveUpOldFrame(const Moment& now) {
  const auto is_old = [&] {
    const std::int64_t expected = lineTime(parser_.awaited(), config_.baud_rate);
    return parser_.waiting() > 0 && now.steady - begun_ > expected + kFramePatience;
  };
  while (is_old()) {
    parser_.giveUp();
    takeFrames(now);
  }
}

void Conversation::take(const Frame& frame, const Moment& now) {
  if (frame.header.version != kProtocolVersion) return refuseVersion(frame.header.version, now);
  Identity identity;
  Acknowledgement answer;
  Pong pong;
  if (decode(frame, identity)) takeIdentity(identity);
  if (frame.header.kind == FrameKind::kScan) {
    if (isOfDevice(frame)) {
      observeArrival(frame, now);
      takeScan(now);
    } else {
      ++counts_.refused_scans;
    }
  } else if (device_ && decode(frame, pong)) {
    observeArrival(frame, now);
    takePong(pong, now);
  } else if (decode(frame, answer)) {
    takeAcknowledgement(answer);
  }
}

void Conversation::refuseVersion(int version, const Moment& now) {
  if (isScanning(now)) return;
  trouble_ =
      trouble(Fault::kWrongVersion, fmt::format("{}, expected {}", version, kProtocolVersion));
}

// A device that was known before the line was opened goes on by itself. A scan from after a reboot
// that went unnoticed makes it an unknown device, which is asked at once.
bool Conversation::isOfDevice(const Frame& scan) {
  if (!decode(scan, report_)) return false;
  const bool is_known = known_ && report_.boot == known_->boot;
  if (is_known) {
    device_ = known_;
  } else {
    device_.reset();
  }
  return is_known;
}

Trouble Conversation::faultOf(const Identity& identity) const {
  if (identity.model != kModel) {
    return trouble(Fault::kWrongDevice, fmt::format("'{}', expected '{}'", identity.model, kModel));
  }
  if (identity.serial != config_.serial) {
    return trouble(Fault::kWrongSerial,
                   fmt::format("the device is '{}', the calibration is for '{}'", identity.serial,
                               config_.serial));
  }
  if (identity.samples != config_.samples) {
    return trouble(Fault::kWrongSamples, fmt::format("the device takes {}, the calibration has {}",
                                                     identity.samples, config_.samples));
  }
  return {};
}

void Conversation::takeIdentity(const Identity& identity) {
  const Trouble fault = faultOf(identity);
  if (fault.fault != Fault::kNone) {
    trouble_ = fault;
    device_.reset();
    known_.reset();
    return;
  }
  if (!known_ || identity.boot != known_->boot) {
    if (known_) ++counts_.reboots;
    clock_.reset();
    number_.reset();
  }
  known_ = device_ = identity;
  trouble_ = {};
  just_identified_ = true;
}

void Conversation::takeAcknowledgement(const Acknowledgement& answer) {
  if (!command_ || answer.command != FrameKind::kHeadTarget ||
      answer.sequence != command_->sequence) {
    return;
  }
  if (answer.result != CommandResult::kDone) ++counts_.refused_commands;
  command_.reset();
}

void Conversation::takePong(const Pong& pong, const Moment& now) {
  // The token is the low end of the time at which the last byte of the ping went.
  const std::int64_t ago = 1000 * static_cast<std::int64_t>(microseconds(now.steady) - pong.token);
  if (ago < 10'000 * kMillisecond) clock_.observeDeparture(now.steady - ago, pong.received);
}

void Conversation::observeArrival(const Frame& frame, const Moment& now) {
  const std::size_t size = kHeaderSize + frame.payload.size + kTrailerSize;
  clock_.observeArrival(frame.header.clock, now.steady - lineTime(size, config_.baud_rate));
}

void Conversation::countLost() {
  if (number_) counts_.lost_scans += report_.number - *number_ - 1;
  number_ = report_.number;
}

void Conversation::takeScan(const Moment& now) {
  const auto time = clock_.hostTime(report_.first_sample);
  const bool goes_back = number_ && static_cast<std::int32_t>(report_.number - *number_) <= 0;
  if (!time || goes_back || report_.currents.size() != config_.samples) {
    ++counts_.refused_scans;
    number_.reset();  // or one wrong number would shut out all that come after it
    return;
  }
  countLost();
  if (report_.status & ScanReport::kSaturated) ++counts_.saturated_scans;
  toRawScan(report_, scan_);
  scan_.stamp = *time + now.system - now.steady;
  ++counts_.scans;
  last_scan_ = now.steady;
  broken_before_ = broken();
  trouble_ = {};
  on_scan_(scan_);
}

std::size_t Conversation::broken() const {
  return parser_.counts().bad_headers + parser_.counts().bad_frames;
}

bool Conversation::isScanning(const Moment& now) const {
  return device_ && now.steady - last_scan_ < kSilence && counts_.scans > 0;
}

void Conversation::judgeSilence(const Moment& now) {
  const bool is_of_device =
      trouble_.fault == Fault::kWrongDevice || trouble_.fault == Fault::kWrongVersion ||
      trouble_.fault == Fault::kWrongSerial || trouble_.fault == Fault::kWrongSamples;
  if (now.steady - last_scan_ < kPatience) return;
  const auto secondsSince = [&](std::int64_t time) {
    return 1e-9 * static_cast<double>(now.steady - time);
  };
  if (now.steady - last_byte_ >= kPatience) {
    trouble_ = trouble(Fault::kSilentDevice,
                       fmt::format("nothing came for {:.0f} s", secondsSince(last_byte_)));
  } else if (now.steady - last_frame_ >= kPatience || broken() > broken_before_) {
    trouble_ = trouble(Fault::kGarbage,
                       fmt::format("bytes, and no scan for {:.0f} s", secondsSince(last_scan_)));
  } else if (!is_of_device) {
    trouble_ = trouble(Fault::kNoScans, fmt::format("it answers, but sent none for {:.0f} s",
                                                    secondsSince(last_scan_)));
  }
}

std::int64_t Conversation::askingPeriod() const {
  const bool is_unknown = trouble_.fault != Fault::kNone &&
                          trouble_.fault != Fault::kSilentDevice &&
                          trouble_.fault != Fault::kNoScans;
  return is_unknown ? kUnknownDevicePeriod : kAskingPeriod;
}

template <class Message>
void Conversation::put(const Message& message, const Moment& now) {
  FrameHeader header;
  header.sequence = ++sequence_;
  header.clock = microseconds(now.steady);
  const auto& frame = encoder_.encode(header, message);
  outgoing_.insert(outgoing_.end(), frame.begin(), frame.end());
}

const std::vector<std::uint8_t>& Conversation::send(const Moment& now) {
  outgoing_.clear();
  giveUpOldFrame(now);
  judgeSilence(now);
  const bool is_quiet = !device_ || now.steady - last_scan_ >= kSilence;
  if (std::exchange(just_identified_, false)) {
    put(Start{}, now);
  } else if (is_quiet && now.steady - last_asked_ >= askingPeriod()) {
    last_asked_ = now.steady;
    put(Identify{}, now);
  }
  sendCommand(now);
  if (device_ && now.steady - last_ping_ >= kPingPeriod) {
    last_ping_ = now.steady;
    const std::size_t size = outgoing_.size() + kHeaderSize + 4 + kTrailerSize;
    put(Ping{microseconds(now.steady + lineTime(size, config_.baud_rate))}, now);
  }
  return outgoing_;
}

const std::vector<std::uint8_t>& Conversation::stop(const Moment& now) {
  outgoing_.clear();
  if (device_) put(Stop{}, now);
  return outgoing_;
}

void Conversation::command(const motion::HeadCommand& command, const Moment& now) {
  command_ = PendingCommand{{command}, now.steady, now.steady - kCommandPeriod, 0};
}

void Conversation::sendCommand(const Moment& now) {
  if (!command_) return;
  if (now.steady - command_->given > kCommandPatience) {
    ++counts_.lost_commands;
    command_.reset();
  } else if (device_ && now.steady - command_->sent >= kCommandPeriod) {
    command_->sent = now.steady;
    put(command_->target, now);
    command_->sequence = sequence_;
  }
}

}  // namespace sightline::driver
