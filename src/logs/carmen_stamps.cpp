#include "sightline/logs/carmen_stamps.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

#include <fmt/format.h>

#include "sightline/config/error.h"
#include "sightline/logs/fields.h"
#include "sightline/logs/line_reader.h"

namespace sightline::logs {

namespace {

constexpr std::int64_t kOneSecond = 1'000'000'000;

constexpr struct {
  // Steps beyond which a clock was set [ns].
  std::int64_t back = 10 * kOneSecond;
  std::int64_t ahead = 86'400 * kOneSecond;
  // Time between two scans of which the stamps do not tell it: where the clock was set, and at most
  // where several share a stamp [ns].
  std::int64_t after_break = kOneSecond / 5;
  double widest = 1e9;
  // A pose is at a stamp that is no further off [ns].
  std::int64_t tolerance = 1'000'000;
} kStamps;

// Scans in a row that share the mean of their stamps.
struct Pool {
  double mean;  // after the first stamp [ns]
  double count;
};

std::vector<std::int64_t> withoutBreaks(const std::vector<CarmenLaser>& scans) {
  std::vector<std::int64_t> stamps;
  std::int64_t offset = 0;
  std::int64_t newest = scans.front().stamp;
  for (const CarmenLaser& scan : scans) {
    const std::int64_t step = scan.stamp + offset - newest;
    if (step < -kStamps.back || step > kStamps.ahead) offset += kStamps.after_break - step;
    stamps.push_back(scan.stamp + offset);
    newest = std::max(newest, stamps.back());
  }
  return stamps;
}

// Pool adjacent violators.
std::vector<Pool> poolsOf(const std::vector<std::int64_t>& stamps) {
  std::vector<Pool> pools;
  for (const std::int64_t stamp : stamps) {
    Pool pool{static_cast<double>(stamp - stamps.front()), 1.0};
    for (; !pools.empty() && pools.back().mean >= pool.mean; pools.pop_back()) {
      const Pool& last = pools.back();
      const double count = last.count + pool.count;
      pool = {(last.count * last.mean + pool.count * pool.mean) / count, count};
    }
    pools.push_back(pool);
  }
  return pools;
}

// Time between the scans of a pool: they stay clear of the pools before and after.
double spacingOf(const std::vector<Pool>& pools, std::size_t i) {
  double spacing = kStamps.widest;
  const auto stayClear = [&](const Pool& other) {
    const double apart = std::abs(other.mean - pools[i].mean);
    spacing = std::min(spacing, 2.0 * apart / (pools[i].count + other.count));
  };
  if (i > 0) stayClear(pools[i - 1]);
  if (i + 1 < pools.size()) stayClear(pools[i + 1]);
  return spacing;
}

void shiftAfter1970(std::vector<std::int64_t>& stamps) {
  const std::int64_t first = stamps.front();
  if (first >= kOneSecond) return;
  for (std::int64_t& stamp : stamps) stamp += kOneSecond - first;
}

}  // namespace

std::size_t countNotRising(const CarmenLog& log) {
  std::size_t count = 0;
  for (std::size_t i = 1; i < log.scans.size(); ++i) {
    if (log.scans[i].stamp <= log.scans[i - 1].stamp) ++count;
  }
  return count;
}

bool hasUsableStamps(const CarmenLog& log) {
  return countNotRising(log) == 0 && (log.scans.empty() || log.scans.front().stamp >= kOneSecond);
}

std::vector<std::int64_t> risingStamps(const CarmenLog& log) {
  if (log.scans.empty()) return {};
  std::vector<std::int64_t> stamps = withoutBreaks(log.scans);
  const std::vector<Pool> pools = poolsOf(stamps);
  const std::int64_t first = stamps.front();
  auto stamp = stamps.begin();
  for (std::size_t i = 0; i < pools.size(); ++i) {
    if (pools[i].count == 1.0) {
      ++stamp;
      continue;
    }
    const double spacing = spacingOf(pools, i);
    const double middle = 0.5 * (pools[i].count - 1.0);
    for (double k = 0.0; k < pools[i].count; ++k, ++stamp) {
      *stamp = first + std::llround(pools[i].mean + (k - middle) * spacing);
    }
  }
  shiftAfter1970(stamps);
  return stamps;
}

void writeStamps(const std::string& path, const std::vector<StampPair>& stamps) {
  std::ofstream file(path);
  for (const StampPair& pair : stamps) {
    file << fmt::format("{} {}\n", formatStamp(pair.bag), formatStamp(pair.logged));
  }
  file.close();
  if (!file) throw config::Error(path, 0, "", "cannot be written");
}

std::vector<StampPair> readStamps(const std::string& path) {
  std::vector<StampPair> stamps;
  LineReader lines(path);
  for (std::string line; lines.next(line);) {
    Fields fields(line, lines.path(), lines.number());
    if (fields.atEnd()) continue;
    const std::int64_t bag = fields.stamp("the bag's time");
    stamps.push_back({bag, fields.stamp("the logged time")});
  }
  if (stamps.empty()) throw config::Error(path, 0, "", "holds no stamps");
  return stamps;
}

Trajectory atLoggedStamps(const Trajectory& trajectory, std::vector<StampPair> stamps) {
  std::sort(stamps.begin(), stamps.end(),
            [](const StampPair& a, const StampPair& b) { return a.bag < b.bag; });
  Trajectory logged;
  for (const geometry::StampedPose2& pose : trajectory) {
    const auto found = std::lower_bound(
        stamps.begin(), stamps.end(), pose.stamp - kStamps.tolerance,
        [](const StampPair& pair, std::int64_t stamp) { return pair.bag < stamp; });
    auto best = found;
    for (auto i = found; i != stamps.end() && i->bag <= pose.stamp + kStamps.tolerance; ++i) {
      if (std::abs(i->bag - pose.stamp) <= std::abs(best->bag - pose.stamp)) best = i;
    }
    if (best == stamps.end() || best->bag > pose.stamp + kStamps.tolerance) continue;
    logged.push_back({best->logged, pose.pose});
  }
  std::stable_sort(logged.begin(), logged.end(),
                   [](const auto& a, const auto& b) { return a.stamp < b.stamp; });
  return logged;
}

}  // namespace sightline::logs
