#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>

#include "sightline/triangulation/ranger.h"

namespace sightline::driver {

/// Scans from the thread that receives them to the one that works on them, so that no work makes a
/// byte late.
class ScanQueue {
 public:
  /// The oldest scan gives way where `capacity` scans wait.
  explicit ScanQueue(std::size_t capacity) : capacity_(capacity) {}

  void push(const triangulation::RawScan& scan);
  /// Waits for a scan; nothing once the queue is closed.
  std::optional<triangulation::RawScan> pop();
  void close();
  /// Scans that gave way.
  std::size_t overruns() const;

 private:
  const std::size_t capacity_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<triangulation::RawScan> scans_;
  std::size_t overruns_ = 0;
  bool closed_ = false;
};

}  // namespace sightline::driver
