// Scores a trajectory against relations or against a true trajectory.
#include <array>
#include <cstdio>
#include <optional>

#include "program/program.h"
#include "sightline/logs/carmen_stamps.h"
#include "sightline/logs/trajectory_error.h"

namespace {

using namespace sightline;

// Prints figures; exit status 1 where nothing could be compared.
int print(const std::string& figures, bool any) {
  std::fputs(figures.c_str(), stdout);
  if (!any) std::fputs("no pose of the trajectory is at a time of the truth\n", stderr);
  return any ? 0 : 1;
}

struct Comparison {
  std::string trajectory;
  std::optional<std::string> relations;  // either these
  std::optional<std::string> truth;      // or this
  std::array<double, 3> offset{};        // x, y, theta; m, rad
  std::optional<std::string> stamps;     // what the log said, by carmen_to_bag
};

int evaluate(const Comparison& comparison) {
  if (comparison.relations.has_value() == comparison.truth.has_value()) {
    throw tools::UsageError("either --relations or --truth is needed");
  }
  const auto [x, y, theta] = comparison.offset;
  const geometry::Pose2 T_body_measured(x, y, theta);
  logs::Trajectory trajectory = logs::readTrajectory(comparison.trajectory);
  if (comparison.stamps) {
    trajectory = logs::atLoggedStamps(trajectory, logs::readStamps(*comparison.stamps));
  }
  if (comparison.relations) {
    const auto relations = logs::readRelations(*comparison.relations);
    const auto errors = logs::compareWithRelations(trajectory, relations, T_body_measured);
    return print(logs::figures(errors), errors.used > 0);
  }
  const auto truth = logs::readTrajectory(*comparison.truth);
  const auto errors = logs::compareWithTruth(trajectory, truth, T_body_measured);
  return print(logs::figures(errors), errors.used > 0);
}

}  // namespace

int main(int argc, char** argv) {
  Comparison comparison;
  tools::Program program("evaluate_trajectory",
                         "Scores a trajectory, either against relations or against the truth.");
  program.positional("TRAJECTORY.tum", comparison.trajectory,
                     "`t x y z qx qy qz qw` or `t x y theta` a line; metres, radians");
  program.option("--relations", comparison.relations, "FILE",
                 "`t1 t2 x y z roll pitch yaw` a line: the pose at t2 seen from that at t1");
  program.option("--truth", comparison.truth, "FILE.tum", "a trajectory in the same frame");
  program.option("--offset", comparison.offset, "X Y THETA",
                 "the frame the truth holds for, in the frame whose trajectory this is");
  program.option("--stamps", comparison.stamps, "FILE",
                 "`bag-stamp logged-stamp` a line, as carmen_to_bag writes it: the truth is looked "
                 "up by the logged ones");
  return program.run(argc, argv, [&] { return evaluate(comparison); });
}
