#include "setting_limits.h"

#include <gmock/gmock.h>

namespace sightline::config {
namespace {

struct LimitedPart {
  int count = 1;

  void visit(FieldVisitor& visitor) { visitor.integer("count", count, {"1", {0, 9}, "how many"}); }
};

struct LimitedWhole {
  double length = 1.0;
  bool is_new = true;
  std::size_t colour = 1;
  std::string name = "whole";
  std::vector<double> places;
  std::array<double, 2> sigmas{0.3, 0.1};
  LimitedPart part;
  std::optional<LimitedPart> spare;
  std::optional<LimitedPart> second = LimitedPart();
  std::optional<geometry::Pose2> pose;

  void visit(FieldVisitor& visitor) {
    visitor.number("length", length, {"m", {0.5, 2.0}, "from end to end"});
    visitor.flag("is_new", is_new, "or old");
    visitor.option("colour", colour, {"red", "green", "blue"}, "of it");
    visitor.text("name", name, "what it is called");
    visitor.numbers("places", places, {"m", {-1.0, 1.0}, "where it is"});
    visitor.numbers("sigmas", sigmas, {"m", {0.0, 8.0}, "of its place"});
    visitor.group("part", part);
    visitor.group("spare", spare);
    visitor.group("second", second);
    visitor.pose("pose", pose, "where it is");
  }
};

TEST(AtBothEnds, IsEachEndOfEachSetting) {
  std::vector<std::string> names;
  for (const auto& limit : test::atBothEnds(LimitedWhole())) names.push_back(limit.name);
  EXPECT_THAT(names,
              testing::ElementsAre("length = 0.5", "length = 2", "is_new = 0", "is_new = 1",
                                   "colour = 0", "colour = 1", "colour = 2", "sigmas = 0",
                                   "sigmas = 8", "sigmas = 0", "sigmas = 8", "part.count = 0",
                                   "part.count = 9", "second.count = 0", "second.count = 9"));
}

TEST(AtBothEnds, ChangesNothingElse) {
  const auto limits = test::atBothEnds(LimitedWhole());
  EXPECT_EQ(limits[1].config.length, 2.0);
  EXPECT_EQ(limits[1].config.sigmas, LimitedWhole().sigmas);
  EXPECT_EQ(limits[9].config.length, 1.0);
  EXPECT_EQ(limits[9].config.sigmas[0], 0.3);
  EXPECT_EQ(limits[9].config.sigmas[1], 0.0);
  EXPECT_FALSE(limits[2].config.is_new);
  EXPECT_EQ(limits[4].config.colour, 0u);
  EXPECT_EQ(limits[12].config.part.count, 9);
  EXPECT_EQ(limits[14].config.second->count, 9);
}

TEST(AtBothEnds, TakesTheCoordinatesOfPosesAndTheNumbersOfLists) {
  LimitedWhole whole;
  whole.places = {0.25};
  whole.pose.emplace();
  const auto limits = test::atBothEnds(whole);
  ASSERT_EQ(limits.size(), 15u + 2u + 6u);
  EXPECT_EQ(limits[7].config.places.at(0), -1.0);
  EXPECT_EQ(limits[17].config.pose->x(), kCoordinate.min);
  EXPECT_EQ(limits[20].config.pose->y(), kCoordinate.max);
}

}  // namespace
}  // namespace sightline::config
