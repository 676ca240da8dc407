#include <fstream>
#include <sstream>

#include <gmock/gmock.h>

#include "carmen_room.h"
#include "temporary_folder.h"
#include "tools/program.h"

namespace sightline {
namespace {

using test::runProgram;
using testing::HasSubstr;

class DrawRoomsTest : public testing::Test {
 protected:
  std::string picture() const {
    std::ostringstream content;
    content << std::ifstream(folder_.path("a.png"), std::ios::binary).rdbuf();
    return content.str();
  }
  test::ProgramResult draw(const std::string& more = "") const {
    return runProgram("draw_rooms", rooms_ + " " + folder_.path("a.png") + " " + more);
  }

  test::TemporaryFolder folder_;
  const std::string rooms_ = folder_.write("rooms.yaml", test::kRoomMap);
};

TEST_F(DrawRoomsTest, DrawsThemAlone) {
  const auto result = draw();
  EXPECT_EQ(result.status, 0) << result.output;
  EXPECT_THAT(result.output, HasSubstr("1 rooms, 0 doors"));
  EXPECT_THAT(picture(), HasSubstr("PNG"));
}

TEST_F(DrawRoomsTest, DrawsThemOverAGrid) {
  ASSERT_EQ(runProgram("rooms_to_map", rooms_ + " " + folder_.path("map.yaml")).status, 0);
  ASSERT_EQ(draw().status, 0);
  const std::string alone = picture();
  EXPECT_EQ(draw("--grid " + folder_.path("map.yaml")).status, 0);
  EXPECT_NE(picture(), alone);
}

TEST_F(DrawRoomsTest, DrawsThemOverARecording) {
  const std::string log = folder_.write("a.clf", test::carmenRoomLog(60));
  ASSERT_EQ(runProgram("carmen_to_bag", log + " " + folder_.path("a.bag")).status, 0);
  const std::string config =
      folder_.write("a.yaml", "rooms:\n  map: rooms.yaml\n  initial_pose: [-1.5, -1.0, 0.2]\n");
  const auto result = draw(folder_.path("a.bag") + " --config " + config);
  EXPECT_EQ(result.status, 0) << result.output;
  EXPECT_THAT(result.output, HasSubstr("60 scans placed"));
}

TEST_F(DrawRoomsTest, NamesWhatItCannotRead) {
  EXPECT_THAT(draw("--grid nowhere.yaml").output, HasSubstr("nowhere.yaml"));
  EXPECT_THAT(draw("nowhere.bag").output, HasSubstr("nowhere.bag"));
  EXPECT_THAT(runProgram("draw_rooms", rooms_ + " /nowhere/a.png").output,
              HasSubstr("/nowhere/a.png: cannot be written"));
}

}  // namespace
}  // namespace sightline
