// Figures of reliability, one a line: `name value unit`; lines that start with # explain.
//
// reliability.inputs.tried: recordings of a robot whose messages have one fault each, of the kinds
// that reports about other packages tell of. reliability.inputs.survived: those on which `offline`
// neither crashes, nor hangs, nor is silently wrong: from 8 s on a room pose that is called
// tracking is within 10 cm and 3 degrees, odometry of which no scan is flagged ends within that,
// nothing is NaN, and estimators without a pose for half of the scans end with another status than
// 0.
//
// usage: bench_reliability [PART OF AN INPUT'S NAME]
#include <fmt/format.h>

#include "reliability/scans.h"

namespace {

using namespace sightline;

std::vector<test::RobotInput> allInputs() {
  std::vector<test::RobotInput> inputs{test::asItShouldBe()};
  bench::addAbsurdOdometry(inputs);
  bench::addLeapsOfOdometry(inputs);
  bench::addPoorOdometry(inputs);
  bench::addMisses(inputs);
  bench::addStrayStamps(inputs);
  bench::addOddFields(inputs);
  bench::addMountings(inputs);
  bench::addTopics(inputs);
  bench::addDrivers(inputs);
  return inputs;
}

std::vector<test::RobotInput> inputsWith(const std::string& part_of_name) {
  std::vector<test::RobotInput> inputs;
  for (test::RobotInput& input : allInputs()) {
    if (input.name.find(part_of_name) != std::string::npos) inputs.push_back(std::move(input));
  }
  return inputs;
}

bool isSilent(const test::RobotRun& run) {
  constexpr std::size_t kHalf = 99;  // of the scans
  return run.isSilentlyWrong() ||
         (run.status == 0 && (run.room_poses < kHalf || run.odometry_poses < kHalf));
}

std::string verdictOn(const test::RobotInput& input) {
  const test::RobotRun run = test::runOffline(input);
  if (run.isCrash()) return fmt::format("ends with {}", run.status);
  if (!isSilent(run)) return "";
  return fmt::format(
      "silently wrong: rooms {} poses, {:.3f} m, {:.1f} deg; odometry {} poses, {:.3f} m, {:.1f} "
      "deg, "
      "{} flagged; status {}",
      run.room_poses, run.rooms_worst.position, run.rooms_worst.heading, run.odometry_poses,
      run.odometry_end.position, run.odometry_end.heading, run.flagged, run.status);
}

}  // namespace

int main(int argc, char** argv) {
  const auto inputs = inputsWith(argc > 1 ? argv[1] : "");
  std::size_t survived = 0;
  for (const test::RobotInput& input : inputs) {
    const std::string verdict = verdictOn(input);
    if (verdict.empty()) {
      ++survived;
    } else {
      fmt::print("# reliability: {}: {}\n", input.name, verdict);
    }
    fmt::print(stderr, "reliability: {}: {}\n", input.name, verdict.empty() ? "survived" : verdict);
  }
  fmt::print("reliability.inputs.tried {} 1\n", inputs.size());
  fmt::print("reliability.inputs.survived {} 1\n", survived);
  return 0;
}
