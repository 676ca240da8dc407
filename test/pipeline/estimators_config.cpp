#include "sightline/pipeline/estimators_config.h"

#include <gmock/gmock.h>

#include "config_error.h"
#include "temporary_folder.h"

namespace sightline::pipeline {
namespace {

using test::errorOf;
using test::TemporaryFolder;
using testing::ElementsAre;
using testing::HasSubstr;

class EstimatorsConfigTest : public testing::Test {
 protected:
  EstimatorsConfig read(const std::string& text) {
    return EstimatorsConfig::readFile(folder_.write("a.yaml", text));
  }
  std::string fault(const std::string& text) {
    const std::string what = errorOf([&] { read(text); }).what();
    return what.substr(what.find("a.yaml"));
  }

  TemporaryFolder folder_;
};

TEST_F(EstimatorsConfigTest, ReadsEveryGroup) {
  const EstimatorsConfig config = read(
      "scans: [front, rear]\nframes: {odom: wheels}\nnoise: {sigma: 0.03}\n"
      "lines: {min_beams: 7}\n"
      "rooms: {map: ../rooms/a.yaml, initial_pose: [1, 2, 0.5], tracker: {neighbours: false}}\n");
  EXPECT_THAT(config.input.scans, ElementsAre("front", "rear"));
  EXPECT_EQ(config.frames.odom, "wheels");
  EXPECT_EQ(config.frames.map, "map");
  EXPECT_EQ(config.input.feed.noise.sigma, 0.03);
  EXPECT_EQ(config.lines.extractor.min_beams, 7);
  ASSERT_TRUE(config.rooms.has_value());
  EXPECT_EQ(config.rooms->initial_pose->coordinates(), Eigen::Vector3d(1.0, 2.0, 0.5));
  EXPECT_FALSE(config.rooms->tracker.neighbours);
}

TEST_F(EstimatorsConfigTest, TakesTheRoomsRelativeToItself) {
  const EstimatorsConfig config = read("rooms: {map: b.yaml, initial_pose: [0, 0, 0]}\n");
  EXPECT_EQ(config.rooms->map, folder_.path("b.yaml"));
}

TEST_F(EstimatorsConfigTest, NeedsNoRooms) {
  const EstimatorsConfig config = read("scans: [scan]\n");
  EXPECT_FALSE(config.rooms.has_value());
}

TEST_F(EstimatorsConfigTest, SaysWhatIsWrongAndWhere) {
  EXPECT_THAT(fault("scan: [scan]\n"), HasSubstr("a.yaml:1: scan: unknown key"));
  EXPECT_THAT(fault("noise: 3\n"), HasSubstr("a.yaml:1: noise: expected a map"));
  EXPECT_THAT(fault("rooms: {initial_pose: [0, 0, 0]}\n"), HasSubstr("missing key 'map'"));
  EXPECT_THAT(fault("rooms:\n  map: a\n  initial_pose: [0, 0]\n"),
              HasSubstr("a.yaml:3: rooms.initial_pose: expected a pose: [x, y, yaw]"));
  EXPECT_THAT(fault("rooms: {map: a, initial_pose: [0, 0, .nan]}\n"), HasSubstr("initial_pose"));
  EXPECT_THAT(fault("rooms: {map: a, initial_pose: [0, 0, 0], initial_sigma: [-1, 0]}\n"),
              HasSubstr("initial_sigma"));
  EXPECT_THAT(fault("frames: {mapp: a}\n"), HasSubstr("frames.mapp: unknown key"));
}

TEST(ShippedEstimatorsConfigs, AreRead) {
  const auto config = EstimatorsConfig::readFile(SIGHTLINE_SOURCE_DIR "/config/offline/fr079.yaml");
  ASSERT_TRUE(config.rooms.has_value());
  EXPECT_THAT(config.rooms->map, HasSubstr("config/rooms/fr079.yaml"));
}

TEST_F(EstimatorsConfigTest, OdometryIsWantedWhereACarrierOrASettingSaysSo) {
  EXPECT_FALSE(read("scans: [scan]\n").odometry);
  folder_.write("person.yaml",
                "leans: true\nfloor: {height: 1.1, headroom: 1.4}\nodometry: {max_gap: 3.0}\n");
  const auto config = read("carrier: person.yaml\nfloor: {height: 1.3}\n");
  ASSERT_TRUE(config.odometry.has_value());
  EXPECT_TRUE(config.input.leans);
  EXPECT_EQ(config.input.floor.height, 1.3) << "what stands here goes before the carrier's";
  EXPECT_EQ(config.input.floor.headroom, 1.4);
  EXPECT_EQ(config.odometry->matching.max_gap, 3.0);
  EXPECT_TRUE(read("odometry: {}\n").odometry.has_value());
  EXPECT_THAT(fault("leans: perhaps\n"), HasSubstr("leans"));
}

}  // namespace
}  // namespace sightline::pipeline
