#pragma once

#include <cstdint>
#include <optional>

#include "sightline/driver/messages.h"

namespace sightline::driver {

/// The newest command to the head, until the device has acknowledged it. A newer one takes its
/// place; sent at most every 20 ms, and while no answer comes again after 100, 300 and 700 ms.
class HeadCommandOutbox {
 public:
  struct Counts {
    std::size_t refused = 0;  ///< by the device
    std::size_t lost = 0;     ///< not acknowledged within a second, nor replaced before
  };

  void give(const motion::HeadCommand& command, std::int64_t now);
  /// Gives up a command that is older than a second.
  void dropLost(std::int64_t now);
  /// What has to be sent now, if anything. Times are steady [ns].
  std::optional<HeadTarget> due(std::int64_t now);
  /// The frame in which it went.
  void sent(std::uint16_t sequence) { sequence_ = sequence; }
  void take(const Acknowledgement& answer);

  const Counts& counts() const { return counts_; }

 private:
  struct Pending {
    HeadTarget target;
    std::int64_t given = 0;
    int times_sent = 0;
  };

  std::optional<Pending> pending_;
  std::optional<std::uint16_t> sequence_;  // of the frame that the pending one went in
  std::int64_t last_sent_ = 0;
  Counts counts_;
};

}  // namespace sightline::driver
