// Fits rooms to a recording.
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "program/program.h"
#include "program/progress_bar.h"
#include "sightline/bridge/bag_feed.h"
#include "sightline/mapping/recording_faults.h"
#include "sightline/mapping/replay.h"
#include "sightline/mapping/room_fitter.h"
#include "sightline/mapping/rooms_picture.h"

namespace {

using namespace sightline;

struct Job {
  std::vector<std::string> in;
  std::string out;
  std::optional<std::string> config;
};

constexpr int kLosesItself = 3;  // exit status of rooms that lose their own recording

// Part of the bar of a step of the work.
mapping::Progress part(tools::ProgressBar& bar, double from, double to) {
  return [&bar, from, to](double share) { bar.show(from + (to - from) * share); };
}

template <class Taker>
void read(const Job& job, const pipeline::EstimatorsConfig& config, Taker& taker,
          const mapping::Progress& progress) {
  bridge::BagFeed feed(job.in, config, {});
  bridge::BagFeed::Visitor visitor;
  visitor.scan = [&](pipeline::LocatedScan located, const ros::Time&) {
    taker.take(std::move(located));
  };
  visitor.message = [](const rosbag::MessageInstance&) {};
  visitor.progress = progress;
  feed.read(visitor);
  if (!feed.damage().empty()) std::fprintf(stderr, "%s\n", feed.damage().c_str());
}

[[noreturn]] void refuse(const Job& job, const std::string& reason) {
  throw config::Error(job.in.front(), 0, "", reason);
}

void write(const std::string& path, const std::string& text) {
  std::ofstream file(path);
  if (!(file << text).flush()) throw config::Error(path, 0, "", "cannot be written");
}

std::vector<geometry::StampedPose2> odometryOf(const mapping::Survey& survey) {
  std::vector<geometry::StampedPose2> odometry;
  for (const mapping::PathPoint& point : survey.path()) {
    odometry.push_back({point.stamp, point.T_odom_base});
  }
  return odometry;
}

void printRooms(const mapping::Survey& survey, const mapping::FittedRooms& fitted) {
  std::printf("path: %zu scans, %.1f m, %zu loops closed, %zu refused\n", survey.path().size(),
              survey.keys().back().way, fitted.path.loops, fitted.path.refused);
  if (survey.withWheels() > 0) {
    std::printf("wheels: %.4f m of way for a metre that they tell\n", fitted.path.wheel_scale);
  }
  std::printf("rooms: %zu, with %zu doors; %.1f %% of the path lies in them\n", fitted.rooms.size(),
              fitted.doors.size(), 100.0 * fitted.inside);
  for (const mapping::Crossing& crossing : fitted.missing_doors) {
    std::printf("warning: missing_door: from %s to %s at [%.2f, %.2f]\n",
                fitted.rooms[crossing.rooms[0]].name.c_str(),
                fitted.rooms[crossing.rooms[1]].name.c_str(), crossing.left_map.x(),
                crossing.left_map.y());
  }
  if (survey.bridged() > 0) {
    std::printf("warning: bridged: %zu scans matched nothing, their poses are by odometry\n",
                survey.bridged());
  }
}

void printWalls(mapping::Replay& replay) {
  constexpr double kDoubtful = 0.02;  // mean residual of a wall [m]
  constexpr std::size_t kOften = 30;  // uses that tell something
  for (const auto& [at, use] : replay.walls()) {
    const world::Room& room = replay.map().rooms()[at.first];
    const bool is_off = use.used >= kOften && std::abs(use.meanResidual()) > kDoubtful;
    const bool is_refused = use.refused >= kOften && use.refused > use.used;
    if (!is_off && !is_refused) continue;
    std::printf(
        "warning: doubtful_wall: %s of %s, %+.0f mm off on average, used %zu times, "
        "refused %zu times\n",
        room.walls[at.second].name.c_str(), room.name.c_str(), 1e3 * use.meanResidual(), use.used,
        use.refused);
  }
}

int judge(mapping::Replay& replay) {
  std::printf(
      "replay: %.1f %% of %zu scans within 0.5 m and 10 deg of the path, %.3f m on average, "
      "%.2f m at most\n",
      100.0 * replay.rightShare(), replay.scans(), replay.meanDifference(), replay.maxDifference());
  for (const mapping::LostPlace& place : replay.lostPlaces()) {
    std::printf("warning: lost_place: for %.1f s from %.1f s on, at [%.2f, %.2f]\n", place.seconds,
                place.begin, place.position_map.x(), place.position_map.y());
  }
  printWalls(replay);
  std::printf(replay.isGood() ? "the rooms keep their own recording\n"
                              : "NOT GOOD: the rooms lose their own recording\n");
  return replay.isGood() ? 0 : kLosesItself;
}

int fit(const Job& job) {
  auto config =
      job.config ? pipeline::EstimatorsConfig::readFile(*job.config) : pipeline::EstimatorsConfig();
  tools::ProgressBar bar;
  mapping::Survey survey(config);
  read(job, config, survey, part(bar, 0.0, 0.4));
  const mapping::FittedRooms fitted = mapping::fitRooms(survey, part(bar, 0.4, 0.8));
  const std::string fault = mapping::faultOf(survey, fitted.path);
  if (!fault.empty()) refuse(job, fault);
  if (fitted.rooms.empty()) refuse(job, "no rooms: no walls were seen about the path");
  write(job.out, mapping::roomsText(fitted));
  const auto picture = std::filesystem::path(job.out).replace_extension(".png").string();
  mapping::drawPicture(survey, fitted, picture);
  if (!config.rooms) config.rooms.emplace();
  config.rooms->map = job.out;
  mapping::Replay replay(config, fitted.poses, odometryOf(survey));
  read(job, config, replay, part(bar, 0.8, 1.0));
  replay.finish();
  bar.show(1.0);
  printRooms(survey, fitted);
  const auto& start = fitted.poses.front().pose;
  std::printf("initial_pose: [%.4f, %.4f, %.4f]\n", start.x(), start.y(), start.theta());
  return judge(replay);
}

}  // namespace

int main(int argc, char** argv) {
  Job job;
  tools::Program program("fit_rooms",
                         "Fits rooms to a recording, draws them over its scans, and tracks the "
                         "recording in them. Exit status 3 where they lose it.");
  program.positionals("IN.bag", job.in, "the bags to read, as one");
  program.requiredOption("--out", job.out, "rooms.yaml",
                         "rooms file to write; beside it a picture, rooms.png");
  program.option("--config", job.config, "FILE.yaml",
                 "settings as of offline: scans, frames, noise, rooms.tracker");
  return program.run(argc, argv, [&] { return fit(job); });
}
