#include "sightline/driver/scan_queue.h"

#include <utility>

namespace sightline::driver {

void ScanQueue::push(const triangulation::RawScan& scan) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (scans_.size() == capacity_) {
      ++overruns_;
      scans_.pop_front();
    }
    scans_.push_back(scan);
  }
  changed_.notify_one();
}

std::optional<triangulation::RawScan> ScanQueue::pop() {
  std::unique_lock<std::mutex> lock(mutex_);
  changed_.wait(lock, [this] { return closed_ || !scans_.empty(); });
  if (closed_) return std::nullopt;
  std::optional<triangulation::RawScan> scan(std::move(scans_.front()));
  scans_.pop_front();
  return scan;
}

void ScanQueue::close() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    closed_ = true;
  }
  changed_.notify_all();
}

std::size_t ScanQueue::overruns() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return overruns_;
}

}  // namespace sightline::driver
