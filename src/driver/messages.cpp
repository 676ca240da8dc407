#include "sightline/driver/messages.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sightline::driver {

namespace {

constexpr std::size_t kTextWidth = 16;
constexpr std::size_t kBytesPerSample = 2 + 3 + 3;

std::int32_t toMicro(double value) {
  using Limits = std::numeric_limits<std::int32_t>;
  return static_cast<std::int32_t>(
      std::lround(std::clamp<double>(1e6 * value, Limits::min(), Limits::max())));
}

double fromMicro(std::int32_t value) {
  return 1e-6 * value;
}

}  // namespace

// The modes on the line are numbered as in the enumeration.
void HeadTarget::write(ByteWriter& writer) const {
  writer.u8(static_cast<std::uint8_t>(command.mode));
  writer.i32(toMicro(command.position));
  writer.i32(toMicro(command.rate));
}

bool HeadTarget::read(ByteReader& reader) {
  using Mode = motion::HeadCommand::Mode;
  const std::uint8_t mode = reader.u8();
  command.mode = static_cast<Mode>(mode);
  command.position = fromMicro(reader.i32());
  command.rate = fromMicro(reader.i32());
  return mode <= static_cast<std::uint8_t>(Mode::kStop);
}

bool Ping::read(ByteReader& reader) {
  token = reader.u32();
  return true;
}

void Identity::write(ByteWriter& writer) const {
  writer.text(model, kTextWidth);
  writer.text(serial, kTextWidth);
  writer.u8(firmware_major);
  writer.u8(firmware_minor);
  writer.u16(samples);
  writer.u32(boot);
}

bool Identity::read(ByteReader& reader) {
  model = reader.text(kTextWidth);
  serial = reader.text(kTextWidth);
  firmware_major = reader.u8();
  firmware_minor = reader.u8();
  samples = reader.u16();
  boot = reader.u32();
  return true;
}

void Acknowledgement::write(ByteWriter& writer) const {
  writer.u8(static_cast<std::uint8_t>(command));
  writer.u8(static_cast<std::uint8_t>(result));
  writer.u16(sequence);
}

bool Acknowledgement::read(ByteReader& reader) {
  command = static_cast<FrameKind>(reader.u8());
  result = static_cast<CommandResult>(reader.u8());
  sequence = reader.u16();
  return result <= CommandResult::kBeyondLimits;
}

void Pong::write(ByteWriter& writer) const {
  writer.u32(token);
  writer.u32(received);
}

bool Pong::read(ByteReader& reader) {
  token = reader.u32();
  received = reader.u32();
  return true;
}

void ScanReport::write(ByteWriter& writer) const {
  writer.u32(number);
  writer.u32(boot);
  writer.u32(first_sample);
  writer.u32(sample_period);
  writer.u32(femtoamperes_per_count);
  writer.u16(status);
  writer.u16(static_cast<std::uint16_t>(currents.size()));
  for (const std::int16_t angle : head_angles) writer.i16(angle);
  for (const Counts& pair : currents) {
    writer.i24(pair.first);
    writer.i24(pair.second);
  }
}

bool ScanReport::read(ByteReader& reader) {
  number = reader.u32();
  boot = reader.u32();
  first_sample = reader.u32();
  sample_period = reader.u32();
  femtoamperes_per_count = reader.u32();
  status = reader.u16();
  const std::size_t samples = reader.u16();
  if (reader.left() != samples * kBytesPerSample) return false;
  head_angles.resize(samples);
  currents.resize(samples);
  for (std::int16_t& angle : head_angles) angle = reader.i16();
  for (Counts& pair : currents) {
    pair.first = reader.i24();
    pair.second = reader.i24();
  }
  return samples > 0 && sample_period > 0 && femtoamperes_per_count > 0;
}

}  // namespace sightline::driver
