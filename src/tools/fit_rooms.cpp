// Fits rooms to a recording.
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "program/program.h"
#include "sightline/bridge/bag_feed.h"
#include "sightline/mapping/room_fitter.h"
#include "sightline/mapping/rooms_picture.h"

namespace {

using namespace sightline;

struct Fit {
  std::vector<std::string> in;
  std::string out;
  std::optional<std::string> config;
};

int fit(const Fit& job) {
  auto config =
      job.config ? pipeline::EstimatorsConfig::readFile(*job.config) : pipeline::EstimatorsConfig();
  bridge::BagFeed feed(job.in, config, {});
  mapping::Survey survey(config);
  bridge::BagFeed::Visitor visitor;
  visitor.scan = [&](pipeline::LocatedScan located, const ros::Time&) {
    survey.take(std::move(located));
  };
  visitor.message = [](const rosbag::MessageInstance&) {};
  visitor.progress = [](double) {};
  feed.read(visitor);
  const auto fitted = mapping::fitRooms(survey, {});
  std::ofstream(job.out) << mapping::roomsText(fitted);
  mapping::drawPicture(survey, fitted,
                       std::filesystem::path(job.out).replace_extension(".png").string());
  std::printf("%zu rooms, %zu doors, %zu crossings without; inside %.3f; scale %.4f\n",
              fitted.rooms.size(), fitted.doors.size(), fitted.missing_doors.size(), fitted.inside,
              fitted.path.wheel_scale);
  world::RoomMap::readFile(job.out);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Fit job;
  tools::Program program("fit_rooms", "Fits rooms to a recording.");
  program.positionals("IN.bag", job.in, "the bags to read, as one");
  program.requiredOption("--out", job.out, "rooms.yaml", "rooms file to write");
  program.option("--config", job.config, "FILE.yaml", "settings");
  return program.run(argc, argv, [&] { return fit(job); });
}
