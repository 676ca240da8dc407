#include "sightline/bridge/line_messages.h"

#include <gtest/gtest.h>

#include "sightline/bridge/line_settings.h"

namespace sightline::bridge {
namespace {

geometry::LineSegment segment() {
  geometry::LineSegment result;
  result.id = 7;
  result.line.rho = 2.0;
  result.line.phi = 0.5;
  result.line.covariance << 1e-4, 2e-5, 2e-5, 3e-4;
  result.ends = {{1.0, 2.0}, {3.0, 4.0}};
  result.start_sigma = 0.01;
  result.end_sigma = 0.02;
  result.start_kind = geometry::EndKind::kCorner;
  result.end_kind = geometry::EndKind::kScanLimit;
  result.first_beam = 700;
  result.last_beam = 20;
  result.beams = 41;
  result.chi_square = 38.5;
  result.degrees_of_freedom = 39;
  return result;
}

TEST(LineMessages, ArcsSurviveTheWay) {
  geometry::Arc arc;
  arc.id = 3;
  arc.centre = {1.0, -2.0};
  arc.radius = 0.25;
  arc.covariance << 1, 2, 3, 2, 5, 6, 3, 6, 9;
  arc.start_angle = 2.5;
  arc.end_angle = 4.5;
  arc.first_beam = 30;
  arc.last_beam = 41;
  arc.beams = 11;
  arc.chi_square = 9.5;
  arc.degrees_of_freedom = 10;
  const Arc message = toMessage(arc);
  EXPECT_EQ(message.covariance[1], 2.0);
  EXPECT_EQ(message.covariance[5], 6.0);
  const geometry::Arc back = fromMessage(message);
  EXPECT_EQ(back.id, arc.id);
  EXPECT_EQ(back.centre, arc.centre);
  EXPECT_EQ(back.radius, arc.radius);
  EXPECT_EQ(back.covariance, arc.covariance);
  EXPECT_EQ(back.start_angle, arc.start_angle);
  EXPECT_EQ(back.end_angle, arc.end_angle);
  EXPECT_EQ(back.first_beam, arc.first_beam);
  EXPECT_EQ(back.last_beam, arc.last_beam);
  EXPECT_EQ(back.beams, arc.beams);
  EXPECT_EQ(back.chi_square, arc.chi_square);
  EXPECT_EQ(back.degrees_of_freedom, arc.degrees_of_freedom);
}

TEST(LineMessages, FillEveryField) {
  const LineSegment message = toMessage(segment());
  EXPECT_EQ(message.id, 7U);
  EXPECT_EQ(message.rho, 2.0);
  EXPECT_EQ(message.phi, 0.5);
  EXPECT_EQ(message.covariance[0], 1e-4);
  EXPECT_EQ(message.covariance[1], 2e-5);
  EXPECT_EQ(message.covariance[2], 2e-5);
  EXPECT_EQ(message.covariance[3], 3e-4);
  EXPECT_EQ(message.start.x, 1.0);
  EXPECT_EQ(message.start.y, 2.0);
  EXPECT_EQ(message.end.x, 3.0);
  EXPECT_EQ(message.end.y, 4.0);
  EXPECT_EQ(message.start_sigma, 0.01);
  EXPECT_EQ(message.end_sigma, 0.02);
  EXPECT_EQ(message.start_kind, LineSegment::CORNER);
  EXPECT_EQ(message.end_kind, LineSegment::SCAN_LIMIT);
  EXPECT_EQ(message.first_beam, 700U);
  EXPECT_EQ(message.last_beam, 20U);
  EXPECT_EQ(message.beams, 41U);
  EXPECT_EQ(message.chi_square, 38.5);
  EXPECT_EQ(message.degrees_of_freedom, 39U);
}

TEST(LineMessages, ComeBackAsTheyWent) {
  const LineSegment message = toMessage(segment());
  EXPECT_EQ(toMessage(fromMessage(message)), message);
  LineSegment strange = message;
  strange.end_kind = 200;
  EXPECT_EQ(fromMessage(strange).end_kind, geometry::EndKind::kUnknown);
}

TEST(LineMessages, KindsOfEndsHaveTheNumbersOfTheMessage) {
  EXPECT_EQ(static_cast<int>(geometry::EndKind::kUnknown), LineSegment::UNKNOWN);
  EXPECT_EQ(static_cast<int>(geometry::EndKind::kCorner), LineSegment::CORNER);
  EXPECT_EQ(static_cast<int>(geometry::EndKind::kOccludingEdge), LineSegment::OCCLUDING_EDGE);
  EXPECT_EQ(static_cast<int>(geometry::EndKind::kOccluded), LineSegment::OCCLUDED);
  EXPECT_EQ(static_cast<int>(geometry::EndKind::kScanLimit), LineSegment::SCAN_LIMIT);
}

TEST(LineMessages, CarryStampAndFrameOfTheScanAlsoWhenEmpty) {
  scan::Scan scan;
  scan.stamp = 12'000'000'345;
  scan.frame = "laser";
  for (const std::size_t count : {0U, 3U}) {
    const std::vector<geometry::LineSegment> segments(count, segment());
    const LineSegmentArray message = toMessage(segments, {}, scan);
    EXPECT_EQ(message.header.stamp, ros::Time(12, 345));
    EXPECT_EQ(message.header.frame_id, "laser");
    EXPECT_EQ(message.segments.size(), count);
    EXPECT_EQ(fromMessage(message).size(), count);
  }
}

TEST(LineSettings, EveryFieldCanBeChangedWhileItRuns) {
  EXPECT_EQ(sightline::LineExtractorConfig::__getParamDescriptions__().size(),
            config::describe<lines::LineExtractorConfig>().size());
}

}  // namespace
}  // namespace sightline::bridge
