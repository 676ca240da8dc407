// Fits rooms to a recording or to a grid.
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "program/program.h"
#include "program/progress_bar.h"
#include "program/read_bags.h"
#include "sightline/mapping/drawing.h"
#include "sightline/mapping/recording_faults.h"
#include "sightline/mapping/replay.h"
#include "sightline/mapping/room_fitter.h"
#include "sightline/mapping/room_merge.h"
#include "sightline/mapping/wheel_fit.h"

namespace {

using namespace sightline;

struct Job {
  std::vector<std::string> in;
  std::string out;
  std::optional<std::string> config;
  std::optional<std::string> grid;
  std::optional<std::string> keep;
  double surface = mapping::kMiddleOfCell;
};

// Rooms, what they were fitted to, and their file's text.
struct Result {
  mapping::FittedRooms fitted;
  std::string text;
};

constexpr int kLosesItself = 3;  // exit status of rooms that lose their own recording

// Part of the bar of a step of the work.
mapping::Progress part(tools::ProgressBar& bar, double from, double to) {
  return [&bar, from, to](double share) { bar.show(from + (to - from) * share); };
}

[[noreturn]] void refuse(const Job& job, const std::string& reason) {
  throw config::Error(job.in.front(), 0, "", reason);
}

void write(const std::string& path, const std::string& text) {
  std::ofstream file(path);
  if (!(file << text).flush()) throw config::Error(path, 0, "", "cannot be written");
}

void printPath(const mapping::Survey& survey, const mapping::FittedRooms& fitted) {
  std::printf("path: %zu scans, %.1f m, %zu loops closed, %zu refused\n", survey.path().size(),
              survey.keys().back().way, fitted.path.loops, fitted.path.refused);
  if (survey.withWheels() > 0) {
    std::printf("wheels: %.4f m of way for a metre that they tell\n", fitted.path.wheel_scale);
  }
  if (survey.bridged() > 0) {
    std::printf("warning: bridged: %zu scans matched nothing, their poses are by odometry\n",
                survey.bridged());
  }
}

// As settings of the tracker: what the replay took for known.
void printWheels(const std::optional<motion::OdometryFit>& wheels) {
  if (!wheels) return;
  std::printf("odometry: {");
  const char* before = "";
  const auto print = [&](const char* name, const motion::FittedError& error) {
    if (!error.is_known) return;
    std::printf("%s%s: %.5f", before, name, error.value);
    before = ", ";
  };
  print("scale_mean", wheels->scale);
  print("steering_bias", wheels->steering);
  print("heading_bias_per_metre", wheels->heading);
  std::printf("}\n");
}

void printRooms(const mapping::FittedRooms& fitted) {
  std::printf("rooms: %zu, with %zu doors; %.1f %% of the path lies in them\n", fitted.rooms.size(),
              fitted.doors.size(), 100.0 * fitted.inside);
  for (const mapping::Crossing& crossing : fitted.missing_doors) {
    std::printf("warning: missing_door: from %s to %s at [%.2f, %.2f]\n",
                fitted.rooms[crossing.rooms[0]].name.c_str(),
                fitted.rooms[crossing.rooms[1]].name.c_str(), crossing.left_map.x(),
                crossing.left_map.y());
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
      "replay: %.1f %% of %zu scans within 0.25 m and 10 deg of the path, %.3f m on average, "
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

// The rooms as they go into the file: alone, or with those that are kept.
Result finished(const Job& job, const std::vector<mapping::KeyScan>& keys,
                mapping::FittedRooms fitted) {
  if (!job.keep) return {fitted, mapping::roomsText(fitted)};
  const auto kept = world::RoomMap::readFile(*job.keep);
  const auto merged = mapping::mergeRooms(kept, *job.keep, keys, std::move(fitted));
  std::printf("kept: %zu rooms, %zu doors; added: %zu rooms, %zu doors; %.1f m of wall agree\n",
              kept.rooms().size(), kept.doors().size(),
              merged.map.rooms().size() - kept.rooms().size(), merged.doors,
              merged.alignment.agreeing);
  return {merged.fitted, mapping::mergedText(merged)};
}

void writeAll(const Job& job, const Result& result, mapping::Drawing drawing) {
  write(job.out, result.text);
  drawing.add(result.fitted);
  drawing.write(std::filesystem::path(job.out).replace_extension(".png").string());
}

int fitGrid(const Job& job) {
  tools::ProgressBar bar;
  const mapping::GridMap grid = mapping::readGridMap(*job.grid);
  const mapping::GridSurvey survey = mapping::surveyGrid(grid, job.surface);
  mapping::FittedRooms fitted = mapping::fitRooms(survey, part(bar, 0.0, 1.0));
  if (fitted.rooms.empty()) {
    throw config::Error(*job.grid, 0, "image", "no rooms: its walls enclose none");
  }
  const Result result = finished(job, survey.keys, std::move(fitted));
  mapping::Drawing drawing;
  if (job.keep) {
    drawing.add(survey.keys, result.fitted.path.keys);
  } else {
    drawing.add(grid);
  }
  writeAll(job, result, std::move(drawing));
  printRooms(result.fitted);
  std::printf("a grid has no recording to keep: drive in the rooms before you trust them\n");
  return 0;
}

int fitRecording(const Job& job) {
  auto config =
      job.config ? pipeline::EstimatorsConfig::readFile(*job.config) : pipeline::EstimatorsConfig();
  tools::ProgressBar bar;
  mapping::Survey survey(config);
  tools::readBags(
      job.in, config, [&](pipeline::LocatedScan scan) { survey.take(std::move(scan)); },
      part(bar, 0.0, 0.4));
  mapping::FittedRooms fitted = mapping::fitRooms(survey, part(bar, 0.4, 0.8));
  const std::string fault = mapping::faultOf(survey, fitted.path);
  if (!fault.empty()) refuse(job, fault);
  if (fitted.rooms.empty()) refuse(job, "no rooms: no walls were seen about the path");
  const Result result = finished(job, survey.keys(), std::move(fitted));
  mapping::Drawing drawing;
  drawing.add(survey.keys(), result.fitted.path.keys);
  drawing.add(result.fitted.poses);
  writeAll(job, result, std::move(drawing));
  if (!config.rooms) config.rooms.emplace();
  config.rooms->map = job.out;
  const auto wheels = mapping::fitWheels(survey, result.fitted.poses);
  mapping::Replay replay(mapping::withWheels(config, wheels), result.fitted.poses,
                         mapping::odometryOf(survey));
  tools::readBags(
      job.in, config, [&](pipeline::LocatedScan scan) { replay.take(std::move(scan)); },
      part(bar, 0.8, 1.0));
  replay.finish();
  bar.show(1.0);
  printPath(survey, result.fitted);
  printRooms(result.fitted);
  const auto& start = result.fitted.poses.front().pose;
  std::printf("initial_pose: [%.4f, %.4f, %.4f]\n", start.x(), start.y(), start.theta());
  printWheels(wheels);
  return judge(replay);
}

int fit(const Job& job) {
  if (job.in.empty() == !job.grid) {
    throw tools::UsageError("either recordings, IN.bag..., or --grid MAP.yaml");
  }
  if (!(job.surface >= 0.0 && job.surface <= 1.0)) {
    throw tools::UsageError("--surface: from 0 to 1 cells");
  }
  return job.grid ? fitGrid(job) : fitRecording(job);
}

}  // namespace

int main(int argc, char** argv) {
  Job job;
  tools::Program program("fit_rooms",
                         "Fits rooms to a recording, draws them over its scans, and tracks the "
                         "recording in them. Exit status 3 where they lose it.");
  program.positionals("IN.bag", job.in, "the bags to read, as one", tools::Program::Fewest::kNone);
  program.requiredOption("--out", job.out, "rooms.yaml",
                         "rooms file to write; beside it a picture, rooms.png");
  program.option("--config", job.config, "FILE.yaml",
                 "settings as of offline: scans, frames, noise, rooms.tracker");
  program.option("--grid", job.grid, "MAP.yaml",
                 "fits rooms to this map of a map_server instead of a recording");
  program.option("--surface", job.surface, "CELLS",
                 "where a wall is in the first occupied cell of a grid, from its free edge on");
  program.option("--keep", job.keep, "ROOMS.yaml",
                 "rooms that stay as they are; what the recording adds to them comes in");
  return program.run(argc, argv, [&] { return fit(job); });
}
