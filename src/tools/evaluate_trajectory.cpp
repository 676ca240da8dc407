// Scores a trajectory against relations or against a true trajectory.
#include <cstdio>

#include "arguments.h"
#include "sightline/logs/trajectory_error.h"

namespace {

using namespace sightline;

constexpr const char* kUsage =
    "evaluate_trajectory TRAJECTORY.tum (--relations FILE | --truth FILE.tum) [--offset X Y "
    "THETA]\n"
    "  TRAJECTORY.tum  `t x y z qx qy qz qw` or `t x y theta` a line; metres, radians\n"
    "  --relations     `t1 t2 x y z roll pitch yaw` a line: the pose at t2 seen from that at t1\n"
    "  --truth         a trajectory in the same frame\n"
    "  --offset        the frame the truth holds for, in the frame whose trajectory this is\n";

// What is printed, and an exit status of 1 where nothing could be compared.
int print(const std::string& figures, bool any) {
  std::fputs(figures.c_str(), stdout);
  if (!any) std::fputs("no pose of the trajectory is at a time of the truth\n", stderr);
  return any ? 0 : 1;
}

int evaluate(tools::Arguments& arguments) {
  const auto relations = arguments.text("--relations");
  const auto truth = arguments.text("--truth");
  const auto offset = arguments.numbers("--offset", 3).value_or(std::vector<double>{0.0, 0.0, 0.0});
  const std::string path = arguments.positional("TRAJECTORY.tum");
  arguments.finish();
  if (relations.has_value() == truth.has_value()) {
    throw tools::UsageError("either --relations or --truth is needed");
  }
  const geometry::Pose2 T_body_measured(offset[0], offset[1], offset[2]);
  const logs::Trajectory trajectory = logs::readTrajectory(path);
  if (relations) {
    const auto errors =
        logs::compareWithRelations(trajectory, logs::readRelations(*relations), T_body_measured);
    return print(logs::figures(errors), errors.used > 0);
  }
  const auto errors =
      logs::compareWithTruth(trajectory, logs::readTrajectory(*truth), T_body_measured);
  return print(logs::figures(errors), errors.used > 0);
}

}  // namespace

int main(int argc, char** argv) {
  return sightline::tools::run(argc, argv, kUsage, evaluate);
}
