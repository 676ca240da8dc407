// Judges a recorded run of room_tracker by the truth that sim_sensor knows.
#include <cstdio>
#include <filesystem>

#include "program/program.h"
#include "sightline/bridge/run_report.h"

namespace {

using namespace sightline;

void write(const logs::Trajectory& trajectory, const std::filesystem::path& path) {
  logs::TrajectoryWriter writer(path.string());
  for (const geometry::StampedPose2& pose : trajectory) writer.add(pose.stamp, pose.pose);
  writer.close();
}

int report(const std::string& bag, const std::filesystem::path& out) {
  const bridge::RecordedRun run = bridge::readRun(bag);
  std::filesystem::create_directories(out);
  write(run.poses, out / "trajectory.tum");
  write(run.truth, out / "truth.tum");
  const bridge::RunReport report = bridge::judge(run);
  const bridge::PoseBounds bounds;
  const bool is_good = report.isGood(bounds);
  std::printf("%s%-24s%s (%.2f m, %.0f deg, a pose for every scan)\n",
              bridge::describe(run, report).c_str(), "within bounds", is_good ? "yes" : "NO",
              bounds.position, geometry::degrees(bounds.heading));
  return is_good ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  std::string bag;
  std::string out;
  tools::Program program("report_run",
                         "Judges a recorded run of room_tracker by the truth of sim_sensor.\n"
                         "Ends with 0 only if every scan has a pose, and every pose is within\n"
                         "0.15 m and 3 degrees of the truth at its stamp.");
  program.positional("RUN.bag", bag, "with scan, pose, ground_truth and tracker_status");
  program.requiredOption("--out", out, "DIR",
                         "folder for trajectory.tum and truth.tum, both in the map");
  return program.run(argc, argv, [&] { return report(bag, out); });
}
