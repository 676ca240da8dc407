// Judges a recorded run of room_tracker by the truth that sim_sensor knows.
#include <cstdio>
#include <filesystem>

#include "arguments.h"
#include "sightline/bridge/run_report.h"

namespace {

using namespace sightline;

constexpr const char* kUsage =
    "report_run RUN.bag --out DIR\n"
    "  RUN.bag  with scan, pose, ground_truth and tracker_status\n"
    "  --out    folder for trajectory.tum and truth.tum, both in the map\n"
    "Ends with 0 only if every scan has a pose, and every pose is within 0.15 m and 3 degrees of "
    "the\n"
    "truth at its stamp.\n";

void write(const logs::Trajectory& trajectory, const std::filesystem::path& path) {
  logs::TrajectoryWriter writer(path.string());
  for (const logs::TimedPose& pose : trajectory) writer.add(pose.stamp, pose.pose);
  writer.close();
}

int report(tools::Arguments& arguments) {
  const auto out = arguments.text("--out");
  if (!out) throw tools::UsageError("--out is missing");
  const std::string bag = arguments.positional("RUN.bag");
  arguments.finish();
  const bridge::RecordedRun run = bridge::readRun(bag);
  std::filesystem::create_directories(*out);
  write(run.poses, std::filesystem::path(*out) / "trajectory.tum");
  write(run.truth, std::filesystem::path(*out) / "truth.tum");
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
  return sightline::tools::run(argc, argv, kUsage, report);
}
