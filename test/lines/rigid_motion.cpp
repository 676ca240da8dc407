#include <gtest/gtest.h>
// rapidcheck after gtest, which it extends.
#include <rapidcheck/gtest.h>

#include "lines/room_scan.h"
#include "property.h"
#include "sightline/lines/line_extractor.h"

namespace sightline::lines {
namespace {

using geometry::Pose2;
using test::ScanOf;
using test::within;

/// A pose in the room of test::room(), away from its walls.
rc::Gen<Pose2> poseInRoom() {
  return rc::gen::map(rc::gen::tuple(within(1.0), within(1.0), within(3.1)), [](const auto& p) {
    return Pose2(1.5 + 1.5 * std::get<0>(p), -0.25 + 1.2 * std::get<1>(p), std::get<2>(p));
  });
}

ScanOf fullTurn() {
  ScanOf scan = test::room();
  scan.angle_increment = geometry::radians(0.5);
  scan.beams = 720;
  return scan;
}

// The room stands still: wherever the sensor is, its lines are the walls moved into its frame.
RC_GTEST_PROP(RigidMotion, LinesMoveAsTheSceneDoes, ()) {
  const Pose2 pose = *poseInRoom();
  ScanOf scan = fullTurn();
  scan.pose = pose;
  LineExtractor extractor;
  const auto& segments = extractor.extract(scan.takeWithoutNoise());
  RC_ASSERT(segments.size() == 4U);
  for (const auto& wall : scan.walls) {
    const geometry::Segment moved = pose.inverse() * wall;
    std::size_t matches = 0;
    for (const auto& segment : segments) {
      if (geometry::difference(segment.line, moved.line()).norm() > 1e-3) continue;
      ++matches;
      RC_ASSERT((segment.ends.start - moved.start).norm() < 2e-3);
      RC_ASSERT((segment.ends.end - moved.end).norm() < 2e-3);
    }
    RC_ASSERT(matches == 1U);
  }
}

// The same ranges in other directions: everything turns, nothing else changes, noise and all.
RC_GTEST_PROP(RigidMotion, TurningTheSensorTurnsTheLines, ()) {
  const double turn = *within(3.1);
  test::Gauss gauss(static_cast<unsigned>(*rc::gen::inRange(0, 1000)));
  const ScanOf room = test::room();
  ScanOf turned = room;
  turned.angle_min += turn;
  const scan::Scan scan = room.take(gauss);
  const scan::Scan turned_scan = turned.withRanges(scan.ranges());

  LineExtractor first;
  LineExtractor second;
  const auto& here = first.extract(scan);
  const auto& there = second.extract(turned_scan);
  RC_ASSERT(here.size() == there.size());
  for (std::size_t i = 0; i < here.size(); ++i) {
    const geometry::PolarLine expected = geometry::transform(Pose2(0.0, 0.0, turn), here[i].line);
    const Eigen::Vector2d sigma = expected.covariance.diagonal().cwiseSqrt();
    const Eigen::Vector2d error = geometry::difference(there[i].line, expected);
    // A beam at the very edge of a gate may fall on its other side by the last digit.
    RC_ASSERT(error.cwiseQuotient(sigma).norm() < 0.1);
    RC_ASSERT((there[i].line.covariance - expected.covariance).norm() <
              0.02 * expected.covariance.norm());
  }
}

// The place of the sensor at the stamp is what counts, not how it moved from there.
RC_GTEST_PROP(RigidMotion, AMovingSensorSeesWhatAStandingOneSees, ()) {
  const double forward = *within(0.1);
  const double aside = *within(0.1);
  const double turn = *within(0.2);
  ScanOf scan = test::room();
  scan.motion = {forward, aside, turn};
  LineExtractor extractor;
  const auto segments = extractor.extract(scan.takeWithoutNoise());
  RC_ASSERT(segments.size() >= 4U);
  for (const auto& segment : segments) {
    double nearest = 1.0;
    for (const auto& wall : scan.walls) {
      nearest = std::min(nearest, geometry::difference(segment.line, wall.line()).norm());
    }
    RC_ASSERT(nearest < 1e-3);
  }
}

}  // namespace
}  // namespace sightline::lines
