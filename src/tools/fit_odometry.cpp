// Finds the systematic errors of wheel odometry from a drive.
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "program/program.h"
#include "program/progress_bar.h"
#include "program/read_bags.h"
#include "sightline/config/error.h"
#include "sightline/motion/odometry_fit.h"
#include "sightline/pipeline/estimators.h"

namespace {

using namespace sightline;

struct FitJob {
  std::string config;
  std::vector<std::string> in;
  std::string out;
};

// Error of a pose by scans alone, from one scan to one soon after [m, rad].
constexpr double kReckonedPosition = 0.005;
constexpr double kReckonedHeading = 0.003;

// The pose that the wheels are compared with: in the rooms where there are any, else by scans.
std::optional<geometry::UncertainPose2> truePose(const pipeline::Estimates& estimates) {
  if (estimates.rooms) {
    if (estimates.rooms->state != tracking::TrackerState::kTracking) return std::nullopt;
    return estimates.rooms->pose;
  }
  if (!estimates.odometry || estimates.odometry->isFlagged()) return std::nullopt;
  const Eigen::Array3d sigma(kReckonedPosition, kReckonedPosition, kReckonedHeading);
  return geometry::UncertainPose2{estimates.odometry->pose.mean,
                                  sigma.square().matrix().asDiagonal()};
}

void take(const pipeline::Estimates& estimates, motion::OdometryLegs& legs) {
  const pipeline::LocatedScan& located = estimates.located;
  const auto pose = truePose(estimates);
  if (!pose || !located.T_odom_base || located.odometry_broke) {
    legs.interrupt();
  } else {
    legs.add(*located.T_odom_base, *pose);
  }
}

motion::OdometryFit fit(const FitJob& job, const pipeline::EstimatorsConfig& config) {
  pipeline::Estimators estimators(config, {false, config.rooms.has_value(), !config.rooms});
  motion::OdometryLegs legs;
  tools::ProgressBar bar;
  tools::readBags(
      job.in, config,
      [&](pipeline::LocatedScan located) { take(estimators.take(std::move(located)), legs); },
      [&](double ratio) { bar.show(ratio); });
  return motion::fitOdometry(legs.legs());
}

std::string said(const char* name, const motion::FittedError& error, const char* unit,
                 const char* advice) {
  if (error.is_known)
    return fmt::format("{} {:.5f} +- {:.5f} {}\n", name, error.value, error.sigma, unit);
  return fmt::format("{} is not told by this drive: {}\n", name, advice);
}

std::string settingsOf(const motion::OdometryFit& fit) {
  motion::OdometryNoise noise = fit.noise;
  std::string text = fmt::format(
      "# Odometry fitted to {:.1f} m and {:.0f} degrees of turns. For room_tracker: rosparam load "
      "FILE NODE;\n# for offline and estimators: the same lines below `rooms`.\ntracker:\n  "
      "odometry:\n",
      fit.length, geometry::degrees(fit.turn));
  for (const auto& row : config::describe(noise)) {
    text += fmt::format("    {}: {}   # {}\n", row.key, row.default_value, row.unit);
  }
  return text;
}

int run(const FitJob& job) {
  const auto config = pipeline::EstimatorsConfig::readFile(job.config);
  const motion::OdometryFit found = fit(job, config);
  std::printf("compared with %s over %zu legs, %.1f m, %.0f degrees of turns\n",
              config.rooms ? "the pose in the rooms" : "odometry from scans", found.legs,
              found.length, geometry::degrees(found.turn));
  std::fputs(
      said("scale_mean", found.scale, "true over measured length", "drive 5 m or more").c_str(),
      stdout);
  std::fputs(said("steering_bias", found.steering, "of the turn",
                  "turn round twice or more, also to and fro")
                 .c_str(),
             stdout);
  std::fputs(said("heading_bias_per_metre", found.heading, "rad/m", "drive 5 m or more").c_str(),
             stdout);
  std::ofstream file(job.out);
  file << settingsOf(found);
  file.close();
  if (!file) throw config::Error(job.out, 0, "", "cannot be written");
  constexpr int kFallsShort = 3;
  return found.scale.is_known && found.steering.is_known && found.heading.is_known ? 0
                                                                                   : kFallsShort;
}

}  // namespace

int main(int argc, char** argv) {
  FitJob job;
  tools::Program program("fit_odometry",
                         "Finds scale, steering and heading errors of wheel odometry from a drive, "
                         "against the walls of its rooms, or against odometry from its scans.");
  program.positionals("IN.bag", job.in, "the bags to read, as one");
  program.requiredOption(
      "--config", job.config, "FILE.yaml",
      "settings as of offline; with rooms, the wheels are compared with the pose "
      "in them");
  program.requiredOption("--out", job.out, "FILE.yaml",
                         "the settings that room_tracker reads; status 3 where the drive does not "
                         "tell them all");
  return program.run(argc, argv, [&] { return run(job); });
}
