// Writes rooms as a map of map_server, for planners and for amcl.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

#include <fmt/format.h>

#include "program/program.h"
#include "sightline/config/error.h"
#include "sightline/world/occupancy.h"

namespace {

using namespace sightline;
using world::Occupancy;

struct Job {
  std::string rooms;
  std::string out;
  double resolution = 0.05;  // [m]
};

// Grey as map_server reads it with the thresholds written below.
char greyOf(std::int8_t cell) {
  if (cell == Occupancy::kFree) return static_cast<char>(254);
  return cell == Occupancy::kOccupied ? static_cast<char>(0) : static_cast<char>(205);
}

// The first row of an image is the uppermost, that of a grid the lowest.
std::string imageOf(const Occupancy& grid) {
  std::string image = fmt::format("P5\n{} {}\n255\n", grid.width, grid.height);
  for (std::size_t row = grid.height; row-- > 0;) {
    for (std::size_t x = 0; x < grid.width; ++x) image += greyOf(grid.cells[row * grid.width + x]);
  }
  return image;
}

void write(const std::string& path, const std::string& content) {
  std::ofstream file(path, std::ios::binary);
  if (!(file << content).flush()) throw config::Error(path, 0, "", "cannot be written");
}

int convert(const Job& job) {
  if (!(job.resolution >= 0.005 && job.resolution <= 1.0)) {
    throw tools::UsageError("--resolution: from 0.005 to 1 m");
  }
  const Occupancy grid = world::drawRooms(world::RoomMap::readFile(job.rooms), job.resolution);
  const auto image = std::filesystem::path(job.out).replace_extension(".pgm");
  write(image.string(), imageOf(grid));
  write(job.out,
        fmt::format("image: {}\nresolution: {}\norigin: [{}, {}, 0.0]\nnegate: 0\n"
                    "occupied_thresh: 0.65\nfree_thresh: 0.196\n",
                    image.filename().string(), job.resolution, grid.origin.x(), grid.origin.y()));
  std::printf("%zu x %zu cells of %g m\n", grid.width, grid.height, job.resolution);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Job job;
  tools::Program program("rooms_to_map", "Writes rooms as the map of a map_server.");
  program.positional("ROOMS.yaml", job.rooms, "rooms file");
  program.positional("MAP.yaml", job.out, "map to write; beside it its image, MAP.pgm");
  program.option("--resolution", job.resolution, "METRES", "edge of a cell");
  return program.run(argc, argv, [&] { return convert(job); });
}
