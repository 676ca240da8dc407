#include "sightline/driver/conversation.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "sightline/driver/scan_report_conversion.h"

namespace sightline::driver {

namespace {

constexpr std::int64_t kMillisecond = 1'000'000;       // [ns]
constexpr std::int64_t kSilence = 250 * kMillisecond;  // two scans of 10 a second have not come
constexpr std::int64_t kLongestSilence = 2500 * kMillisecond;
constexpr std::int64_t kPatience = 1000 * kMillisecond;  // before silence is a fault
constexpr std::int64_t kAskingPeriod = 40 * kMillisecond;
constexpr std::int64_t kLongestAskingPeriod = 640 * kMillisecond;
constexpr int kQuickQuestions = 10;  // before the pauses grow
constexpr std::int64_t kUnknownDevicePeriod =
    250 * kMillisecond;  // of asking a device that is not the right one
constexpr std::int64_t kFramePatience = 50 * kMillisecond;  // beyond what its bytes take
constexpr std::int64_t kPingPeriod = 250 * kMillisecond;
constexpr std::size_t kGlint = 3;  // samples that may be at an end of the count

std::uint32_t microseconds(std::int64_t time) {
  return static_cast<std::uint32_t>(time / 1000);
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
    : config_(std::move(config)),
      on_scan_(std::move(on_scan)),
      clock_(config_.clock, config_.baud_rate),
      head_(config_.head) {}

void Conversation::open(const Moment& now) {
  parser_.clear();
  clock_.open();
  device_.reset();
  times_asked_ = 0;
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
    const std::int64_t expected = clock_.lineTime(parser_.awaited());
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
    if (isOfDevice(frame)) takeScan(frame, now);
  } else if (device_ && decode(frame, pong)) {
    takePong(frame, pong, now);
  } else if (decode(frame, answer)) {
    commands_.take(answer);
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
  if (!decode(scan, report_)) {
    refuse("a sample period or a unit of 0, or a payload that is not of its number of samples");
    return false;
  }
  const bool is_known = known_ && report_.boot == known_->boot;
  if (is_known) {
    device_ = known_;
  } else {
    device_.reset();
    refuse("of another boot than the device has named");
  }
  return is_known;
}

void Conversation::refuse(std::string reason) {
  ++counts_.refused_scans;
  refusal_ = std::move(reason);
  last_refusal_ = std::max(last_byte_, last_scan_);
  number_.reset();  // or one wrong number would shut out all that come after it
}

void Conversation::takeIdentity(const Identity& identity) {
  const Trouble fault = config_.device.faultOf(identity);
  if (fault.fault != Fault::kNone) {
    trouble_ = fault;
    device_.reset();
    known_.reset();
    return;
  }
  if (!known_ || identity.boot != known_->boot) {
    if (known_) ++counts_.reboots;
    clock_.restart();
    number_.reset();
  }
  known_ = device_ = identity;
  trouble_ = {};
  just_identified_ = true;
}

void Conversation::takePong(const Frame& frame, const Pong& pong, const Moment& now) {
  // The token is the low end of the time at which the last byte of the ping was to have gone. On
  // native USB the answer may be here before.
  const auto ago = static_cast<std::int32_t>(microseconds(now.steady) - pong.token);
  if (std::abs(ago) < 10'000'000) {
    clock_.takePong(frame, pong, now.steady - 1000 * std::int64_t{ago}, now.steady);
  }
}

void Conversation::countLost() {
  if (number_) counts_.lost_scans += report_.number - *number_ - 1;
  number_ = report_.number;
}

std::string Conversation::faultOf(const ScanReport& report) const {
  const bool goes_back = number_ && static_cast<std::int32_t>(report.number - *number_) <= 0;
  if (goes_back) return fmt::format("number {} after {}", report.number, *number_);
  return config_.device.faultOf(report);
}

void Conversation::takeScan(const Frame& frame, const Moment& now) {
  std::string fault = faultOf(report_);
  if (!fault.empty()) return refuse(std::move(fault));
  const bool follows = number_ && report_.number == *number_ + 1;
  if (follows) scan_pause_ = now.steady - last_scan_;
  countLost();
  deliver(clock_.stampOf(frame, report_, now.steady), now);
}

void Conversation::deliver(std::int64_t stamp, const Moment& now) {
  toRawScan(report_, scan_);
  if (saturatedSamples(scan_) > kGlint) ++counts_.saturated_scans;
  scan_.stamp = stamp + now.system - now.steady;
  ++counts_.scans;
  last_scan_ = now.steady;
  times_asked_ = 0;
  broken_before_ = broken();
  trouble_ = {};
  head_.observe(scan_.head_angles, now.steady);
  on_scan_(scan_);
}

std::size_t Conversation::broken() const {
  return parser_.counts().bad_headers + parser_.counts().bad_frames;
}

// Two of its own scans for a device that is slower than others.
std::int64_t Conversation::silence() const {
  return std::clamp(2 * scan_pause_ + scan_pause_ / 2, kSilence, kLongestSilence);
}

bool Conversation::isScanning(const Moment& now) const {
  return device_ && now.steady - last_scan_ < silence() && counts_.scans > 0;
}

void Conversation::judgeSilence(const Moment& now) {
  const bool is_of_device =
      trouble_.fault == Fault::kWrongDevice || trouble_.fault == Fault::kWrongVersion ||
      trouble_.fault == Fault::kWrongSerial || trouble_.fault == Fault::kWrongSamples;
  if (now.steady - last_scan_ < std::max(kPatience, silence())) return;
  const auto secondsSince = [&](std::int64_t time) {
    return 1e-9 * static_cast<double>(now.steady - time);
  };
  if (now.steady - last_byte_ >= kPatience) {
    trouble_ = trouble(Fault::kSilentDevice,
                       fmt::format("nothing came for {:.0f} s", secondsSince(last_byte_)));
  } else if (now.steady - last_frame_ >= kPatience || broken() > broken_before_) {
    trouble_ = trouble(Fault::kGarbage,
                       fmt::format("bytes, and no scan for {:.0f} s", secondsSince(last_scan_)));
  } else if (last_refusal_ > last_scan_) {
    trouble_ = trouble(Fault::kRefusedScans, refusal_);
  } else if (!is_of_device) {
    trouble_ = trouble(Fault::kNoScans, fmt::format("it answers, but sent none for {:.0f} s",
                                                    secondsSince(last_scan_)));
  }
}

// A device that does not answer is left more and more in peace.
std::int64_t Conversation::askingPeriod() const {
  const bool is_unknown = trouble_.fault != Fault::kNone &&
                          trouble_.fault != Fault::kSilentDevice &&
                          trouble_.fault != Fault::kNoScans;
  if (is_unknown) return kUnknownDevicePeriod;
  const int doublings = std::clamp(times_asked_ - kQuickQuestions, 0, 4);
  return std::min(kAskingPeriod << doublings, kLongestAskingPeriod);
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
  const bool is_quiet = !device_ || now.steady - last_scan_ >= silence();
  if (std::exchange(just_identified_, false)) {
    put(Start{}, now);
  } else if (is_quiet && now.steady - last_asked_ >= askingPeriod()) {
    last_asked_ = now.steady;
    ++times_asked_;
    put(Identify{}, now);
  }
  sendCommand(now);
  if (device_ && now.steady - last_ping_ >= kPingPeriod) {
    last_ping_ = now.steady;
    const std::size_t size = outgoing_.size() + kHeaderSize + 4 + kTrailerSize;
    put(Ping{microseconds(now.steady + clock_.lineTime(size))}, now);
  }
  return outgoing_;
}

const std::vector<std::uint8_t>& Conversation::stop(const Moment& now) {
  outgoing_.clear();
  if (device_) put(Stop{}, now);
  return outgoing_;
}

void Conversation::command(const motion::HeadCommand& command, const Moment& now) {
  commands_.give(command, now.steady);
  head_.command(command, now.steady);
}

void Conversation::sendCommand(const Moment& now) {
  if (!device_) return commands_.dropLost(now.steady);
  if (const auto target = commands_.due(now.steady)) {
    put(*target, now);
    commands_.sent(sequence_);
  }
}

}  // namespace sightline::driver
