// Figures of the offline program, one a line: `name value unit`; lines that start with # explain.
//
// offline.realtime_factor: seconds of scans in the log fr079 over the seconds that `offline` takes
// to run lines and rooms over its bag, start, reading and writing included; the best of three runs.
// offline.peak_mb: the most memory it held, in 10⁶ bytes. offline.limits: all estimators on 10 s of
// simulated scans, once with each setting at either end of its range, and the slowest of these.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "offline/every_limit.h"
#include "sightline/logs/carmen_log.h"
#include "temporary_folder.h"

namespace {

using namespace sightline;

struct Use {
  double seconds = 0.0;
  double peak_mb = 0.0;
};

[[noreturn]] void become(const std::string& program, std::vector<std::string> arguments) {
  const std::string path = SIGHTLINE_PROGRAMS "/" + program;
  std::vector<char*> words{const_cast<char*>(program.c_str())};
  for (std::string& argument : arguments) words.push_back(argument.data());
  words.push_back(nullptr);
  // Standard output is for figures.
  dup2(STDERR_FILENO, STDOUT_FILENO);
  execv(path.c_str(), words.data());
  _exit(127);
}

Use run(const std::string& program, const std::vector<std::string>& arguments) {
  const auto begin = std::chrono::steady_clock::now();
  const pid_t child = fork();
  if (child == 0) become(program, arguments);
  int status = 0;
  rusage usage{};
  if (child < 0 || wait4(child, &status, 0, &usage) != child || status != 0) {
    throw std::runtime_error(program + " failed");
  }
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
  return {spent.count(), 1024e-6 * static_cast<double>(usage.ru_maxrss)};
}

double secondsOfScans(const std::string& log) {
  const auto scans = logs::readCarmenLog(log).scans;
  return 1e-9 * static_cast<double>(scans.back().stamp - scans.front().stamp);
}

void measure(const std::string& log) {
  const test::TemporaryFolder folder;
  const Use conversion = run("carmen_to_bag", {log, folder.path("in.bag"), "--reverse-from-tv",
                                               "--odometry-delay", "0.12"});
  Use best{1e9, 0.0};
  for (int i = 0; i < 3; ++i) {
    const Use use = run(
        "offline", {"--config", SIGHTLINE_SOURCE_DIR "/config/offline/fr079.yaml",
                    folder.path("in.bag"), "--out", folder.path("out"), "--nodes", "lines,rooms"});
    best = {std::min(best.seconds, use.seconds), std::max(best.peak_mb, use.peak_mb)};
  }
  fmt::print("offline.realtime_factor {:.0f} 1\n", secondsOfScans(log) / best.seconds);
  fmt::print("offline.peak_mb {:.1f} MB\n", best.peak_mb);
  fmt::print("offline.carmen_to_bag_s {:.2f} s\n", conversion.seconds);
}

}  // namespace

int main() {
  bench::printLimits();
  const char* data = std::getenv("SIGHTLINE_DATA");
  const auto log = std::filesystem::path(data ? data : "") / "fr079.clf.gz";
  if (!data || !std::filesystem::exists(log)) {
    fmt::print("# offline: left out, SIGHTLINE_DATA holds no fr079.clf.gz\n");
    return 0;
  }
  measure(log.string());
  return 0;
}
