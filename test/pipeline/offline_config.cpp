#include "sightline/pipeline/offline_config.h"

#include <gmock/gmock.h>

#include "config_error.h"
#include "temporary_folder.h"

namespace sightline::pipeline {
namespace {

using test::errorOf;
using test::TemporaryFolder;
using testing::ElementsAre;
using testing::HasSubstr;

class OfflineConfigTest : public testing::Test {
 protected:
  OfflineConfig read(const std::string& text) {
    return OfflineConfig::readFile(folder_.write("a.yaml", text));
  }
  std::string fault(const std::string& text) {
    const std::string what = errorOf([&] { read(text); }).what();
    return what.substr(what.find("a.yaml"));
  }

  TemporaryFolder folder_;
};

TEST_F(OfflineConfigTest, ReadsEveryGroup) {
  const OfflineConfig config = read(
      "scans: [front, rear]\nframes: {odom: wheels}\nnoise: {sigma: 0.03}\n"
      "lines: {min_beams: 7}\n"
      "rooms: {map: ../rooms/a.yaml, initial_pose: [1, 2, 0.5], tracker: {neighbours: false}}\n");
  EXPECT_THAT(config.scans, ElementsAre("front", "rear"));
  EXPECT_EQ(config.frames.odom, "wheels");
  EXPECT_EQ(config.frames.map, "map");
  EXPECT_EQ(config.noise.sigma, 0.03);
  EXPECT_EQ(config.lines.min_beams, 7);
  ASSERT_TRUE(config.rooms.has_value());
  EXPECT_THAT(config.rooms->initial_pose, ElementsAre(1.0, 2.0, 0.5));
  EXPECT_FALSE(config.rooms->tracker.neighbours);
}

TEST_F(OfflineConfigTest, TakesTheRoomsRelativeToItself) {
  const OfflineConfig config = read("rooms: {map: b.yaml, initial_pose: [0, 0, 0]}\n");
  EXPECT_EQ(config.rooms->map, folder_.path("b.yaml"));
}

TEST_F(OfflineConfigTest, NeedsNoRooms) {
  const OfflineConfig config = read("scans: [scan]\n");
  EXPECT_FALSE(config.rooms.has_value());
}

TEST_F(OfflineConfigTest, SaysWhatIsWrongAndWhere) {
  EXPECT_THAT(fault("scan: [scan]\n"), HasSubstr("a.yaml:1: scan: unknown key"));
  EXPECT_THAT(fault("scans: []\n"), HasSubstr("a.yaml:1: scans: no topics"));
  EXPECT_THAT(fault("noise: 3\n"), HasSubstr("a.yaml:1: noise: expected a map"));
  EXPECT_THAT(fault("rooms: {initial_pose: [0, 0, 0]}\n"), HasSubstr("missing key 'map'"));
  EXPECT_THAT(fault("rooms: {map: a}\n"), HasSubstr("missing key 'initial_pose'"));
  EXPECT_THAT(fault("rooms:\n  map: a\n  initial_pose: [0, 0]\n"),
              HasSubstr("a.yaml:3: rooms.initial_pose: expected 3 numbers, found 2"));
  EXPECT_THAT(fault("rooms: {map: a, initial_pose: [0, 0, .nan]}\n"), HasSubstr("initial_pose"));
  EXPECT_THAT(fault("rooms: {map: a, initial_pose: [0, 0, 0], initial_sigma: [-1, 0]}\n"),
              HasSubstr("initial_sigma"));
  EXPECT_THAT(fault("frames: {mapp: a}\n"), HasSubstr("frames.mapp: unknown key"));
}

TEST(ShippedOfflineConfigs, AreRead) {
  const auto config = OfflineConfig::readFile(SIGHTLINE_SOURCE_DIR "/config/offline/fr079.yaml");
  ASSERT_TRUE(config.rooms.has_value());
  EXPECT_THAT(config.rooms->map, HasSubstr("config/rooms/fr079.yaml"));
}

TEST_F(OfflineConfigTest, OdometryIsWantedWhereACarrierOrASettingSaysSo) {
  EXPECT_FALSE(read("scans: [scan]\n").odometry);
  folder_.write("person.yaml", "odometry: {leans: true, floor: {height: 1.1}}\n");
  const auto config = read("carrier: person.yaml\nodometry: {floor: {height: 1.3}}\n");
  ASSERT_TRUE(config.odometry.has_value());
  EXPECT_TRUE(config.odometry->leans);
  EXPECT_EQ(config.odometry->floor.height, 1.3) << "what stands here goes before the carrier's";
  EXPECT_TRUE(read("odometry: {}\n").odometry.has_value());
  EXPECT_THAT(fault("odometry: {leans: perhaps}\n"), HasSubstr("odometry"));
}

}  // namespace
}  // namespace sightline::pipeline
