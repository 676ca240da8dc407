// Draws rooms over a grid or a recording.
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "program/program.h"
#include "program/progress_bar.h"
#include "program/read_bags.h"
#include "sightline/mapping/drawing.h"
#include "sightline/mapping/recorded_tracker.h"

namespace {

using namespace sightline;

struct Job {
  std::string rooms;
  std::string out;
  std::vector<std::string> in;
  std::optional<std::string> grid;
  std::optional<std::string> config;
};

// The scans of a recording from where the tracker finds them in the rooms.
class TrackedScans {
 public:
  explicit TrackedScans(mapping::Drawing& drawing) : drawing_(drawing) {}

  void add(const pipeline::Estimates& estimates) {
    if (!estimates.rooms) return;
    const geometry::Pose2& pose = estimates.rooms->pose.mean;
    path_.push_back({estimates.located.scan.stamp, pose});
    const auto T_map_sensor = pose * *estimates.located.T_base_sensor;
    const scan::Scan& scan = estimates.located.scan;
    for (std::size_t i = 0; i < scan.beams(); ++i) {
      if (!scan.isValid(i)) continue;
      drawing_.addPoint(T_map_sensor * Eigen::Vector2d(scan.ranges()[i] * scan.direction(i)));
    }
  }
  std::size_t scans() const { return path_.size(); }
  void addPath() { drawing_.add(path_); }

 private:
  mapping::Drawing& drawing_;
  std::vector<geometry::StampedPose2> path_;
};

void addRecording(const Job& job, mapping::Drawing& drawing) {
  auto config =
      job.config ? pipeline::EstimatorsConfig::readFile(*job.config) : pipeline::EstimatorsConfig();
  if (!config.rooms) config.rooms.emplace();
  config.rooms->map = job.rooms;
  tools::ProgressBar bar;
  mapping::Survey survey(config);
  tools::readBags(
      job.in, config, [&](pipeline::LocatedScan scan) { survey.take(std::move(scan)); },
      [&](double share) { bar.show(0.5 * share); });
  mapping::RecordedTracker tracker(config, mapping::odometryOf(survey));
  TrackedScans scans(drawing);
  tools::readBags(
      job.in, config, [&](pipeline::LocatedScan scan) { scans.add(tracker.take(std::move(scan))); },
      [&](double share) { bar.show(0.5 + 0.5 * share); });
  if (scans.scans() == 0) {
    throw config::Error(job.in.front(), 0, "",
                        "the tracker finds no place for it in the rooms; a start helps, as "
                        "rooms.initial_pose in the file of --config");
  }
  scans.addPath();
  std::printf("%zu scans placed\n", scans.scans());
}

int draw(const Job& job) {
  const auto map = world::RoomMap::readFile(job.rooms);
  mapping::Drawing drawing;
  if (job.grid) drawing.add(mapping::readGridMap(*job.grid));
  if (!job.in.empty()) addRecording(job, drawing);
  drawing.add(map);
  drawing.write(job.out);
  std::printf("%zu rooms, %zu doors\n", map.rooms().size(), map.doors().size());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Job job;
  tools::Program program("draw_rooms",
                         "Draws rooms as a PNG, over a grid or over what a recording met.");
  program.positional("ROOMS.yaml", job.rooms, "rooms file");
  program.positional("OUT.png", job.out, "picture to write");
  program.positionals("IN.bag", job.in, "a recording, tracked in the rooms",
                      tools::Program::Fewest::kNone);
  program.option("--grid", job.grid, "MAP.yaml", "a map of a map_server");
  program.option("--config", job.config, "FILE.yaml",
                 "settings as of offline: scans, frames, noise, rooms.initial_pose");
  return program.run(argc, argv, [&] { return draw(job); });
}
