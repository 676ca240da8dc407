#pragma once

#include <string>
#include <vector>

struct gzFile_s;

namespace sightline::logs {

/// The lines of a text file, plain or compressed with gzip, read as a stream.
class LineReader {
 public:
  /// Throws config::Error if the file cannot be opened.
  explicit LineReader(const std::string& path);
  ~LineReader();
  LineReader(const LineReader&) = delete;
  LineReader& operator=(const LineReader&) = delete;

  /// The next line without its end (LF or CR LF); false at the end of the file. Throws
  /// config::Error on damaged compression and on a line longer than 1 MiB, which no text has.
  bool next(std::string& line);

  const std::string& path() const { return path_; }
  /// Number of the line returned last, from 1.
  int number() const { return number_; }
  /// Whether the line returned last ran into the end of the file instead of a line end.
  bool isUnterminated() const { return unterminated_; }
  /// Whether the compressed data stopped before its end.
  bool isCutOff() const { return cut_off_; }

 private:
  bool fill();

  std::string path_;
  gzFile_s* file_;
  std::vector<char> buffer_;
  std::size_t position_ = 0;
  std::size_t filled_ = 0;
  int number_ = 0;
  bool unterminated_ = false;
  bool cut_off_ = false;
};

}  // namespace sightline::logs
