#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

/// Numbers as they go over the line: little endian, two's complement.
namespace sightline::driver {

/// Bytes that somebody else keeps.
struct ByteView {
  const std::uint8_t* data = nullptr;
  std::size_t size = 0;
};

/// Appends to a vector, which allocates nothing once it has grown.
class ByteWriter {
 public:
  explicit ByteWriter(std::vector<std::uint8_t>& bytes) : bytes_(bytes) {}

  void u8(std::uint8_t value) { bytes_.push_back(value); }
  void u16(std::uint16_t value) { little(value, 2); }
  void u32(std::uint32_t value) { little(value, 4); }
  void i16(std::int16_t value) { little(static_cast<std::uint16_t>(value), 2); }
  void i24(std::int32_t value) { little(static_cast<std::uint32_t>(value), 3); }
  void i32(std::int32_t value) { little(static_cast<std::uint32_t>(value), 4); }
  /// Exactly `width` bytes: cut off, or filled with zeros.
  void text(const std::string& value, std::size_t width);

 private:
  void little(std::uint32_t value, int bytes) {
    for (int i = 0; i < bytes; ++i) bytes_.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
  }

  std::vector<std::uint8_t>& bytes_;
};

/// Reads one number after the other. Beyond the end all is zero, and ok() is false from then on.
class ByteReader {
 public:
  explicit ByteReader(ByteView bytes) : bytes_(bytes) {}

  std::uint8_t u8() { return static_cast<std::uint8_t>(little(1)); }
  std::uint16_t u16() { return static_cast<std::uint16_t>(little(2)); }
  std::uint32_t u32() { return little(4); }
  std::int16_t i16() { return static_cast<std::int16_t>(little(2)); }
  std::int32_t i24() { return static_cast<std::int32_t>(little(3) << 8) >> 8; }
  std::int32_t i32() { return static_cast<std::int32_t>(little(4)); }
  /// `width` bytes without the zeros at their end; not ok() unless the rest is printable ASCII.
  std::string text(std::size_t width);

  std::size_t left() const { return bytes_.size - at_; }
  bool ok() const { return ok_; }

 private:
  std::uint32_t little(std::size_t bytes) {
    if (left() < bytes) {
      ok_ = false;
      return 0;
    }
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < bytes; ++i) {
      value |= static_cast<std::uint32_t>(bytes_.data[at_++]) << (8 * i);
    }
    return value;
  }

  ByteView bytes_;
  std::size_t at_ = 0;
  bool ok_ = true;
};

}  // namespace sightline::driver
