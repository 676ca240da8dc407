#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "sightline/driver/frame.h"

namespace sightline::driver {

/// Finds the frames in a stream of bytes that may be broken anywhere. What fails a checksum is left
/// from its second byte on, not from its end, so that no whole frame is lost to the ruins of
/// another one.
///
///     for (taken = 0; taken < size;) {
///       taken += parser.append({bytes + taken, size - taken});
///       while (auto frame = parser.next()) use(*frame);
///     }
class FrameParser {
 public:
  struct Counts {
    std::size_t frames = 0;
    std::size_t bad_headers = 0;    ///< what looked like a beginning and was none, or was broken
    std::size_t bad_frames = 0;     ///< a sound header with a broken rest
    std::size_t skipped_bytes = 0;  ///< that belong to no frame
  };

  FrameParser();

  /// Takes as many bytes as there is room for; at least one if next() has nothing more to give.
  std::size_t append(ByteView bytes);
  /// The next whole frame, of any version. It is good until the next call of append() or next().
  std::optional<Frame> next();
  /// Bytes that wait for the rest of their frame; 0 where nothing has begun.
  std::size_t waiting() const { return end_ - begin_; }
  /// Size of the frame that has begun, as far as it is known.
  std::size_t awaited() const;
  /// Takes what has begun for ruins: the rest of it has not come. next() goes on behind its start.
  void giveUp() {
    if (waiting() > 0) skip(1);
  }
  /// Forgets a frame begun, as after opening the port; the counts go on.
  void clear() { begin_ = end_ = 0; }

  const Counts& counts() const { return counts_; }

 private:
  bool findSync();
  bool headerIsSound() const;
  void skip(std::size_t bytes);
  Frame frameAt(std::size_t begin, std::size_t payload_size) const;

  std::vector<std::uint8_t> buffer_;  // of a fixed size; [begin_, end_) is waiting
  std::size_t begin_ = 0;
  std::size_t end_ = 0;
  Counts counts_;
};

}  // namespace sightline::driver
