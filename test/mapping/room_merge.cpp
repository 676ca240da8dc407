#include "sightline/mapping/room_merge.h"

#include <gmock/gmock.h>

#include "config_error.h"
#include "sightline/world/room_map_file.h"

namespace sightline::mapping {
namespace {

using geometry::Pose2;
using testing::HasSubstr;

world::RoomMap mapOf(const std::string& text) {
  return world::RoomMap(config::Node::parse(text, "rooms"));
}

RoomLayout layoutOf(const world::RoomMap& map) {
  RoomLayout layout;
  for (const world::Room& room : map.rooms()) layout.rooms.push_back(outlineOf(room));
  for (const world::Door& door : map.doors()) layout.doors.push_back(door.centre_map);
  return layout;
}

// As a recording in a frame of its own shows them.
FittedRooms fittedFrom(const world::RoomMap& map, const Pose2& T_found_map) {
  FittedRooms fitted;
  for (const RoomOutline& room : layoutOf(map).rooms) fitted.rooms.push_back(T_found_map * room);
  int number = 0;
  for (RoomOutline& room : fitted.rooms) room.name = "room_" + std::to_string(++number);
  return fitted;
}

const char* const kKept = R"(
rooms:
  kitchen: {size: [4.0, 3.0], pose: [0.0, 0.0, 0.0], walls: {north: {open: true}}}
  study: {size: [3.0, 3.0], pose: [3.62, 0.0, 0.0]}
doors:
  - {between: [kitchen, study], at: [2.06, 0.2], width: 0.9}
)";
const char* const kDriven = R"(
rooms:
  a: {size: [4.0, 3.0], pose: [0.01, 0.0, 0.0], walls: {north: {open: true}}}
  b: {size: [3.0, 3.0], pose: [3.62, 0.01, 0.0]}
  c: {size: [5.0, 2.0], pose: [0.5, 2.62, 0.0]}
doors:
  - {between: [a, b], at: [2.06, 0.2], width: 0.9}
)";
const Pose2 kFoundMap(3.0, -2.0, 2.1);

TEST(AlignRooms, FindsWhereTheyLie) {
  const auto alignment =
      alignRooms({fittedFrom(mapOf(kDriven), kFoundMap).rooms, {}}, layoutOf(mapOf(kKept)));
  ASSERT_TRUE(alignment);
  EXPECT_TRUE(alignment->isSure());
  const Pose2 off = alignment->T_known_found * kFoundMap;
  EXPECT_LT(off.translation().norm(), 0.02);
  EXPECT_LT(std::abs(off.theta()), 0.005);
  EXPECT_GT(alignment->agreeing, 20.0);
}

TEST(AlignRooms, ARoomThatIsAlikeEitherWayIsNotSure) {
  const auto rooms = layoutOf(mapOf("rooms:\n  hall: {size: [4.0, 3.0]}\n"));
  const auto alignment = alignRooms(rooms, rooms);
  ASSERT_TRUE(alignment);
  EXPECT_FALSE(alignment->isSure());
}

TEST(AlignRooms, OtherRoomsAreNotSure) {
  const auto alignment =
      alignRooms(layoutOf(mapOf("rooms:\n  hall: {size: [9.0, 7.0]}\n")), layoutOf(mapOf(kKept)));
  ASSERT_TRUE(alignment);
  EXPECT_FALSE(alignment->isSure());
}

TEST(MergeRooms, KeepWhatIsThereAndAddWhatIsNot) {
  const world::RoomMap kept = mapOf(kKept);
  const MergedRooms merged =
      mergeRooms(kept, "kept.yaml", {}, fittedFrom(mapOf(kDriven), kFoundMap));
  ASSERT_EQ(merged.map.rooms().size(), 3U);
  const world::RoomMap read(config::Node::parse(mergedText(merged), "merged"));
  for (std::size_t r = 0; r < 2; ++r) {
    EXPECT_EQ(read.rooms()[r].name, kept.rooms()[r].name);
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_EQ(read.rooms()[r].walls[i].segment.start, kept.rooms()[r].walls[i].segment.start);
      EXPECT_EQ(read.rooms()[r].walls[i].spans.size(), kept.rooms()[r].walls[i].spans.size());
    }
  }
  EXPECT_EQ(read.rooms()[2].name, "room_1");
  EXPECT_LT((read.rooms()[2].T_map_room.translation() - Eigen::Vector2d(0.5, 2.62)).norm(), 0.03);
  EXPECT_EQ(read.doors().size(), 1U);
}

TEST(MergeRooms, KeepsTheNamesOfOthers) {
  std::string text = kKept;
  text.replace(text.find("  study:"), 7, "  room_1");
  text.replace(text.find("study"), 5, "room_1");
  const world::RoomMap kept = mapOf(text);
  const MergedRooms merged =
      mergeRooms(kept, "kept.yaml", {}, fittedFrom(mapOf(kDriven), kFoundMap));
  EXPECT_EQ(merged.map.rooms()[2].name, "room_2");
}

TEST(MergeRooms, OnlyThePartThatIsNewComesIn) {
  const world::RoomMap kept = mapOf(kKept);
  const world::RoomMap longer = mapOf(R"(
rooms:
  a: {size: [4.0, 3.0]}
  b: {size: [7.0, 3.0], pose: [5.62, 0.0, 0.0]}
doors:
  - {between: [a, b], at: [2.06, 0.2], width: 0.9}
)");
  const MergedRooms merged = mergeRooms(kept, "kept.yaml", {}, fittedFrom(longer, kFoundMap));
  ASSERT_EQ(merged.map.rooms().size(), 3U);
  const world::Room& added = merged.map.rooms()[2];
  EXPECT_NEAR(added.walls[0].segment.length(), 3.88, 0.05);
  EXPECT_FALSE(added.contains({5.0, 0.0}));
  EXPECT_TRUE(added.contains({5.4, 0.0}));
}

TEST(MergeRooms, WhatDoesNotFitIsNamed) {
  const auto fault = test::errorOf([] {
    mergeRooms(mapOf(kKept), "kept.yaml", {},
               fittedFrom(mapOf("rooms:\n  hall: {size: [9.0, 7.0]}\n"), kFoundMap));
  });
  EXPECT_THAT(fault.what(), HasSubstr("kept.yaml: rooms: the recording does not fit"));
}

}  // namespace
}  // namespace sightline::mapping
