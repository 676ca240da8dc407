#include "sightline/driver/bytes.h"

#include <algorithm>

namespace sightline::driver {

void ByteWriter::text(const std::string& value, std::size_t width) {
  for (std::size_t i = 0; i < width; ++i) {
    bytes_.push_back(i < value.size() ? static_cast<std::uint8_t>(value[i]) : 0U);
  }
}

std::string ByteReader::text(std::size_t width) {
  std::string value;
  for (std::size_t i = 0; i < width; ++i) value.push_back(static_cast<char>(u8()));
  value.erase(std::find_if(value.rbegin(), value.rend(), [](char c) { return c != 0; }).base(),
              value.end());
  ok_ &= std::all_of(value.begin(), value.end(), [](char c) { return c >= 0x20 && c < 0x7F; });
  return value;
}

}  // namespace sightline::driver
