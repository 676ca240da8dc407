#include "sightline/logs/mrclam.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <map>

#include <fmt/format.h>

#include "sightline/config/error.h"
#include "sightline/logs/fields.h"
#include "sightline/logs/line_reader.h"

namespace sightline::logs {

namespace {

// Plain, or gzipped where that alone is there.
std::string mrclamPath(const std::string& folder, const std::string& name) {
  const std::string path = (std::filesystem::path(folder) / name).string();
  return !std::filesystem::exists(path) && std::filesystem::exists(path + ".gz") ? path + ".gz"
                                                                                 : path;
}

std::string withoutTabs(std::string line) {
  std::replace(line.begin(), line.end(), '\t', ' ');
  return line;
}

// Calls back for every line but comments and blank ones.
void forEachRow(const std::string& path, const std::function<void(Fields&)>& take) {
  LineReader reader(path);
  for (std::string line; reader.next(line);) {
    const std::string row = withoutTabs(line);
    Fields fields(row, path, reader.number());
    if (fields.atEnd() || row[row.find_first_not_of(' ')] == '#') continue;
    take(fields);
  }
}

constexpr std::size_t kMostSubjects = 10000;
// Sightings in one image are logged within so short a time; images are ten times as far apart [ns].
constexpr std::int64_t kSameImage = 20'000'000;

std::map<std::size_t, int> readBarcodes(const std::string& folder) {
  std::map<std::size_t, int> subject_of;
  forEachRow(mrclamPath(folder, "Barcodes.dat"), [&](Fields& fields) {
    const std::size_t subject = fields.count("subject", kMostSubjects);
    subject_of[fields.count("barcode", kMostSubjects)] = static_cast<int>(subject);
  });
  return subject_of;
}

std::vector<MrclamLandmark> readLandmarks(const std::string& folder) {
  std::vector<MrclamLandmark> landmarks;
  forEachRow(mrclamPath(folder, "Landmark_Groundtruth.dat"), [&](Fields& fields) {
    const auto subject = static_cast<int>(fields.count("subject", kMostSubjects));
    const double x = fields.finite("x");
    landmarks.push_back({subject, {x, fields.finite("y")}});
  });
  return landmarks;
}

Trajectory readTruth(const std::string& path) {
  Trajectory truth;
  forEachRow(path, [&](Fields& fields) {
    const std::int64_t stamp = fields.stamp("time");
    const double x = fields.finite("x");
    const double y = fields.finite("y");
    const geometry::Pose2 pose(x, y, fields.finite("orientation"));
    // A pose that does not come later would leave no order to look poses up in.
    if (truth.empty() || stamp > truth.back().stamp) truth.push_back({stamp, pose});
  });
  return truth;
}

std::vector<MrclamLook> readLooks(const std::string& path,
                                  const std::map<std::size_t, int>& subject_of) {
  std::vector<MrclamLook> looks;
  forEachRow(path, [&](Fields& fields) {
    const std::int64_t stamp = fields.stamp("time");
    const auto found = subject_of.find(fields.count("barcode", kMostSubjects));
    const double range = fields.finite("range");
    if (looks.empty() || stamp > looks.back().stamp + kSameImage) looks.push_back({stamp, {}});
    looks.back().sightings.push_back(
        {found == subject_of.end() ? 0 : found->second, range, fields.finite("bearing")});
  });
  return looks;
}

std::vector<MrclamVelocity> readVelocities(const std::string& path) {
  std::vector<MrclamVelocity> velocities;
  forEachRow(path, [&](Fields& fields) {
    const std::int64_t stamp = fields.stamp("time");
    const double linear = fields.finite("forward velocity");
    velocities.push_back({stamp, linear, fields.finite("angular velocity")});
  });
  return velocities;
}

}  // namespace

MrclamSet readMrclam(const std::string& folder) {
  const std::map<std::size_t, int> subject_of = readBarcodes(folder);
  MrclamSet set;
  set.landmarks = readLandmarks(folder);
  for (int number = 1;; ++number) {
    const auto path = [&](const char* kind) {
      return mrclamPath(folder, fmt::format("Robot{}_{}.dat", number, kind));
    };
    if (number > 1 && !std::filesystem::exists(path("Measurement"))) break;
    set.robots.push_back({number, readTruth(path("Groundtruth")),
                          readLooks(path("Measurement"), subject_of),
                          readVelocities(path("Odometry"))});
  }
  return set;
}

std::int64_t cameraPeriod(const std::vector<MrclamLook>& looks) {
  std::vector<std::int64_t> steps;
  for (std::size_t i = 1; i < looks.size(); ++i) {
    steps.push_back(looks[i].stamp - looks[i - 1].stamp);
  }
  if (steps.size() < 10) return 0;
  std::sort(steps.begin(), steps.end());
  // The tenth part is a step of one image, even where most of them are empty.
  const std::int64_t one = steps[steps.size() / 10];
  const auto end = std::upper_bound(steps.begin(), steps.end(), one + one / 2);
  return steps[static_cast<std::size_t>(end - steps.begin()) / 2];
}

std::vector<MrclamLook> withEmptyLooks(const std::vector<MrclamLook>& looks, std::int64_t period) {
  std::vector<MrclamLook> all;
  for (const MrclamLook& look : looks) {
    if (!all.empty() && period > 0) {
      const std::int64_t before = all.back().stamp;
      const std::int64_t step = look.stamp - before;
      const std::int64_t count =
          std::llround(static_cast<double>(step) / static_cast<double>(period));
      for (std::int64_t i = 1; i < count; ++i) all.push_back({before + i * step / count, {}});
    }
    all.push_back(look);
  }
  return all;
}

}  // namespace sightline::logs
