#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "scripted_transforms.h"
#include "sightline/pipeline/scan_feed.h"

namespace sightline::test {

using geometry::Pose2;
using pipeline::FeedConfig;
using pipeline::FeedNeeds;
using pipeline::FeedResult;
using pipeline::ScanFeed;

inline std::int64_t at(double seconds) {
  return std::llround(1e9 * seconds);
}

// Eleven beams over a sweep of so many seconds, two metres from everything.
inline scan::Scan sweep(double stamp, double duration = 0.1, const std::string& frame = "laser") {
  const auto geometry = scan::ScanGeometry::uniform(-0.5, 0.1, 11, duration / 10.0, 0.1, 10.0);
  scan::Scan scan(geometry, at(stamp), std::vector<double>(11, 2.0));
  scan.frame = frame;
  return scan;
}

class ScanFeedTest : public testing::Test {
 protected:
  void start(const FeedConfig& config = {}, const FeedNeeds& needs = {}) {
    feed_.emplace(config, pipeline::Frames{}, needs, transforms_);
    feed_->addScanner();
    feed_->addScanner();
  }
  // Drives straight on at 1 m/s, in steps of 50 ms.
  void drive(double from, double to) {
    for (double time = from; time < to + 1e-6; time += 0.05) {
      transforms_.drive(at(time), Pose2(time - 10.0, 0.0, 0.0));
    }
  }
  std::vector<FeedResult> all(double now) {
    std::vector<FeedResult> results;
    while (auto result = feed_->next(at(now))) results.push_back(*result);
    return results;
  }
  std::vector<FeedResult> rest() {
    std::vector<FeedResult> results;
    while (auto result = feed_->flush()) results.push_back(*result);
    return results;
  }

  test::ScriptedTransforms transforms_;
  std::optional<ScanFeed> feed_;
};

}  // namespace sightline::test
