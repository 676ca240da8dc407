#include "sightline/logs/line_reader.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include <zlib.h>

#include "sightline/config/error.h"

namespace sightline::logs {

namespace {

constexpr std::size_t kBufferSize = 1 << 16;
constexpr std::size_t kLongestLine = 1 << 20;

gzFile openFile(const std::string& path) {
  if (std::filesystem::is_directory(path)) {
    throw config::Error(path, 0, "", "is a folder, not a file");
  }
  const gzFile file = gzopen(path.c_str(), "rb");
  if (!file) throw config::Error(path, 0, "", std::strerror(errno));
  return file;
}

}  // namespace

LineReader::LineReader(const std::string& path)
    : path_(path), file_(openFile(path)), buffer_(kBufferSize) {}

LineReader::~LineReader() {
  gzclose(file_);
}

bool LineReader::fill() {
  position_ = 0;
  const int count = gzread(file_, buffer_.data(), static_cast<unsigned>(buffer_.size()));
  filled_ = static_cast<std::size_t>(std::max(count, 0));
  if (count > 0) return true;
  int code = Z_OK;
  const char* message = gzerror(file_, &code);
  cut_off_ = code == Z_BUF_ERROR;
  if (code != Z_OK && !cut_off_) throw config::Error(path_, number_ + 1, "", message);
  return false;
}

bool LineReader::next(std::string& line) {
  line.clear();
  unterminated_ = false;
  for (;;) {
    if (position_ == filled_ && !fill()) break;
    const char* begin = buffer_.data() + position_;
    const std::size_t rest = filled_ - position_;
    const auto* end = static_cast<const char*>(std::memchr(begin, '\n', rest));
    const std::size_t length = end ? static_cast<std::size_t>(end - begin) : rest;
    line.append(begin, length);
    position_ += length + (end ? 1 : 0);
    if (line.size() > kLongestLine) {
      throw config::Error(path_, number_ + 1, "", "a line of more than 1 MiB: not a text file");
    }
    if (!end) continue;
    ++number_;
    if (!line.empty() && line.back() == '\r') line.pop_back();
    return true;
  }
  if (line.empty()) return false;
  ++number_;
  unterminated_ = true;
  return true;
}

}  // namespace sightline::logs
