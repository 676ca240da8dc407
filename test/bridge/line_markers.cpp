#include "sightline/bridge/line_markers.h"

#include <cmath>
#include <map>
#include <string>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sightline::bridge {
namespace {

using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

// Display of rviz after a sequence of arrays: markers by name and id.
class Screen {
 public:
  void show(const MarkerArray& array) {
    for (const Marker& marker : array.markers) {
      const std::pair<std::string, int> key(marker.ns, marker.id);
      if (marker.action == Marker::ADD) shown[key] = marker;
      if (marker.action == Marker::DELETE) shown.erase(key);
    }
  }
  std::size_t points(const std::string& name) const {
    const auto found = shown.find({name, 0});
    return found == shown.end() ? 0 : found->second.points.size();
  }
  std::map<std::pair<std::string, int>, Marker> shown;
};

// The wall y = 2 from x = −1 to 1.
geometry::LineSegment wall() {
  geometry::LineSegment segment;
  segment.line.rho = 2.0;
  segment.line.phi = 0.5 * M_PI;
  segment.line.covariance << 1e-4, 0.0, 0.0, 4e-4;
  segment.ends = {{1.0, 2.0}, {-1.0, 2.0}};
  segment.start_sigma = 0.1;
  segment.start_kind = geometry::EndKind::kCorner;
  segment.end_kind = geometry::EndKind::kOccluded;
  segment.beams = 33;
  return segment;
}

std_msgs::Header header() {
  std_msgs::Header result;
  result.frame_id = "laser";
  result.stamp = ros::Time(3, 4);
  return result;
}

TEST(LineMarkers, DrawArcsWithTheirBands) {
  geometry::Arc arc;
  arc.centre = {1.0, 2.0};
  arc.radius = 0.5;
  arc.covariance = 1e-4 * Eigen::Matrix3d::Identity();
  arc.start_angle = 3.0;
  arc.end_angle = 4.0;
  const MarkerArray array = LineMarkers().draw({}, {arc}, header());
  Screen screen;
  screen.show(array);
  ASSERT_GT(screen.points("arcs"), 0U);
  for (const auto& point : array.markers[3].points) {
    EXPECT_NEAR(std::hypot(point.x - 1.0, point.y - 2.0), 0.5, 1e-12);
  }
  EXPECT_GT(screen.points("bands"), 0U);
  EXPECT_EQ(screen.points("segments"), 0U);
}

TEST(LineMarkers, DrawWallsWithTheirEndsAndBands) {
  Screen screen;
  screen.show(LineMarkers().draw({wall(), wall()}, {}, header()));
  EXPECT_EQ(screen.points("segments"), 4U);
  EXPECT_EQ(screen.points("ends"), 8U);
  EXPECT_EQ(screen.points("bands") % 3, 0U);
  EXPECT_GT(screen.points("bands"), 0U);
  for (const auto& [key, marker] : screen.shown) {
    EXPECT_EQ(marker.header, header());
    EXPECT_DOUBLE_EQ(marker.pose.orientation.w, 1.0);
    EXPECT_GT(marker.scale.x, 0.0);
    if (marker.colors.empty()) continue;
    EXPECT_EQ(marker.colors.size(), marker.points.size());
  }
}

TEST(LineMarkers, ColourTellsTheKindOfAnEnd) {
  auto segment = wall();
  segment.start_kind = segment.end_kind;
  const auto alike = LineMarkers().draw({segment}, {}, header()).markers[0];
  EXPECT_EQ(alike.colors[0], alike.colors[1]);
  std::vector<std_msgs::ColorRGBA> seen;
  for (int kind = 0; kind <= 4; ++kind) {
    segment.start_kind = static_cast<geometry::EndKind>(kind);
    const auto colour = LineMarkers().draw({segment}, {}, header()).markers[0].colors[0];
    EXPECT_THAT(seen, testing::Not(testing::Contains(colour)));
    seen.push_back(colour);
  }
}

TEST(LineMarkers, BandHoldsTheLineWith95Percent) {
  Screen screen;
  screen.show(LineMarkers().draw({wall()}, {}, header()));
  // At x = ±1 the standard deviation of the distance is sqrt(1e-4 + 1² · 4e-4).
  double highest = 0.0;
  for (const auto& point : screen.shown.at({"bands", 0}).points) {
    EXPECT_LE(std::abs(point.x), 1.0 + 1e-9);
    highest = std::max(highest, point.y - 2.0);
  }
  EXPECT_NEAR(highest, 1.96 * std::sqrt(5e-4), 1e-4);
}

TEST(LineMarkers, BarsAreAsLongAsTheEndsAreUncertain) {
  const Marker bars = LineMarkers().draw({wall()}, {}, header()).markers[1];
  EXPECT_EQ(bars.ns, "ends");
  EXPECT_NEAR(std::abs(bars.points[0].x - bars.points[1].x), 2.0 * 1.96 * 0.1, 1e-3);
  EXPECT_NEAR(std::abs(bars.points[2].x - bars.points[3].x), 0.0, 1e-9);
}

TEST(LineMarkers, NothingIsLeftOver) {
  LineMarkersConfig config;
  config.labels = true;
  LineMarkers markers(config);
  Screen screen;
  screen.show(markers.draw({wall(), wall(), wall()}, {}, header()));
  EXPECT_EQ(screen.shown.size(), 6U);
  screen.show(markers.draw({wall()}, {}, header()));
  EXPECT_EQ(screen.shown.size(), 4U);
  EXPECT_EQ(screen.points("segments"), 2U);
  screen.show(markers.draw({}, {}, header()));
  EXPECT_TRUE(screen.shown.empty());
}

TEST(LineMarkers, LabelsComeWhenAskedFor) {
  Screen screen;
  screen.show(LineMarkers().draw({wall()}, {}, header()));
  EXPECT_EQ(screen.shown.count({"labels", 0}), 0U);
  LineMarkersConfig config;
  config.labels = true;
  screen.show(LineMarkers(config).draw({wall()}, {}, header()));
  EXPECT_THAT(screen.shown.at({"labels", 0}).text, testing::HasSubstr("2.00 m, 33 beams"));
}

}  // namespace
}  // namespace sightline::bridge
