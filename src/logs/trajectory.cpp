#include "sightline/logs/trajectory.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "sightline/config/error.h"
#include "sightline/logs/fields.h"
#include "sightline/logs/line_reader.h"

namespace sightline::logs {

namespace {

using geometry::Pose2;

struct Row {
  std::vector<std::int64_t> stamps;
  std::vector<double> numbers;
};

// A line of so many stamps and then numbers; empty for comments and blank lines.
Row readRow(const LineReader& lines, std::string line, std::size_t stamps) {
  line = line.substr(0, line.find('#'));
  Fields fields(line, lines.path(), lines.number());
  Row row;
  while (!fields.atEnd()) {
    if (row.stamps.size() < stamps) {
      row.stamps.push_back(fields.stamp("a time"));
    } else {
      row.numbers.push_back(fields.finite("a number"));
    }
  }
  return row;
}

// The yaw of a quaternion (x, y, z, w) of any length but zero.
double yawOf(const double* q) {
  return std::atan2(2.0 * (q[3] * q[2] + q[0] * q[1]),
                    q[3] * q[3] + q[0] * q[0] - q[1] * q[1] - q[2] * q[2]);
}

geometry::StampedPose2 timedPose(const Row& row, const LineReader& lines) {
  const auto& n = row.numbers;
  if (n.size() == 7) return {row.stamps[0], Pose2(n[0], n[1], yawOf(&n[3]))};
  if (n.size() == 3) return {row.stamps[0], Pose2(n[0], n[1], n[2])};
  throw config::Error(lines.path(), lines.number(), "",
                      fmt::format("expected 4 or 8 columns, found {}", n.size() + 1));
}

}  // namespace

Trajectory readTrajectory(const std::string& path) {
  Trajectory trajectory;
  LineReader lines(path);
  for (std::string line; lines.next(line);) {
    const Row row = readRow(lines, line, 1);
    if (!row.stamps.empty()) trajectory.push_back(timedPose(row, lines));
  }
  if (trajectory.empty()) throw config::Error(path, 0, "", "holds no poses");
  std::stable_sort(trajectory.begin(), trajectory.end(),
                   [](const geometry::StampedPose2& a, const geometry::StampedPose2& b) {
                     return a.stamp < b.stamp;
                   });
  return trajectory;
}

TrajectoryWriter::TrajectoryWriter(const std::string& path) : path_(path), file_(path) {
  if (!file_) throw config::Error(path, 0, "", "cannot be written");
}

void TrajectoryWriter::add(std::int64_t stamp, const Pose2& pose) {
  file_ << fmt::format("{} {:.6f} {:.6f} 0 0 0 {:.9f} {:.9f}\n", formatStamp(stamp), pose.x(),
                       pose.y(), std::sin(0.5 * pose.theta()), std::cos(0.5 * pose.theta()));
}

void TrajectoryWriter::close() {
  file_.close();
  if (!file_) throw config::Error(path_, 0, "", "could not be written to its end");
}

std::vector<Relation> readRelations(const std::string& path) {
  std::vector<Relation> relations;
  LineReader lines(path);
  for (std::string line; lines.next(line);) {
    const Row row = readRow(lines, line, 2);
    const auto& n = row.numbers;
    if (row.stamps.empty()) continue;
    if (n.size() != 6) {
      throw config::Error(
          path, lines.number(), "",
          fmt::format("expected 8 columns, found {}", row.stamps.size() + n.size()));
    }
    relations.push_back({row.stamps[0], row.stamps[1], Pose2(n[0], n[1], n[5])});
  }
  if (relations.empty()) throw config::Error(path, 0, "", "holds no relations");
  return relations;
}

}  // namespace sightline::logs
