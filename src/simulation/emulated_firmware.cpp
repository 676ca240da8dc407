#include "sightline/simulation/emulated_firmware.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sightline/driver/scan_report_conversion.h"

namespace sightline::simulation {

EmulatedFirmware::EmulatedFirmware(const FirmwareConfig& config, DeviceModel& model,
                                   std::uint64_t seed)
    : config_(config), model_(model), random_(randomStream(seed, 2)) {}

void EmulatedFirmware::boot(std::int64_t time) {
  config_.identity.boot = static_cast<std::uint32_t>(random_());
  scanning_ = false;
  number_ = 0;
  booted_ = clock_origin_ = line_free_ = time;
  clock_reading_ = config_.first_clock;
  parser_.clear();
  put(config_.identity, time);
}

void EmulatedFirmware::setDrift(double ppm, std::int64_t time) {
  clock_reading_ += 1e-3 * static_cast<double>(time - clock_origin_) * (1.0 + 1e-6 * config_.drift);
  clock_origin_ = time;
  config_.drift = ppm;
}

std::uint32_t EmulatedFirmware::clockAt(std::int64_t time) const {
  const double since = 1e-3 * static_cast<double>(time - clock_origin_);
  return static_cast<std::uint32_t>(
      std::llround(clock_reading_ + since * (1.0 + 1e-6 * config_.drift)));
}

void EmulatedFirmware::receive(driver::ByteView bytes, std::int64_t time) {
  for (std::size_t taken = 0; taken < bytes.size;) {
    taken += parser_.append({bytes.data + taken, bytes.size - taken});
    while (const auto frame = parser_.next()) answer(*frame, time);
  }
}

void EmulatedFirmware::answer(const driver::Frame& frame, std::int64_t time) {
  using driver::CommandResult;
  driver::Ping ping;
  driver::HeadTarget target;
  if (decode(frame, ping)) return put(driver::Pong{ping.token, clockAt(time)}, time);
  if (frame.header.kind == driver::FrameKind::kIdentify) return put(config_.identity, time);
  if (decode(frame, target)) {
    const bool done = model_.command(target.command);
    return acknowledge(frame, done ? CommandResult::kDone : CommandResult::kBeyondLimits, time);
  }
  driver::Start start;
  driver::Stop stop;
  if (decode(frame, start)) {
    scanning_ = true;
  } else if (decode(frame, stop)) {
    scanning_ = false;
  } else {
    return acknowledge(frame, CommandResult::kUnknown, time);
  }
  acknowledge(frame, CommandResult::kDone, time);
}

void EmulatedFirmware::acknowledge(const driver::Frame& frame, driver::CommandResult result,
                                   std::int64_t time) {
  put(driver::Acknowledgement{frame.header.kind, result, frame.header.sequence}, time);
}

void EmulatedFirmware::advance(std::int64_t time) {
  for (const triangulation::RawScan& scan : model_.advance(time)) {
    if (scan.stamp < booted_) continue;
    if (scanning_) sendScan(scan, time);
    ++number_;
  }
}

void EmulatedFirmware::sendScan(const triangulation::RawScan& scan, std::int64_t time) {
  report_.number = number_;
  report_.boot = config_.identity.boot;
  report_.first_sample = clockAt(scan.stamp);
  report_.sample_period = config_.sample_period;
  report_.femtoamperes_per_count = kFemtoamperesPerCount;
  driver::fillReport(scan, report_);
  put(report_, time);
  SentScan sent{number_, {}, scan};
  driver::toRawScan(report_, sent.scan);
  sent.scan.stamp = scan.stamp;
  outbox_.back().scan = std::move(sent);
}

template <class Message>
void EmulatedFirmware::put(const Message& message, std::int64_t time) {
  const std::int64_t begin = std::max(time, line_free_);
  payload_.clear();
  driver::ByteWriter writer(payload_);
  message.write(writer);
  const driver::FrameHeader header{config_.version, Message::kKind, ++sequence_, clockAt(begin)};
  const auto& bytes = encoder_.encodeBytes(header, {payload_.data(), payload_.size()});
  line_free_ = begin + std::llround(1e9 * driver::lineSeconds(bytes.size(), config_.baud_rate));
  outbox_.push_back({bytes, line_free_, std::nullopt});
}

std::vector<SentFrame> EmulatedFirmware::take() {
  return std::exchange(outbox_, {});
}

}  // namespace sightline::simulation
