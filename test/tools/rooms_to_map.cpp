#include <fstream>

#include <gmock/gmock.h>

#include "sightline/config/node.h"
#include "temporary_folder.h"
#include "tools/program.h"

namespace sightline {
namespace {

using test::runProgram;
using testing::HasSubstr;

TEST(RoomsToMap, WritesWhatMapServerReads) {
  const test::TemporaryFolder folder;
  const std::string rooms = folder.write("rooms.yaml", "rooms:\n  hall: {size: [2.0, 1.0]}\n");
  const auto result =
      runProgram("rooms_to_map", rooms + " " + folder.path("map.yaml") + " --resolution 0.1");
  ASSERT_EQ(result.status, 0) << result.output;
  const auto map = config::Node::readFile(folder.path("map.yaml"));
  EXPECT_EQ(map.at("image").text(), "map.pgm");
  const auto origin = map.at("origin").numbers(3);
  std::ifstream file(folder.path("map.pgm"), std::ios::binary);
  std::string kind;
  int width = 0;
  int height = 0;
  int white = 0;
  file >> kind >> width >> height >> white;
  file.get();
  EXPECT_EQ(kind, "P5");
  std::string cells(static_cast<std::size_t>(width * height), '\0');
  ASSERT_TRUE(file.read(cells.data(), width * height));
  const auto grey = [&](double x, double y) {
    const int column = static_cast<int>((x - origin[0]) / 0.1);
    const int row = height - 1 - static_cast<int>((y - origin[1]) / 0.1);
    return static_cast<unsigned char>(cells[static_cast<std::size_t>(row * width + column)]);
  };
  EXPECT_EQ(grey(0.5, 0.2), 254);
  EXPECT_EQ(grey(0.5, 1.2), 205);
  EXPECT_THAT(cells, HasSubstr(std::string(10, '\0')));  // a wall
}

TEST(RoomsToMap, RefusesWhatIsNoRoomsFile) {
  const test::TemporaryFolder folder;
  const std::string rooms = folder.write("rooms.yaml", "image: map.pgm\n");
  const auto result = runProgram("rooms_to_map", rooms + " " + folder.path("map.yaml"));
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.output, HasSubstr("rooms.yaml"));
}

}  // namespace
}  // namespace sightline
